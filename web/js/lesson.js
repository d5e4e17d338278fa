// What is seen, and why: sentences and a question for each scene, and the middle of the picture in words.

import { commands } from './commands.js';
import { $, brief, digits } from './dom.js';
import { flying } from './flight.js';
import { controls, sides, state } from './state.js';
import { full } from './studio.js';

/** @typedef {{ seen: string, why: string, question: string, answer: string }} Lesson */

/** Shows the lesson of a scene. */
export function showLesson(/** @type {Lesson | undefined} */ lesson, /** @type {string} */ title) {
  $('lesson').hidden = !lesson;
  $('subject').textContent = title;
  if (!lesson) return;
  ['seen', 'why', 'question', 'answer'].forEach(part => {
    $(part).textContent = lesson[/** @type {keyof Lesson} */ (part)];
  });
  $('asked').open = false;
}

/** Says in words what is in the middle of the picture: the program that traces rays explains the pixel. */
export async function say(/** @type {() => boolean} */ isNow) {
  const c = controls();
  if (state.isSky) {
    const speed = Math.hypot(...(flying.pose()?.velocity ?? [c.beta]));
    $('words').textContent = `The sky, seen at ${digits(speed, 3)} c.`;
    return;
  }
  // The pixel of a small picture, from surfaces alone, without light: quick.
  const [width, height] = sides().map((/** @type {number} */ side) => Math.ceil(side / 4));
  const way = flying.way();
  const pixel = { ...c, rays: true, look: 'shape', lens: '', gr: false, dl: false, lg: false, map: false, unit: '', light: '',
    more: `-aa 1 -ex 0 --no-shadows -dt json --explain ${width >> 1},${height >> 1}` };
  const [line] = commands(pixel, { ...way, size: [width, height] });
  try {
    const { result } = await full.run('file', [line], way?.files ?? []);
    if (!isNow()) return;
    const [surface] = JSON.parse(new TextDecoder().decode(result)).sample?.surfaces ?? [];
    flying.setAhead(surface ? Math.hypot(...surface.emission.x) : null);
    $('words').textContent = surface ? inWords(surface) : 'In the middle of the picture is the background.';
  } catch (error) {
    // A scene that cannot be explained is drawn all the same.
    if (error !== 'stopped') $('words').textContent = '';
  }
}

/** @param {any} surface */
function inWords({ item, beta, emission, angle_deg, angle_at_rest_deg, D }) {
  const name = item.name ? ` ${item.name}` : item.line ? ` of line ${item.line}` : '';
  const distance = brief(Math.hypot(...emission.x));
  if (!(beta > 0)) return `In the middle of the picture: ${item.kind}${name}, ${distance} away, at rest.`;
  const colour = D > 1.005 ? 'bluer and brighter' : D < .995 ? 'redder and darker' : 'in its own colours';
  return `In the middle of the picture: ${item.kind}${name}, which moves at ${digits(beta, 3)} c relative to you. `
    + `Its light left it ${distance} away, and that long ago. It is seen at ${digits(angle_deg, 0)}° from its motion, but in its own frame the `
    + `light left at ${digits(angle_at_rest_deg, 0)}°: so it looks turned by ${digits(Math.abs(angle_deg - angle_at_rest_deg), 0)}°. `
    + `D is ${digits(D, 3)}: ${colour}.`;
}
