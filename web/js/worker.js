// Runs the programs, in a worker, behind the JavaScript of wasm-bindgen. Receives { module, files }, then
// { id, task, commands, files }.

/** @typedef {import('./studio.js').Message} Message */

/** @type {any} */
let studio;

/** @type {Record<string, (commands: string) => any>} */
const tasks = {
  describe: commands => JSON.parse(studio.describe(commands)),
  draw: commands => {
    const shown = studio.draw(commands);
    const { width, height, pixels, notes } = shown;
    shown.free();
    return { width, height, pixels, notes };
  },
  file: commands => studio.file(commands),
};

const add = (/** @type {[string, Uint8Array][]} */ files) => files.forEach(([name, bytes]) => studio.add(name, bytes));

onmessage = ({ data }) => {
  if (data.module) {
    wasm_bindgen.initSync({ module: data.module });
    studio = new wasm_bindgen.Studio();
    add(data.files);
    return;
  }
  const { id, task, commands, files } = /** @type {Message} */ (data);
  const begun = performance.now();
  try {
    add(files);
    const result = tasks[task](JSON.stringify(commands));
    const answer = { id, result, ms: performance.now() - begun };
    postMessage(answer, { transfer: result.pixels ? [result.pixels.buffer] : [] });
  } catch (/** @type {any} */ error) {
    // A message of the programs is text; anything else ends this worker.
    const isDead = typeof error !== 'string';
    const lack = 'the input needs more memory than a browser has, or this is a bug';
    postMessage({ id, error: isDead ? `the programs stopped (${error.message}): ${lack}` : error, isDead });
  }
};
