// A flight by keys, mouse, touch or gamepad. The world line is that of the programs (`Flight` of ugweb), and what is
// flown is a `motion` that a scene can state.

import { film } from './commands.js';
import { $, brief, digits, direction, download, element } from './dom.js';
import { controls, state } from './state.js';

/**
 * @typedef {import('./state.js').Pose} Pose
 * @typedef {{ flight: { name: string, time: number }, exposure: string, files: [string, Uint8Array][] }} Way
 */

/** The real speed of light, m/s, and the acceleration of fall, m/s². */
const LIGHT = 299792458;
const G = 9.80665;

/** Lengths in metres, times in seconds, as `-unit` has the former. */
/** @type {Record<string, number>} */
const METERS = { m: 1, km: 1000, ls: LIGHT, au: 149597870700, ly: 9460730472580800 };
const SECONDS = [['ns', 1e-9], ['µs', 1e-6], ['ms', 1e-3], ['s', 1], ['min', 60], ['h', 3600], ['days', 86400], ['years', 31557600]];

/** Radians a second of the keys that turn. */
const TURN = .7;
/** Own time that a turn takes while time stands still, as part of a second's. */
const INSTANT = 1e-3;
/** @type {Record<string, string>} */
const KEYS = {
  w: 'forward', s: 'back', a: 'left', d: 'right', q: 'rollLeft', e: 'rollRight', r: 'up', f: 'down',
  ArrowLeft: 'left', ArrowRight: 'right', ArrowUp: 'noseUp', ArrowDown: 'noseDown', x: 'rest',
};

/** @type {any} The craft of the programs; `null` if nothing flies. */
let craft = null;
/** @type {Set<string>} What is held down: a key or a button. */
const held = new Set();
/** Turns of mouse and touch that are not flown yet: to the right and down, radians. */
let glance = [0, 0];
let own = 0;
/** @type {'' | 'fly' | 'replay'} */
let playing = '';
let lastFrame = 0;
/** Distance of what is ahead; `null` if that is not known. @type {number | null} */
let distanceAhead = null;
/** @type {() => void} */
let onChange = () => {};

/** Units of own time that pass in a second. */
const pace = () => 10 ** (+$('pace').value);
/** Proper acceleration of the keys, 1 by a unit of time. */
const thrust = () => 10 ** (+$('thrust').value) / pace();

export const flying = {
  get isOn() { return craft !== null; },
  get isPlaying() { return playing !== ''; },

  /** The camera now; `null` if nothing flies. */
  pose() { return craft && /** @type {Pose} */ (JSON.parse(craft.at(own))); },

  /** The camera of a picture beside: at rest, or at another speed. */
  posed(/** @type {string} */ compare, /** @type {import('./state.js').Controls} */ other) {
    const pose = flying.pose();
    if (!pose || !['rest', 'speed'].includes(compare)) return pose;
    const speed = compare === 'rest' ? 0 : other.beta;
    const now = Math.hypot(...pose.velocity);
    const along = now > 1e-9 ? pose.velocity.map((/** @type {number} */ part) => part / now) : pose.view;
    return { ...pose, velocity: along.map((/** @type {number} */ part) => speed * part), gamma: 1 / Math.sqrt(1 - speed * speed) };
  },

  /** How the full picture is drawn: as the film draws it. @returns {Way | null} */
  way() {
    if (!craft) return null;
    const name = fileName();
    return { flight: { name, time: own }, exposure: state.exposure, files: [[name, new TextEncoder().encode(text())]] };
  },

  /** The line of the film; empty if nothing is flown. */
  lines() {
    if (!craft || craft.end === 0) return [];
    const frames = Math.max(2, Math.min(9999, Math.round(25 * craft.end / pace())));
    const flight = { name: fileName(), end: craft.end, frames };
    return [film(controls(), flight), film(controls(), flight, true)];
  },

  /** Begins a flight where the scene's camera is, or somewhere else. */
  begin(/** @type {import('./state.js').Start | null} */ start = null) {
    const from = start ?? state.start ?? skyStart();
    if (!from) return;
    craft?.free();
    craft = new wasm_bindgen.Flight(JSON.stringify(from));
    own = 0;
    playing = '';
    setPace(from);
    showInstruments();
    onChange();
  },

  /** Ends the flight: the camera is that of the scene again. */
  end() {
    if (!craft) return;
    craft.free();
    craft = null;
    playing = '';
    held.clear();
    showInstruments();
    onChange();
  },

  play(/** @type {'' | 'fly' | 'replay'} */ how) {
    if (!craft || playing === how) return;
    if (how === 'replay') own = 0;
    if (how === 'fly') own = craft.end;
    playing = how;
    lastFrame = performance.now();
    if (how) requestAnimationFrame(frame);
    showInstruments();
    onChange();
  },

  /** Turns by what was dragged on the picture, radians. */
  look(/** @type {number} */ right, /** @type {number} */ down) {
    glance = [glance[0] + right, glance[1] + down];
    if (!playing) stepBy(0);
  },

  press(/** @type {string} */ what, /** @type {boolean} */ isDown) {
    if (isDown) held.add(what); else held.delete(what);
    if (!isDown || playing === 'fly') return;
    const isTurn = ['left', 'right', 'noseUp', 'noseDown', 'rollLeft', 'rollRight'].includes(what);
    if (isTurn) turnStanding(); else flying.play('fly');
  },

  /** Where it is now, for links. */
  where() { return flying.pose(); },

  save() {
    if (!craft) return;
    download(fileName(), text(), 'text/plain');
  },

  /** What is ahead, as an explained pixel has it. */
  setAhead(/** @type {number | null} */ distance) {
    distanceAhead = distance;
    showInstruments();
  },

  label: showInstruments,
};

/** The beginning of a flight through a sky, which has no places. */
function skyStart() {
  const c = controls();
  const camera = state.camera;
  if (!state.isSky || !camera) return null;
  const velocity = direction(c.azimuth, c.climb).map(part => c.beta * part);
  return { event: [0, 0, 0, 0], velocity, view: direction(camera.azimuth, camera.climb), up: [0, 0, 1] };
}

/** A second is so long that what the camera looks at is reached in some seconds at half the speed of light. */
function setPace(/** @type {import('./state.js').Start} */ { view }) {
  const reach = Math.max(.01, state.isSky ? 1 : state.camera?.distance ?? Math.hypot(...view));
  $('pace').value = Math.log10(reach / 4);
}

/** A name that no file of the scene has. */
function motionName() {
  const others = state.files.map(([, bytes]) => new TextDecoder().decode(bytes.subarray(0, 1e6))).join('\n');
  let name = 'flight';
  for (let k = 2; others.includes(name); k++) name = `flight${k}`;
  return name;
}

const fileName = () => `${state.name.replace(/\.[^.]*$/, '')}-flight.ug`;

/** The scene with the flight as a motion, and a camera on it. */
function text() {
  const angle = state.camera?.angle ?? undefined;
  const quoted = /^[\w.-]+$/.test(state.name) ? state.name : `"${state.name}"`;
  const scene = state.isSky ? '' : `include ${quoted} ;\n`;
  return `{ A flight through ${state.name}, of own time 0 to ${craft.end}. }\n${craft.statements(motionName(), angle)}${scene}`;
}

const isReduced = () => matchMedia('(prefers-reduced-motion: reduce)').matches;

function frame(/** @type {number} */ now) {
  if (!craft || !playing) return;
  const passed = Math.min(.1, (now - lastFrame) / 1000);
  // Where the system asks for no motion, a step a second.
  if (isReduced() && now - lastFrame < 1000) { requestAnimationFrame(frame); return; }
  lastFrame = now;
  if (playing === 'fly') {
    stepBy(passed * pace());
  } else {
    own = Math.min(craft.end, own + passed * pace());
    onChange();
    if (own >= craft.end) flying.play('');
  }
  showInstruments();
  requestAnimationFrame(frame);
}

/** Turns by keys while time stands still. */
function turnStanding() {
  let last = performance.now();
  const step = (/** @type {number} */ now) => {
    if (!craft || playing || held.size === 0) return;
    const passed = Math.min(.1, (now - last) / 1000);
    last = now;
    const [forward, , , roll, pitch, yaw] = inputs();
    if (forward) { flying.play('fly'); return; }
    stepBy(0, [roll * passed, pitch * passed, yaw * passed]);
    requestAnimationFrame(step);
  };
  requestAnimationFrame(step);
}

/** Thrust forward, right and up as parts of the most, and turns about these axes in radians a second. */
function inputs() {
  const is = (/** @type {string} */ plus, /** @type {string} */ minus) => Number(held.has(plus)) - Number(held.has(minus));
  const isSideways = held.has('sideways');
  const sum = [
    is('forward', 'back'), isSideways ? is('right', 'left') : 0, is('up', 'down'),
    TURN * is('rollRight', 'rollLeft'), TURN * is('noseUp', 'noseDown'), isSideways ? 0 : TURN * is('left', 'right'),
  ];
  const pad = navigator.getGamepads?.().find(Boolean);
  if (pad) {
    const axis = (/** @type {number} */ k) => Math.abs(pad.axes[k] ?? 0) > .12 ? pad.axes[k] : 0;
    const button = (/** @type {number} */ k) => pad.buttons[k]?.value ?? 0;
    const parts = [button(7) - button(6) - axis(1), axis(0), 0,
      TURN * (button(5) - button(4)), -2 * TURN * axis(3), -2 * TURN * axis(2)];
    parts.forEach((part, k) => { sum[k] += part; });
  }
  if (held.has('rest')) {
    // Against the course, as it is seen from the camera, and no longer than it takes.
    const { course, gamma } = /** @type {Pose} */ (flying.pose());
    const length = Math.hypot(...course);
    const needed = Math.acosh(Math.max(1, gamma)) / (thrust() * pace() / 30);
    course.forEach((part, k) => { sum[k] = length > 0 ? -part / length * Math.min(1, needed) : 0; });
  }
  return sum;
}

/** Flies on for some own time; turns of hands take next to none while time stands still. */
function stepBy(/** @type {number} */ passed, standing = [0, 0, 0]) {
  const isTurned = glance.some(part => part !== 0) || standing.some(part => part !== 0);
  if (!craft || (passed === 0 && !isTurned)) return;
  if (own < craft.end) own = craft.end;
  const [forward, right, up, roll, pitch, yaw] = passed > 0 ? inputs() : [0, 0, 0, 0, 0, 0];
  const own_time = passed > 0 ? passed : Math.max(1e-6, INSTANT * pace());
  const push = [forward, right, up].map(part => part * thrust());
  const hand = [standing[0], standing[1] - glance[1], standing[2] - glance[0]].map(part => part / own_time);
  const turn = [roll, pitch, yaw].map((part, k) => part / pace() + hand[k]);
  [glance, distanceAhead] = [[0, 0], null];
  craft.step(own_time, new Float64Array(push), new Float64Array(turn));
  own = craft.end;
  showInstruments();
  onChange();
}

/** A time in seconds, in a unit that suits it. */
function seconds(/** @type {number} */ time) {
  const [name, of] = SECONDS.filter(([, of]) => Math.abs(time) >= Number(of)).pop() ?? SECONDS[0];
  return `${digits(time / Number(of), 2)} ${name}`;
}

/** The instrument line. */
function showInstruments() {
  $('flown').hidden = !craft;
  document.body.classList.toggle('flying', craft !== null);
  $('fly').textContent = craft ? 'Leave the cockpit' : 'Fly';
  $('fly').setAttribute('aria-pressed', String(craft !== null));
  ['home', 'own', 'replay', 'record'].forEach(id => { $(id).disabled = !craft; });
  $('own').textContent = playing === 'fly' ? '⏸ Pause' : '▶ Own time';
  $('replay').textContent = playing === 'replay' ? '⏸ Pause' : '↺ Replay';
  $('pad').hidden = !craft;
  const { unit, light } = controls();
  const meters = METERS[unit];
  const c = light ? parseFloat(light) / 3.6 : LIGHT;
  const time = meters ? meters / c : 0;
  const inTime = (/** @type {number} */ units) => time ? seconds(units * time) : digits(units, 2);
  const inLength = (/** @type {number} */ units) => meters ? `${brief(units)} ${unit}` : brief(units);
  const acceleration = thrust() * c / time;
  $('paced').textContent = `1 s = ${inTime(pace())}`;
  $('pushed').textContent = time ? `${brief(acceleration / G)} g` : `${brief(thrust())} c/unit`;
  $('lit').textContent = light ? `${light.replace('km/h', ' km/h')}` : 'real';
  if (!craft) return;
  const { event, velocity, gamma } = /** @type {Pose} */ (flying.pose());
  const speed = Math.hypot(...velocity);
  const push = playing === 'fly' ? inputs().slice(0, 3).map(part => part * thrust()) : [0, 0, 0];
  const a = Math.hypot(...push);
  const rows = [
    ['own time', inTime(own)], ['time of the scene', inTime(event[0])],
    ['speed', `${digits(speed, speed > .999 ? 6 : 3)} c = ${kmh(speed * c)}`], ['γ', digits(gamma, 3)],
    ['felt', time ? `${brief(a * c / time / G)} g` : `${brief(a)} c per unit of time`],
    ['ahead', distanceAhead === null ? '–' : inLength(distanceAhead)],
  ];
  $('instruments').replaceChildren(...rows.flatMap(([name, value]) =>
    [element('dt', { textContent: name }), element('dd', { textContent: value })]));
}

const kmh = (/** @type {number} */ speed) => speed < 3e6 ? `${brief(speed * 3.6)} km/h` : `${Math.round(speed / 1000).toLocaleString('en')} km/s`;

/** Buttons and keys of a flight. `change`: what happens when the camera is somewhere else. */
export function listenToFlight(/** @type {() => void} */ change) {
  onChange = change;
  $('fly').addEventListener('click', () => { if (craft) flying.end(); else flying.begin(); $('picture').focus(); });
  $('home').addEventListener('click', () => flying.begin());
  $('own').addEventListener('click', () => flying.play(playing === 'fly' ? '' : 'fly'));
  $('replay').addEventListener('click', () => flying.play(playing === 'replay' ? '' : 'replay'));
  $('record').addEventListener('click', () => flying.save());
  ['pace', 'thrust'].forEach(id => $(id).addEventListener('input', (/** @type {Event} */ event) => { event.stopPropagation(); showInstruments(); }));
  addEventListener('keydown', event => {
    if (isTyping(event.target) || event.ctrlKey || event.metaKey || event.altKey) return;
    const what = keyOf(event);
    if (!what || (event.key.startsWith('Arrow') && event.target !== $('picture'))) return;
    if (!craft) {
      if (event.key.startsWith('Arrow') || !state.name) return;
      flying.begin();
    }
    event.preventDefault();
    if (event.shiftKey) held.add('sideways'); else held.delete('sideways');
    if (!event.repeat) flying.press(what, true);
  });
  addEventListener('keyup', event => {
    const what = keyOf(event);
    if (event.key === 'Shift') held.delete('sideways');
    if (what) flying.press(what, false);
  });
  addEventListener('blur', () => held.clear());
  document.querySelectorAll('[data-press]').forEach(button => {
    const what = /** @type {HTMLElement} */ (button).dataset.press ?? '';
    const press = (/** @type {boolean} */ isDown) => (/** @type {Event} */ event) => { event.preventDefault(); flying.press(what, isDown); };
    button.addEventListener('pointerdown', press(true));
    ['pointerup', 'pointerleave', 'pointercancel'].forEach(kind => button.addEventListener(kind, press(false)));
  });
  addEventListener('gamepadconnected', () => { if (state.name && !craft) flying.begin(); flying.play('fly'); });
}

/** What a key does. */
const keyOf = (/** @type {KeyboardEvent} */ { key }) => KEYS[key.length === 1 ? key.toLowerCase() : key];

/** Keys are text there. */
function isTyping(/** @type {EventTarget | null} */ target) {
  const at = /** @type {any} */ (target);
  return ['SELECT', 'TEXTAREA'].includes(at?.tagName) || (at?.tagName === 'INPUT' && at.type === 'text');
}
