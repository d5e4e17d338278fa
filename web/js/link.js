// Everything that is set, in the address behind `#`: short, for links and QR codes.

import { $, element } from './dom.js';
import { flying } from './flight.js';
import { DEFAULTS, controls, state } from './state.js';

/** Names of controls in links. */
const SHORT = /** @type {const} */ ({
  moves: 'm', beta: 'b', azimuth: 'z', climb: 'l', in: 'i', time: 't', look: 'k', rays: 'r', lens: 'n', size: 'w',
  dl: 'o', lg: 'g', gr: 'd', map: 'D', noTime: 'T', noContraction: 'C', noDoppler: 'P', noFlux: 'X',
  unit: 'u', light: 'c', more: 'q', compare: 'v', other: 'y', wiper: 'W',
});

const few = (/** @type {number[]} */ numbers) => numbers.map(number => Number(number.toPrecision(6))).join(',');
const many = (/** @type {string | null} */ text) => {
  const numbers = (text ?? '').split(',').map(Number);
  return text && numbers.every(Number.isFinite) ? numbers : null;
};

/** The part of the address behind `#`. `usual`: the controls that the scene begins with. */
export function hash(/** @type {Partial<import('./state.js').Controls>} */ usual) {
  const link = new URLSearchParams();
  link.set('s', state.files.map(([name]) => name).filter(name => name === state.name || !state.isBundled).join(','));
  const all = /** @type {Record<string, any>} */ (controls());
  const base = /** @type {Record<string, any>} */ ({ ...DEFAULTS, ...usual });
  for (const [name, key] of Object.entries(SHORT)) {
    const is = all[name];
    // A slider has steps, so that 0.95 may be 0.9499.
    const isSame = typeof is === 'number' ? Math.abs(is - base[name]) < 5e-4 : is === base[name];
    if (!isSame) link.set(key, typeof is === 'boolean' ? String(Number(is)) : String(is));
  }
  const { camera } = state;
  const pose = flying.pose();
  if (pose) link.set('p', few([...pose.event, ...pose.velocity, ...pose.view, ...pose.up]));
  else if (camera && state.isSky) link.set('e', few([camera.azimuth, camera.climb, camera.angle ?? 90]));
  else if (camera?.isMoved) link.set('e', few([camera.azimuth, camera.climb, camera.distance, ...camera.center]));
  return `#${link.toString().replaceAll('%2C', ',').replaceAll('+', '%20')}`;
}

/** The parts of such an address; `null` if it is none. */
export function parsed(/** @type {string} */ text) {
  const link = new URLSearchParams(text.replace(/^#/, ''));
  const files = (link.get('s') ?? '').split(',').filter(Boolean);
  if (files.length === 0) return null;
  /** @type {Record<string, any>} */
  const some = {};
  for (const [name, key] of Object.entries(SHORT)) {
    const value = link.get(key);
    if (value === null) continue;
    const kind = typeof (/** @type {Record<string, any>} */ (DEFAULTS)[name]);
    const number = Number(value);
    if (kind === 'string') some[name] = value;
    else if (kind === 'boolean') some[name] = value === '1';
    else if (Number.isFinite(number)) some[name] = number;
  }
  const pose = many(link.get('p'));
  const view = many(link.get('e'));
  const start = pose?.length === 13
    ? { event: pose.slice(0, 4), velocity: pose.slice(4, 7), view: pose.slice(7, 10), up: pose.slice(10) } : null;
  return { files, controls: some, start, view };
}

/** The camera of a link. */
export function viewed(/** @type {number[]} */ view) {
  const [azimuth, climb, third, ...center] = view;
  return state.isSky ? { azimuth, climb, angle: third, center: [0, 0, 0], distance: 1, isMoved: true }
    : { azimuth, climb, distance: third, center, angle: state.camera?.angle ?? null, isMoved: true };
}

/** Shows the link of what is seen, and its QR code. */
export function showLink() {
  $('address').value = location.href;
  const code = wasm_bindgen.qr_code(location.href);
  const size = Math.sqrt(code.length);
  let path = '';
  code.forEach((/** @type {number} */ dark, /** @type {number} */ k) => { if (dark) path += `M${k % size} ${Math.floor(k / size)}h1v1h-1z`; });
  $('code').innerHTML = size > 0
    ? `<svg viewBox="-4 -4 ${size + 8} ${size + 8}" role="img" aria-label="QR code of the link"><path fill="#fff" d="M-4-4H${size + 4}V${size + 4}H-4z"/><path d="${path}"/></svg>`
    : 'The link is too long for a QR code: leave out some options.';
  const isDisk = location.protocol === 'file:';
  $('linked').replaceChildren(...[
    isDisk && 'This page was opened from a disk, so the link works on this computer alone. On a site it works everywhere.',
    !state.isBundled && `Who opens it has to drop these files on the page: ${state.files.map(([name]) => name).join(', ')}.`,
  ].filter(Boolean).map(text => element('p', { textContent: text })));
  $('link').showModal();
}
