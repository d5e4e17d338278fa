// What is seen, and how: the controls, and the state that has no control.

import { $ } from './dom.js';

/**
 * A camera: around a centre, or, for a sky, of an angle.
 * @typedef {{ center: number[], distance: number, azimuth: number, climb: number, angle: number | null, isMoved: boolean }} Camera
 *
 * Where and how a flight begins, or is.
 * @typedef {{ event: number[], velocity: number[], view: number[], up: number[] }} Start
 * @typedef {Start & { gamma: number, course: number[] }} Pose
 *
 * @typedef {{
 *   moves: string, beta: number, azimuth: number, climb: number, in: boolean, time: number,
 *   look: string, rays: boolean, lens: string, size: string, dl: boolean, lg: boolean, gr: boolean, map: boolean,
 *   noTime: boolean, noContraction: boolean, noDoppler: boolean, noFlux: boolean,
 *   unit: string, light: string, more: string,
 *   compare: string, other: number, wiper: boolean,
 * }} Controls
 */

/** @type {Controls} */
export const DEFAULTS = {
  moves: 'vel', beta: .9, azimuth: 0, climb: 0, in: true, time: 0,
  look: 'shape', rays: false, lens: '', size: '640 480', dl: false, lg: false, gr: false, map: false,
  noTime: false, noContraction: false, noDoppler: false, noFlux: false,
  unit: '', light: '', more: '',
  compare: '', other: 0, wiper: false,
};

export const state = {
  /** @type {[string, Uint8Array][]} */
  files: [],
  name: '',
  isSky: false,
  /** The page has the files of the subject. */
  isBundled: true,
  /** @type {Camera | null} */
  camera: null,
  /** @type {Start | null} Where a flight begins. */
  start: null,
  azimuth: 0,
  format: 'png',
  /** The exposure of the full picture in a flight, in stops, where it is found automatically. */
  exposure: '',
  /** Counts changes. */
  turn: 0,
  /** The last change whose full picture is shown. */
  drawn: -1,
};

const FLAGS = /** @type {const} */ (['in', 'dl', 'lg', 'gr', 'map', 'noTime', 'noContraction', 'noDoppler', 'noFlux', 'wiper']);
const TEXTS = /** @type {const} */ (['moves', 'lens', 'size', 'unit', 'more', 'compare']);

/** The speed of light of the slider, as `-c` has it; empty for the real one. */
export function speedOfLight() {
  const speed = 30 * 10 ** (+$('light').value);
  if (+$('light').value >= +$('light').max) return '';
  return `${Number(speed.toPrecision(2))}km/h`;
}

export const speed = (/** @type {string} */ id) => Math.round(1e3 * Math.tanh(+$(id).value)) / 1e3;
export const look = () => /** @type {any} */ (document.querySelector('[name=look]:checked')).value;

/** The controls as they are. */
export function controls() {
  /** @type {any} */
  const all = {
    beta: speed('speed'), azimuth: state.azimuth, climb: +$('climb').value, time: +$('time').value,
    look: look(), rays: $('rays').value === 'rays', light: speedOfLight(), other: speed('other'),
  };
  FLAGS.forEach(id => { all[id] = $(id).checked; });
  TEXTS.forEach(id => { all[id] = $(id).value; });
  return /** @type {Controls} */ (all);
}

/** Sets the controls. */
export function setControls(/** @type {Partial<Controls>} */ some) {
  const all = { ...DEFAULTS, ...some };
  $('speed').value = Math.atanh(all.beta);
  $('other').value = Math.atanh(all.other);
  state.azimuth = all.azimuth;
  [$('time').min, $('time').max] = [Math.min(-10, all.time), Math.max(10, all.time)];
  $('time').value = all.time;
  $('climb').value = all.climb;
  $('rays').value = all.rays ? 'rays' : '';
  $('light').value = all.light ? Math.log10(parseFloat(all.light) / 30) : $('light').max;
  const isListed = [...$('size').options].some(option => option.value === all.size);
  if (!isListed) $('size').add(new Option(all.size));
  TEXTS.forEach(id => { $(id).value = all[id]; });
  FLAGS.forEach(id => { $(id).checked = all[id]; });
  /** @type {any} */ (document.querySelector(`[name=look][value="${all.look}"]`) ?? $('shape')).checked = true;
}

/** Width and height of the picture. */
export const sides = () => $('size').value.split(' ').map(Number);
