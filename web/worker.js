// Runs the programs, in a worker. Receives { module, files }, then { id, task, commands }.
'use strict';

let studio;

const tasks = {
  describe: commands => JSON.parse(studio.describe(commands)),
  draw: commands => {
    const shown = studio.draw(commands);
    const { width, height, pixels, notes } = shown;
    shown.free();
    return { width, height, pixels, notes };
  },
  file: commands => studio.file(commands),
  lines: commands => ({ shell: wasm_bindgen.Studio.line(commands), python: wasm_bindgen.Studio.python(commands) }),
};

onmessage = async ({ data }) => {
  if (data.module) {
    wasm_bindgen.initSync({ module: data.module });
    studio = new wasm_bindgen.Studio();
    data.files.forEach(([name, bytes]) => studio.add(name, bytes));
    return;
  }
  const { id, task, commands } = data;
  const begun = performance.now();
  try {
    const result = tasks[task](JSON.stringify(commands));
    postMessage({ id, result, ms: performance.now() - begun });
  } catch (error) {
    // A message of the programs is text; anything else ends this worker.
    const isDead = typeof error !== 'string';
    postMessage({ id, error: isDead ? `the programs stopped (${error.message}): the input needs more memory than a browser has, or this is a bug` : error, isDead });
  }
};
