// The page: its controls, the camera, and files.

import { commands, outputName } from './commands.js';
import { $, angles, clamp, digits, download, element, radians, turned } from './dom.js';
import { attempt, changed, complain, finished, pictureFile, renew, told, work } from './drawing.js';
import { flying, listenToFlight } from './flight.js';
import { say, showLesson } from './lesson.js';
import { hash, parsed, showLink, viewed } from './link.js';
import { SCENES } from './scenes.js';
import { controls, setControls, speed, state } from './state.js';
import { drafts, full, load, packed } from './studio.js';

const MESHES = /\.(ug|obj|ply|stl|off|gltf|glb)$/i;
const PANORAMAS = /\.(png|jpe?g|hdr|exr|pfm)$/i;
const STARS = /\.csv$/i;

/** @type {Record<string, Uint8Array>} */
const bundled = {};
/** @type {Record<string, import('./lesson.js').Lesson>} */
let lessons = {};
/** The controls that the scene begins with. @type {Partial<import('./state.js').Controls>} */
let usual = {};
/** What a link needs and nobody dropped yet. @type {ReturnType<typeof parsed>} */
let awaited = null;

const canvas = $('picture');

// ---- Camera ---------------------------------------------------------------------------------

/** The camera of the scene as the programs have it, and the times at which something is to be seen. */
function describe(/** @type {any} */ { kind, eye: from, center, angle, times, start }) {
  if (kind === 'sky') {
    state.camera ??= { azimuth: 90, climb: 0, angle: 90, center: [0, 0, 0], distance: 1, isMoved: false };
    return;
  }
  state.start = start;
  const offset = from.map((/** @type {number} */ part, /** @type {number} */ axis) => part - center[axis]);
  const distance = Math.hypot(...offset);
  if (!state.camera?.isMoved && distance > 0) {
    state.camera = { center, distance, ...angles(offset), isMoved: false, angle };
  }
  const time = $('time');
  const reach = 2 * distance || 10;
  const [first, last] = times ?? [null, null];
  const [low, high] = [first ?? -reach, last ?? reach];
  [time.min, time.max] = [Math.min(low, 0, +time.value), Math.max(high, 0, +time.value)];
  label();
}

/** Turns the camera of a sky, or moves it around a scene, by angles in degrees; and goes nearer by a factor. */
function turnCamera(/** @type {number} */ across, /** @type {number} */ up, factor = 1) {
  const camera = state.camera;
  if (!camera) return;
  camera.azimuth = turned(camera.azimuth + across);
  camera.climb = clamp(-89, camera.climb + up, 89);
  if (state.isSky) camera.angle = clamp(5, (camera.angle ?? 90) * factor, 150);
  else camera.distance *= factor;
  camera.isMoved = true;
  changed();
}

// ---- Controls -------------------------------------------------------------------------------

/** The azimuth that is up on the dial: that into the picture. */
function ahead() {
  if (!state.camera) return 90;
  return state.isSky ? state.camera.azimuth : state.camera.azimuth + 180;
}

/** What controls show beside them. */
function label() {
  const b = speed('speed');
  const c = controls();
  $('beta').textContent = `${b.toFixed(3)} c`;
  $('others').textContent = `${c.other.toFixed(3)} c`;
  const moves = state.isSky ? 'cv' : c.moves;
  const isOwn = moves === 'own' || flying.isOn;
  $('gamma').textContent = flying.isOn ? 'You fly: W and S accelerate.'
    : moves === 'own' ? 'The scene has its own velocities.'
      : `γ = ${(1 / Math.sqrt(1 - b * b)).toFixed(2)}. Drag the arrow: it is seen from above, and up is into the picture.`;
  $('climbed').textContent = `${c.climb}°`;
  $('ti').textContent = digits(c.time, 2);
  ['speed', 'climb', 'moves'].forEach(id => { $(id).disabled = isOwn && !(id === 'moves' && !flying.isOn); });
  $('dial').style.opacity = isOwn ? .35 : 1;
  ['by', 'outline', 'grid', 'who', 'kept', 'mapped'].forEach(id => { $(id).hidden = state.isSky; });
  $('clock').hidden = state.isSky || flying.isOn;
  const isRays = state.isSky || c.rays;
  $('lenses').hidden = !isRays;
  // Effects that the program or the look has.
  ['noTime', 'noContraction'].forEach(id => { $(id).disabled = isRays; });
  ['noDoppler', 'noFlux'].forEach(id => { $(id).disabled = c.look === 'shape'; });
  $('effects').textContent = [isRays && 'Rays always have both effects of place.',
    c.look === 'shape' && '“Shape” leaves out both effects of colour.'].filter(Boolean).join(' ');
  ['time', 'contraction'].forEach(name => { $('compare').querySelector(`[value=${name}]`).disabled = isRays; });
  ['doppler', 'flux'].forEach(name => { $('compare').querySelector(`[value=${name}]`).disabled = c.look === 'shape'; });
  $('versus').hidden = !c.compare;
  $('faster').hidden = c.compare !== 'speed';
  compare(c);
  flying.label();
  $('reset').textContent = state.isSky ? 'Look ahead' : 'Camera of the scene';
  $('reset').disabled = flying.isOn;
  const shown = radians(90 + state.azimuth - ahead());
  const length = Math.max(.12, Math.cos(radians(c.climb))) * (10 + 36 * b);
  const at = (/** @type {number} */ angle, /** @type {number} */ r) => `${(r * Math.cos(angle)).toFixed(1)} ${(-r * Math.sin(angle)).toFixed(1)}`;
  $('arrow').setAttribute('d', `M${at(shown + Math.PI, length)} L${at(shown, length)} `
    + `M${at(shown + .35, length - 12)} L${at(shown, length)} L${at(shown - .35, length - 12)}`);
  $('axes').innerHTML = ['x', 'y'].map((name, row) => {
    const angle = radians(90 + 90 * row - ahead());
    return `<path class="axis" d="M0 0 L${at(angle, 38)}"/><text transform="translate(${at(angle, 44)})">${name}</text>`;
  }).join('');
  $('dial').setAttribute('aria-valuenow', Math.round(state.azimuth));
  $('dial').setAttribute('aria-valuetext', `${Math.round(state.azimuth)} degrees from x, climbing ${c.climb} degrees`);
}

/** Shows one picture, or two. */
function compare(/** @type {import('./state.js').Controls} */ c) {
  const isTwo = !!c.compare;
  const stage = $('stage');
  stage.classList.toggle('two', isTwo);
  stage.classList.toggle('wiped', isTwo && c.wiper);
  stage.style.setProperty('--views', isTwo && !c.wiper ? 2 : 1);
  stage.style.setProperty('--wipe', `${$('wipe').value}%`);
  $('wipe').hidden = !(isTwo && c.wiper);
  $('besides').textContent = $('compare').selectedOptions[0]?.textContent ?? '';
}

/** A change of a control. */
function touched() {
  label();
  changed();
}

/** Takes files, of which the first that can be drawn is. */
async function take(/** @type {[string, Uint8Array][]} */ files, /** @type {Partial<import('./state.js').Controls>} */ some = {},
  isBundled = false, link = /** @type {ReturnType<typeof parsed>} */ (null)) {
  play(false);
  flying.end();
  const of = (/** @type {RegExp} */ kind) => files.find(([name]) => kind.test(name));
  const main = of(MESHES) ?? of(PANORAMAS) ?? of(STARS) ?? files[0];
  if (!main) return;
  const isSky = [PANORAMAS, STARS].some(kind => kind.test(main[0]));
  Object.assign(state, { files: [main, ...files.filter(file => file !== main)], name: main[0], isSky, isBundled,
    camera: null, start: null, format: 'png', turn: state.turn + 1 });
  usual = isSky ? { look: 'light', azimuth: 90, ...some } : some;
  setControls({ ...usual, ...link?.controls });
  renew();
  label();
  const turn = state.turn;
  canvas.setAttribute('aria-label', `Picture of ${state.name}`);
  ['shell', 'python'].forEach(id => { $(id).textContent = ''; });
  const title = SCENES.find(([file]) => file === state.name)?.[1] ?? state.name;
  showLesson(isBundled ? lessons[state.name.replace(/\.ug$/, '')] : undefined, title);
  const described = await attempt(drafts[0], commands(controls(), { isDraft: true }), 'describe');
  if (turn !== state.turn) return;
  if (!described) { label(); return; }
  describe(described.result);
  if (link?.view && !link.start) state.camera = viewed(link.view);
  if (link?.start) flying.begin(link.start);
  touched();
}

/** Takes a scene of the page. */
function choose(/** @type {string} */ name, link = /** @type {ReturnType<typeof parsed>} */ (null)) {
  const [, , some] = SCENES.find(([file]) => file === name) ?? [];
  // Scenes name their textures, which are few and small.
  const textures = MESHES.test(name) ? Object.keys(bundled).filter(file => PANORAMAS.test(file)) : [];
  const files = [name, ...textures].map(file => /** @type {[string, Uint8Array]} */ ([file, bundled[file]]));
  return take(files, some ?? { moves: 'own' }, true, link);
}

/** Takes files that people choose. */
async function read(/** @type {FileList} */ list) {
  const files = await Promise.all([...list].map(async file =>
    /** @type {[string, Uint8Array]} */ ([file.name, new Uint8Array(await file.arrayBuffer())])));
  const names = files.map(([name]) => name);
  const isAwaited = awaited && awaited.files.every(name => names.includes(name));
  $('scene').value = '';
  const link = isAwaited ? awaited : null;
  awaited = null;
  await take(files, {}, false, link);
}

/** Shows what a link has; `false` if it is none. */
function follow(/** @type {string} */ text) {
  const link = parsed(text);
  if (!link) return false;
  const [name] = link.files;
  if (bundled[name]) {
    $('scene').value = name;
    choose(name, link);
  } else {
    awaited = link;
    complain(`this link needs files that are not in the page: drop ${link.files.join(', ')} here`);
  }
  return true;
}

let isPlaying = false;
function play(/** @type {boolean} */ on) {
  isPlaying = on;
  $('play').setAttribute('aria-pressed', on);
  $('play').textContent = on ? '⏸ Pause' : '▶ Play';
  if (!on) return;
  let last = performance.now();
  const isReduced = matchMedia('(prefers-reduced-motion: reduce)').matches;
  const step = (/** @type {number} */ now) => {
    if (!isPlaying) return;
    requestAnimationFrame(step);
    // Where the system asks for no motion, a step a second.
    if (isReduced && now - last < 1000) return;
    const time = $('time');
    const [low, high] = [+time.min, +time.max];
    const next = +time.value + Math.min(1000, now - last) / 8000 * (high - low);
    last = now;
    time.value = next > high ? low : next;
    touched();
  };
  requestAnimationFrame(step);
}

async function save(/** @type {string} */ format) {
  const saved = await pictureFile(format);
  if (saved) download(saved.file, saved.bytes, format === 'svg' ? 'image/svg+xml' : 'image/png');
}

/** Shows the picture as a line of a shell and in Python, and the flight as a film. */
function tell() {
  const way = flying.way();
  const file = outputName(state.format, way?.flight.name ?? state.name);
  const line = JSON.stringify(commands(controls(), { ...way, file }));
  const shell = (/** @type {string} */ json) => wasm_bindgen.Studio.line(json);
  try {
    $('shell').textContent = shell(line);
    $('python').textContent = wasm_bindgen.Studio.python(line);
  } catch {
    // The program that draws says what is wrong.
  }
  const films = flying.lines();
  $('films').hidden = films.length === 0;
  $('film').textContent = films.map(film => shell(JSON.stringify([film]))).join('\n');
}

async function copy(/** @type {string} */ id) {
  const text = $(id).value ?? $(id).textContent;
  try {
    await navigator.clipboard.writeText(text);
  } catch {
    if ($(id).select) $(id).select(); else getSelection()?.selectAllChildren($(id));
    document.execCommand('copy');
  }
}

/**
 * Calls `move` with how far a pointer is dragged on an element, and `pinch` with the factor of two.
 * @param {HTMLElement} target
 * @param {(event: PointerEvent, x: number, y: number) => void} move
 * @param {(factor: number) => void} pinch
 */
function onDrag(target, move, pinch = () => {}) {
  /** @type {Map<number, number[]>} */
  const pointers = new Map();
  const span = () => {
    const [a, b] = [...pointers.values()];
    return Math.hypot(a[0] - b[0], a[1] - b[1]);
  };
  target.addEventListener('pointerdown', event => {
    target.setPointerCapture(event.pointerId);
    pointers.set(event.pointerId, [event.clientX, event.clientY]);
    move(event, 0, 0);
  });
  target.addEventListener('pointermove', event => {
    const last = pointers.get(event.pointerId);
    if (!last) return;
    const before = pointers.size === 2 ? span() : 0;
    pointers.set(event.pointerId, [event.clientX, event.clientY]);
    if (pointers.size === 1) move(event, event.clientX - last[0], event.clientY - last[1]);
    if (pointers.size === 2) pinch(before / Math.max(1, span()));
  });
  const lift = (/** @type {PointerEvent} */ event) => pointers.delete(event.pointerId);
  target.addEventListener('pointerup', lift);
  target.addEventListener('pointercancel', lift);
}

/** Calls what `actions` have for a key. */
function onKeys(/** @type {HTMLElement} */ target, /** @type {Record<string, () => void>} */ actions) {
  target.addEventListener('keydown', event => {
    if (!actions[event.key] || event.ctrlKey || event.metaKey || event.altKey) return;
    if (flying.isOn && event.key.startsWith('Arrow')) return;
    event.preventDefault();
    actions[event.key]();
  });
}

function pointArrow(/** @type {number} */ azimuth) {
  state.azimuth = turned(Math.round(azimuth));
  touched();
}

function climb(/** @type {number} */ by) {
  $('climb').value = +$('climb').value + by;
  touched();
}

/** Drags of the picture turn the camera, or the head of who flies. */
function dragPicture(/** @type {number} */ x, /** @type {number} */ y) {
  if (!x && !y) return;
  const angle = state.camera?.angle ?? 40;
  if (flying.isOn) { flying.look(radians(-angle * x / canvas.clientWidth), radians(-angle * y / canvas.clientWidth)); return; }
  const scale = state.isSky ? angle / canvas.clientWidth : .4;
  turnCamera((state.isSky ? scale : -scale) * x, scale * y);
}

function zoom(/** @type {number} */ factor) {
  if (!flying.isOn) turnCamera(0, 0, factor);
}

function listen() {
  $('controls').addEventListener('input', () => { state.format = 'png'; touched(); });
  $('controls').addEventListener('submit', (/** @type {Event} */ event) => event.preventDefault());
  $('scene').addEventListener('change', () => { if ($('scene').value) choose($('scene').value); });
  $('open').addEventListener('click', () => $('files').click());
  $('files').addEventListener('change', () => { read($('files').files); $('files').value = ''; });
  $('play').addEventListener('click', () => play(!isPlaying));
  $('now').addEventListener('click', () => { play(false); $('time').value = 0; touched(); });
  $('png').addEventListener('click', () => save('png'));
  $('svg').addEventListener('click', () => save('svg'));
  $('stop').addEventListener('click', () => { play(false); work.stop(); });
  $('wipe').addEventListener('input', () => compare(controls()));
  $('reset').addEventListener('click', () => {
    if (!state.camera) return;
    if (state.isSky) Object.assign(state.camera, { azimuth: state.azimuth, climb: +$('climb').value, angle: 90 });
    else state.camera.isMoved = false;
    touched();
  });
  $('linker').addEventListener('click', showLink);
  $('screen').addEventListener('click', () => document.fullscreenElement ? document.exitFullscreen() : $('stage').requestFullscreen());
  $('projector').addEventListener('click', () => {
    const isOn = document.body.classList.toggle('projected');
    $('projector').setAttribute('aria-pressed', String(isOn));
  });
  document.querySelectorAll('[data-click]').forEach(button =>
    button.addEventListener('click', () => $(/** @type {HTMLElement} */ (button).dataset.click ?? '').click()));
  $('printer').addEventListener('click', () => print());
  document.querySelectorAll('[data-copy]').forEach(button =>
    button.addEventListener('click', () => copy(/** @type {HTMLElement} */ (button).dataset.copy ?? '')));
  onDrag(canvas, (event, x, y) => dragPicture(x, y), zoom);
  canvas.addEventListener('wheel', (/** @type {WheelEvent} */ event) => {
    event.preventDefault();
    zoom(Math.exp(Math.sign(event.deltaY) * Math.min(.3, Math.abs(event.deltaY) / 800)));
  }, { passive: false });
  const side = () => state.isSky ? 5 : -5;
  onKeys(canvas, {
    ArrowLeft: () => turnCamera(side(), 0), ArrowRight: () => turnCamera(-side(), 0),
    ArrowUp: () => turnCamera(0, 5), ArrowDown: () => turnCamera(0, -5), '+': () => zoom(.9), '-': () => zoom(1 / .9),
    ' ': () => { if (flying.isOn) $('own').click(); else play(!isPlaying); },
  });
  onDrag($('dial'), event => {
    const box = $('dial').getBoundingClientRect();
    const [x, y] = [event.clientX - box.x - box.width / 2, event.clientY - box.y - box.height / 2];
    if (x || y) pointArrow(Math.atan2(-y, x) * 180 / Math.PI - 90 + ahead());
  });
  onKeys($('dial'), {
    ArrowLeft: () => pointArrow(state.azimuth + 5), ArrowRight: () => pointArrow(state.azimuth - 5),
    ArrowUp: () => climb(5), ArrowDown: () => climb(-5),
  });
  addEventListener('dragover', event => { event.preventDefault(); $('drop').hidden = false; });
  addEventListener('dragleave', event => { $('drop').hidden = event.relatedTarget === null; });
  addEventListener('drop', event => {
    event.preventDefault();
    $('drop').hidden = true;
    if (event.dataTransfer) read(event.dataTransfer.files);
  });
  addEventListener('hashchange', () => follow(location.hash));
  listenToFlight(touched);
  told.push(tell);
  finished.push(async isNow => {
    history.replaceState(null, '', hash(usual));
    $('out').href = location.href.replace(/[?]embed/, '');
    if (flying.isOn) return;
    const answer = await attempt(full, commands(controls()), 'describe');
    if (answer && isNow()) describe(answer.result);
  });
  finished.push(say);
  setInterval(work.tick, 100);
}

// ---- Start ----------------------------------------------------------------------------------

async function start() {
  const text = new TextDecoder();
  /** @type {Record<string, string | number[]>} */
  const scenes = JSON.parse(text.decode(await packed('scenes')));
  for (const [name, content] of Object.entries(scenes)) {
    bundled[name] = typeof content === 'string' ? new TextEncoder().encode(content) : new Uint8Array(content);
  }
  lessons = JSON.parse(text.decode(await packed('lessons')));
  await load();
  const isDrawn = (/** @type {string} */ name) => MESHES.test(name) || STARS.test(name);
  const others = Object.keys(bundled).filter(name => isDrawn(name) && !SCENES.some(([file]) => file === name));
  const group = (/** @type {string} */ title, /** @type {string[][]} */ list) =>
    element('optgroup', { label: title }, ...list.map(([file, name]) => new Option(name, file)));
  $('scene').append(group('To begin with', SCENES.map(([file, title]) => [file, title])),
    group('More', others.map(name => [name, name])), new Option('your files', ''));
  const isFramed = new URLSearchParams(location.search).has('embed');
  document.body.classList.toggle('embedded', isFramed);
  listen();
  if (!follow(location.hash)) {
    $('scene').value = SCENES[0][0];
    choose(SCENES[0][0]);
  }
}

start().catch(error => complain(`this browser cannot run the programs: ${error.message}`));
