// The words of the commands that draw a picture.

import { digits, direction, words } from './dom.js';
import { sides, state } from './state.js';

/**
 * @typedef {import('./state.js').Controls} Controls
 * @typedef {import('./state.js').Pose} Pose
 *
 * How a picture is drawn. `size`: another one than that of the page. `file`: what it is saved in. `pose`: of a camera
 * that flies. `flight`: the scene of the flight, and its own time. `exposure`: in stops, empty to find it.
 * @typedef {{ size?: number[], file?: string | null, isDraft?: boolean, pose?: Pose | null,
 *   flight?: { name: string, time: number } | null, exposure?: string }} Way
 */

const option = (/** @type {string} */ name, /** @type {number[]} */ numbers, places = 4) =>
  [name, ...numbers.map(number => digits(number, places))];
const exact = (/** @type {string} */ name, /** @type {number[]} */ numbers) => [name, ...numbers.map(String)];
const flag = (/** @type {boolean} */ is, /** @type {string[]} */ ...them) => is ? them : [];

const isMovingAs = (/** @type {Controls} */ c) => state.isSky ? 'cv' : c.moves;

function motionWords(/** @type {Controls} */ c) {
  const moves = isMovingAs(c);
  if (moves === 'own') return [];
  return option(`-${moves}`, direction(c.azimuth, c.climb).map(part => c.beta * part));
}

function cameraWords(/** @type {Controls} */ c) {
  const camera = state.camera;
  if (!camera) return [];
  if (state.isSky) {
    const angle = c.lens ? [] : option('-va', [camera.angle ?? 90], 1);
    return [...option('-vc', direction(camera.azimuth, camera.climb), 3), ...angle];
  }
  if (!camera.isMoved) return [];
  const places = Math.max(0, 3 - Math.floor(Math.log10(camera.distance)));
  return [...option('-ep', eye(camera), places), ...option('-vc', camera.center, places)];
}

/** The eye point of a camera. */
export function eye(/** @type {import('./state.js').Camera} */ { center, distance, azimuth, climb }) {
  return direction(azimuth, climb).map((part, axis) => center[axis] + distance * part);
}

/** A camera that passes an event with a velocity: at time 0 it is where it would have been with this velocity. */
function poseWords(/** @type {Pose} */ { event: [t, ...x], velocity, gamma, view, up }) {
  const camera = [...exact('-cv', velocity), ...exact('-ud', up)];
  if (state.isSky) return [...camera, ...exact('-vc', view)];
  const from = x.map((part, axis) => part - velocity[axis] * t);
  const center = from.map((part, axis) => part + view[axis]);
  return [...camera, ...exact('-ti', [t / gamma]), ...exact('-ep', from), ...exact('-vc', center)];
}

/** Effects that controls leave out of positions. */
const geometry = (/** @type {Controls} */ c) => [
  ...flag(c.noContraction, '-nc'), ...flag(c.noTime, '--no-flight-time'),
];

/** Effects that controls leave out of colours. */
const colors = (/** @type {Controls} */ c) => c.look === 'shape' ? []
  : [...flag(c.noDoppler, '--no-doppler'), ...flag(c.noFlux, '--no-flux')];

/** The options among words that ugfilm gives to a program of a frame: each goes to the first that has it, but for `-sky`. */
function of(/** @type {string} */ program, /** @type {string[]} */ all) {
  const pipe = ['uglorentz', 'ugdoppler', 'ugrainbow'];
  let isIts = false;
  return all.filter(word => {
    if (/^--?[a-z]/i.test(word)) {
      const owners = pipe.filter(name => wasm_bindgen.Studio.has(name, word));
      isIts = /^--?sky/.test(word) ? owners.includes(program) : owners[0] === program || !owners.length && program === 'ugrainbow';
    }
    return isIts;
  });
}

/**
 * The commands of a picture: the words of each program.
 * @param {Controls} c
 * @param {Way} way
 */
export function commands(c, { size = sides(), file = null, isDraft = false, pose = null, flight = null, exposure = '' } = {}) {
  const isRays = !state.isSky && c.rays;
  const isFlown = !!(pose || flight);
  const isThree = !state.isSky && !isRays;
  const output = [
    ...flag(!!file?.endsWith('.svg') && !isRays && !state.isSky, '-vec'),
    '-sz', ...size.map(String),
    ...flag(c.dl && !state.isSky, '-dl'), ...flag(c.gr && !state.isSky, '-gr'),
    // Pictures that are soon replaced have few samples.
    ...flag(isDraft && !/(^|\s)--?(aa|samples)\b/.test(c.more), '-aa', isRays || state.isSky ? '1' : '2'),
    ...flag(c.lg && !isDraft, '-lg'), ...flag(c.map && !state.isSky, '-map', 'D'),
    ...flag(!!c.unit, '-unit', c.unit), ...flag(!!c.light, '-c', c.light), ...flag(!!exposure, '-ex', exposure),
    ...(isFlown && isThree ? of('ugrainbow', words(c.more)) : words(c.more)), ...flag(!!file, '-fo', file ?? ''),
  ];
  const lens = words(c.lens);
  const name = flight?.name ?? state.name;
  const time = flight ? exact('-ti', [flight.time]) : c.time && !pose ? option('-ti', [c.time], 3) : [];
  if (state.isSky) {
    const camera = flight ? ['--scene', flight.name, ...time] : pose ? poseWords(pose)
      : [...motionWords(c), ...cameraWords(c)];
    const angle = pose && !c.lens ? option('-va', [state.camera?.angle ?? 90], 1) : [];
    return [['ugwarp', ...camera, ...angle, '-look', c.look, ...colors(c), ...lens, state.name, ...output]];
  }
  const motion = isFlown ? [] : [...motionWords(c), ...flag(c.in, '-in')];
  const camera = pose ? poseWords(pose) : flight ? [] : cameraWords(c);
  const bodies = [...motion, ...time, ...camera];
  if (isRays) return [['ugphoton', ...bodies, '-look', c.look, ...colors(c), ...lens, name, ...output]];
  // Pieces of a draft are as large as its pixels allow.
  const pieces = isDraft ? ['-se', '.15px', '-sc', '1'] : [];
  if (isFlown) {
    // As ugfilm draws it.
    const [first, second] = ['uglorentz', 'ugdoppler'].map(program => of(program, words(c.more)));
    const sharp = c.look !== '1988' && !first.includes('-vr') ? ['-vr'] : [];
    const coarse = isDraft ? ['-sz', ...size.map(String), ...pieces] : [];
    return [['uglorentz', ...bodies, ...geometry(c), ...sharp, ...first, ...coarse, name], ['ugdoppler', '-look', c.look, ...second, ...colors(c)],
      ['ugrainbow', '-look', c.look, ...output]];
  }
  // The camera of a scene without one suits the shape of the picture.
  const isGiven = !isDraft && (3 * size[0] === 4 * size[1] || state.camera?.isMoved);
  const shape = isGiven ? [] : ['-sz', ...size.map(String)];
  const tinted = c.look === 'shape' ? [] : [['ugdoppler', ...flag(c.look === 'light', '-look', 'light'), ...colors(c)]];
  const tint = c.look === '1988' ? [] : ['-look', c.look];
  return [['uglorentz', ...bodies, ...geometry(c), ...shape, ...pieces, name], ...tinted, ['ugrainbow', ...tint, ...output]];
}

/**
 * The film of a flight, with rays or as the page draws it, in 4K or all around.
 * @param {Controls} c
 * @param {{ name: string, end: number, frames: number }} flight
 * @param {boolean} isPanorama
 */
export function film(c, { name, end, frames }, isPanorama = false) {
  const kind = state.isSky ? ['-warp', '--scene', name] : flag(c.rays || isPanorama, '-rays');
  const lens = isPanorama ? ['-pan'] : words(c.lens);
  const size = isPanorama ? ['4096', '2048'] : ['3840', '2160'];
  const effects = [...(c.rays || isPanorama || state.isSky ? [] : geometry(c)), ...colors(c)];
  const base = name.replace(/\.ug$/, isPanorama ? '-360' : '');
  return ['ugfilm', ...kind, '-frames', String(frames), '-ti', `0..${end}`, ...effects, '-look', c.look, ...flag(!!state.exposure, '-ex', state.exposure), ...lens,
    ...words(c.more), '-sz', ...size, '-fo', `${base}.mp4`, state.isSky ? state.name : name];
}

/** The name of the picture: that of the subject with another ending, and never its own. */
export function outputName(/** @type {string} */ ending, name = state.name) {
  const base = name.replace(/\.[^.]*$/, '') || 'picture';
  return `${base}.${ending}` === name ? `${base}-seen.${ending}` : `${base}.${ending}`;
}

/** The controls of the picture beside the one that is shown, and its title; `null` for none. */
export function compared(/** @type {Controls} */ c) {
  const isOwn = isMovingAs(c) === 'own';
  switch (c.compare) {
    case 'rest':
      return { title: 'at rest', controls: isOwn
        ? { ...c, noTime: true, noContraction: true, noDoppler: true, noFlux: true } : { ...c, beta: 0 } };
    case 'speed': return { title: `${c.other} c`, controls: { ...c, beta: c.other } };
    case 'time': return { title: 'without light travel time', controls: { ...c, noTime: true } };
    case 'contraction': return { title: 'without contraction', controls: { ...c, noContraction: true } };
    case 'doppler': return { title: 'without Doppler shift', controls: { ...c, noDoppler: true } };
    case 'flux': return { title: 'without change of brightness', controls: { ...c, noFlux: true } };
    case 'map': return { title: 'D in false colours', controls: { ...c, map: true } };
    default: return null;
  }
}
