// The page: composes the commands of a picture from its controls, and shows what they draw.
'use strict';

const $ = id => document.getElementById(id);

/** Scenes to begin with: file, title, and controls that are not as in DEFAULTS. */
const SCENES = [
  ['teapot.ug', 'Teapot', { beta: .95, more: '' }],
  ['house.ug', 'House', { beta: .9, more: '-vr' }],
  ['ship.ug', 'Ship', { beta: .3, look: 'light' }],
  ['die.ug', 'Die', { beta: .9, more: '-vr' }],
  ['sphere.ug', 'Sphere', { beta: .95, dl: true }],
  ['poles.ug', 'Straight poles', { beta: .9 }],
  ['houses.ug', 'Three houses', { moves: 'own', look: 'light', more: '-vr' }],
  ['dice.ug', 'Five speeds', { moves: 'own', more: '-vr' }],
  ['street.ug', 'Drive down a street', { moves: 'cv', azimuth: 90, beta: .9, look: 'light', in: false }],
  ['lattice.ug', 'Rainbow in a lattice', { moves: 'cv', azimuth: 90, beta: .9, look: '1988', in: false }],
  ['tunnel.ug', 'Tunnel', { moves: 'cv', azimuth: 90, beta: .6, look: 'light', in: false }],
  ['traffic.ug', 'Traffic', { moves: 'own', in: false }],
  ['wheels.ug', 'Wheels', { moves: 'own', time: 8.7, size: '960 540', in: false }],
  ['clocks.ug', 'Clocks', { moves: 'own', in: false }],
  ['mirrors.ug', 'A mirror image lags', { moves: 'own', rays: true, more: '-bg .8 210 .25' }],
  ['shadow.ug', 'A shadow lags', { moves: 'own', rays: true, more: '-bg .8 210 .25' }],
  ['room.ug', 'A cube in a room', { moves: 'own', rays: true }],
  ['globe.obj', 'Globe (mesh)', { beta: .9 }],
  ['stars.csv', 'Stars (sky)', { beta: .9, azimuth: 90, look: 'light' }],
];

const DEFAULTS = { moves: 'vel', beta: .9, azimuth: 0, climb: 0, in: true, time: 0, look: 'shape', rays: false,
  lens: '', size: '640 480', dl: false, lg: false, gr: false, more: '' };

const MESHES = /\.(ug|obj|ply|stl|off|gltf|glb)$/i;
const PANORAMAS = /\.(png|jpe?g|hdr|exr|pfm)$/i;
const STARS = /\.csv$/i;

/** Milliseconds that a picture may take while one drags, and the least scale of its sides. */
const DRAFT_MS = 55;
const LEAST_SCALE = 1 / 8;
/** Scales of the pictures that come before a full one that takes long. */
const STAGES = [.25, .5];
/** Milliseconds without a change after which the full picture is drawn. */
const REST_MS = 180;

/** The subject, its camera, and the state that has no control. */
const state = { files: [], name: '', isSky: false, camera: null, azimuth: 0, scale: .5, turn: 0, format: 'png' };
let module, scenes;

// ---- The programs, in workers ---------------------------------------------------------------

/** A worker that does one task at a time. It is started when needed, with the files of the subject. */
class Studio {
  #worker = null;
  #task = null;
  #next = 0;

  get isBusy() { return this.#task !== null; }

  stop() {
    this.#worker?.terminate();
    this.#worker = null;
    this.#task?.reject('stopped');
    this.#task = null;
  }

  /** Does a task. Rejects with the message of a program, or with `stopped`. */
  run(task, commands) {
    if (!this.#worker) this.#start();
    return new Promise((resolve, reject) => {
      this.#task = { id: ++this.#next, resolve, reject };
      this.#worker.postMessage({ id: this.#next, task, commands });
    });
  }

  #start() {
    this.#worker = new Worker(workerUrl);
    this.#worker.onmessage = ({ data }) => this.#finish(data);
    this.#worker.onerror = event => this.#finish({ id: this.#task?.id, error: event.message, isDead: true });
    this.#worker.postMessage({ module, files: state.files });
  }

  #finish({ id, result, ms, error, isDead }) {
    const task = this.#task;
    if (!task || task.id !== id) return;
    this.#task = null;
    if (isDead) this.stop();
    if (error === undefined) task.resolve({ result, ms });
    else task.reject(error);
  }
}

/** Draws small pictures at once, and full ones, which may take long and are given up for newer ones. */
const draft = new Studio();
const full = new Studio();

// ---- Commands -------------------------------------------------------------------------------

/** A number in few digits. */
const digits = (number, places = 4) => String(Number(number.toFixed(places)));

const isRays = () => !state.isSky && $('rays').value === 'rays';
const beta = () => Math.round(1e3 * Math.tanh(+$('speed').value)) / 1e3;
const radians = degrees => degrees * Math.PI / 180;
const look = () => document.querySelector('[name=look]:checked').value;
const sides = () => $('size').value.split(' ').map(Number);
const scaled = scale => sides().map(side => Math.max(8, Math.round(side * scale)));

/** The unit vector of two angles in degrees. */
function direction(azimuth, climb) {
  const [a, c] = [radians(azimuth), radians(climb)];
  return [Math.cos(c) * Math.cos(a), Math.cos(c) * Math.sin(a), Math.sin(c)];
}

/** The words of a line, of which some may be quoted. */
function words(line) {
  return (line.match(/(?:[^\s'"]|'[^']*'|"[^"]*")+/g) || []).map(word => word.replace(/'([^']*)'|"([^"]*)"/g, '$1$2'));
}

const option = (name, numbers, places) => [name, ...numbers.map(number => digits(number, places))];

function motionWords() {
  const moves = state.isSky ? 'cv' : $('moves').value;
  if (moves === 'own') return [];
  const velocity = direction(state.azimuth, +$('climb').value).map(part => beta() * part);
  return option(`-${moves}`, velocity);
}

function cameraWords() {
  const camera = state.camera;
  if (!camera) return [];
  if (state.isSky) {
    const angle = $('lens').value ? [] : option('-va', [camera.angle], 1);
    return [...option('-vc', direction(camera.azimuth, camera.climb), 3), ...angle];
  }
  if (!camera.isMoved) return [];
  const places = Math.max(0, 3 - Math.floor(Math.log10(camera.distance)));
  return [...option('-ep', eye(camera), places), ...option('-vc', camera.center, places)];
}

/** The commands of the picture: the words of each program. `size`: another one than that of the page. */
function commands({ size = sides(), file = null, isDraft = false } = {}) {
  const output = [
    ...(file?.endsWith('.svg') && !isRays() && !state.isSky ? ['-vec'] : []),
    '-sz', ...size.map(String),
    ...($('dl').checked && !state.isSky ? ['-dl'] : []), ...($('gr').checked && !state.isSky ? ['-gr'] : []),
    ...($('lg').checked && !isDraft ? ['-lg'] : []), ...words($('more').value),
    ...(file ? ['-fo', file] : []),
  ];
  const lens = words($('lens').value);
  if (state.isSky) {
    return [['ugwarp', ...motionWords(), ...cameraWords(), '-look', look(), ...lens, state.name, ...output]];
  }
  const motion = [...motionWords(), ...($('in').checked ? ['-in'] : [])];
  const time = +$('time').value ? option('-ti', [+$('time').value], 3) : [];
  const bodies = [...motion, ...time, ...cameraWords()];
  if (isRays()) return [['ugphoton', ...bodies, '-look', look(), ...lens, state.name, ...output]];
  // The camera of a scene without one suits the shape of the picture.
  const shape = !isDraft && (3 * size[0] === 4 * size[1] || state.camera?.isMoved) ? [] : ['-sz', ...size.map(String)];
  // Pieces of a draft are as large as its pixels allow.
  const pieces = isDraft ? ['-se', '.15px', '-sc', '1'] : [];
  const tinted = look() === 'shape' ? [] : [['ugdoppler', ...(look() === 'light' ? ['-look', 'light'] : [])]];
  const tint = look() === '1988' ? [] : ['-look', look()];
  return [['uglorentz', ...bodies, ...shape, ...pieces, state.name], ...tinted, ['ugrainbow', ...tint, ...output]];
}

/** The name of the picture: that of the subject with another ending, and never its own. */
function outputName(ending) {
  const name = state.name.replace(/\.[^.]*$/, '') || 'picture';
  return `${name}.${ending}` === state.name ? `${name}-seen.${ending}` : `${name}.${ending}`;
}

// ---- Drawing --------------------------------------------------------------------------------

const canvas = $('picture');
const context = canvas.getContext('2d');
let restTimer;

/** Something has changed: a small picture at once, and the full one when nothing changes any more. */
function changed() {
  state.turn += 1;
  label();
  if (full.isBusy) full.stop();
  clearTimeout(restTimer);
  restTimer = setTimeout(drawFull, REST_MS);
  drawDraft();
}

async function drawDraft() {
  if (draft.isBusy || !state.name) return;
  const turn = state.turn;
  const answer = await attempt(draft, commands({ size: scaled(state.scale), isDraft: true }));
  if (answer) {
    show(answer, turn);
    const factor = Math.sqrt(DRAFT_MS / Math.max(1, answer.ms));
    state.scale = Math.min(1, Math.max(LEAST_SCALE, state.scale * Math.min(1.5, Math.max(.5, factor))));
  }
  if (state.turn !== turn && !full.isBusy) drawDraft();
}

async function drawFull() {
  if (!state.name) return;
  if (isPlaying) { restTimer = setTimeout(drawFull, REST_MS); return; }
  const turn = state.turn;
  const file = outputName(state.format);
  tell(await attempt(full, commands({ file }), 'lines'));
  for (const scale of STAGES.filter(stage => stage > state.scale)) {
    const coarse = turn === state.turn && await attempt(full, commands({ size: scaled(scale), isDraft: true }));
    if (coarse) show(coarse, turn);
  }
  const answer = turn === state.turn && await attempt(full, commands());
  if (!answer || turn !== state.turn) return;
  show(answer, turn);
  notes(answer.result.notes);
  const described = await attempt(full, commands(), 'describe');
  if (described && turn === state.turn) describe(described.result);
  state.drawn = turn;
}

/** Shows the picture as a line of a shell and in Python. */
function tell(told) {
  if (!told) return;
  $('shell').textContent = told.result.shell;
  $('python').textContent = told.result.python;
}

/** The result of a task, or `undefined` after the message about why there is none. */
async function attempt(studio, commands, task = 'draw') {
  try {
    const answer = await studio.run(task, commands);
    if (task === 'draw') $('message').hidden = true;
    return answer;
  } catch (error) {
    if (error !== 'stopped') complain(error);
  }
}

const plain = text => String(text).replace(/\x1b\[[0-9;]*m/g, '');

function complain(text) {
  $('message').textContent = plain(text);
  $('message').hidden = false;
  $('status').textContent = 'no picture';
}

function notes(text) {
  const lines = text ? plain(text).split('\n') : [];
  $('notes').replaceChildren(...lines.map(line => Object.assign(document.createElement('li'), { textContent: line })));
}

/** Shows a picture, unless that of a later turn is there. */
function show({ result: { width, height, pixels }, ms }, turn) {
  if (turn < (state.shown ?? 0)) return;
  state.shown = turn;
  const image = new ImageData(new Uint8ClampedArray(pixels.buffer, pixels.byteOffset, pixels.length), width, height);
  const [across, down] = sides();
  const isWhole = width >= across;
  const [w, h] = isWhole ? [width, height] : [across, down];
  if (canvas.width !== w || canvas.height !== h) {
    [canvas.width, canvas.height] = [w, h];
    $('stage').style.aspectRatio = `${w} / ${h}`;
    $('stage').style.setProperty('--aspect', w / h);
  }
  if (isWhole) {
    context.putImageData(image, 0, 0);
  } else {
    const small = new OffscreenCanvas(width, height);
    small.getContext('2d').putImageData(image, 0, 0);
    context.drawImage(small, 0, 0, w, h);
  }
  $('status').textContent = `${width} × ${height}, ${Math.round(ms)} ms`;
}

// ---- Camera ---------------------------------------------------------------------------------

function eye({ center, distance, azimuth, climb }) {
  return direction(azimuth, climb).map((part, axis) => center[axis] + distance * part);
}

/** The camera of the scene as the programs have it, and the times at which something is to be seen. */
function describe({ kind, eye, center, angle, times }) {
  if (kind === 'sky') {
    state.camera ??= { azimuth: 90, climb: 0, angle: 90 };
    return;
  }
  const offset = eye.map((part, axis) => part - center[axis]);
  const distance = Math.hypot(...offset);
  if (!state.camera?.isMoved && distance > 0) {
    const azimuth = Math.atan2(offset[1], offset[0]) * 180 / Math.PI;
    const climb = Math.asin(Math.max(-1, Math.min(1, offset[2] / distance))) * 180 / Math.PI;
    state.camera = { center, distance, azimuth, climb, isMoved: false, angle };
  }
  const time = $('time');
  const reach = 2 * distance || 10;
  const [first, last] = times ?? [null, null];
  const [low, high] = [first ?? -reach, last ?? reach];
  [time.min, time.max] = [Math.min(low, 0, +time.value), Math.max(high, 0, +time.value)];
  label();
}

/** Turns the camera of a sky, or moves it around a scene, by angles in degrees; and goes nearer by a factor. */
function turnCamera(across, up, factor = 1) {
  const camera = state.camera;
  if (!camera) return;
  camera.azimuth = ((camera.azimuth + across + 540) % 360) - 180;
  camera.climb = Math.max(-89, Math.min(89, camera.climb + up));
  if (state.isSky) camera.angle = Math.max(5, Math.min(150, camera.angle * factor));
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
  const b = beta();
  $('beta').textContent = `${b.toFixed(3)} c`;
  const moves = state.isSky ? 'cv' : $('moves').value;
  $('gamma').textContent = moves === 'own' ? 'The scene has its own velocities.'
    : `γ = ${(1 / Math.sqrt(1 - b * b)).toFixed(2)}. Drag the arrow: it is seen from above, and up is into the picture.`;
  $('climbed').textContent = `${$('climb').value}°`;
  $('ti').textContent = digits(+$('time').value, 2);
  ['speed', 'climb'].forEach(id => { $(id).disabled = moves === 'own'; });
  $('dial').style.opacity = moves === 'own' ? .35 : 1;
  ['by', 'clock', 'outline', 'grid', 'who', 'kept'].forEach(id => { $(id).hidden = state.isSky; });
  $('lenses').hidden = !state.isSky && !isRays();
  $('reset').textContent = state.isSky ? 'Look ahead' : 'Camera of the scene';
  $('help').textContent = 'Drag the picture to turn, roll the wheel to go nearer; arrow keys, + and − do the same.';
  const shown = radians(90 + state.azimuth - ahead());
  const length = Math.max(.12, Math.cos(radians(+$('climb').value))) * (10 + 36 * b);
  const at = (angle, r) => `${(r * Math.cos(angle)).toFixed(1)} ${(-r * Math.sin(angle)).toFixed(1)}`;
  $('arrow').setAttribute('d', `M${at(shown + Math.PI, length)} L${at(shown, length)} `
    + `M${at(shown + .35, length - 12)} L${at(shown, length)} L${at(shown - .35, length - 12)}`);
  $('axes').innerHTML = ['x', 'y'].map((name, row) => {
    const angle = radians(90 + 90 * row - ahead());
    return `<path class="axis" d="M0 0 L${at(angle, 38)}"/><text transform="translate(${at(angle, 44)})">${name}</text>`;
  }).join('');
  $('dial').setAttribute('aria-valuenow', Math.round(state.azimuth));
  $('dial').setAttribute('aria-valuetext', `${Math.round(state.azimuth)} degrees from x, climbing ${$('climb').value} degrees`);
}

/** Sets the controls. */
function set(controls) {
  const all = { ...DEFAULTS, ...controls };
  $('speed').value = Math.atanh(all.beta);
  state.azimuth = all.azimuth;
  [$('time').min, $('time').max] = [Math.min(-10, all.time), Math.max(10, all.time)];
  ['moves', 'climb', 'time', 'lens', 'size', 'more'].forEach(id => { $(id).value = all[id]; });
  ['in', 'dl', 'lg', 'gr'].forEach(id => { $(id).checked = all[id]; });
  $('rays').value = all.rays ? 'rays' : '';
  document.querySelector(`[name=look][value="${all.look}"]`).checked = true;
}

/** Takes files, of which the first that can be drawn is. */
async function take(files, controls = {}) {
  play(false);
  [draft, full].forEach(studio => studio.stop());
  $('message').hidden = true;
  const of = kind => files.find(([name]) => kind.test(name));
  const main = of(MESHES) ?? of(PANORAMAS) ?? of(STARS) ?? files[0];
  if (!main) return;
  const isSky = [PANORAMAS, STARS].some(kind => kind.test(main[0]));
  Object.assign(state, { files: [main, ...files.filter(file => file !== main)], name: main[0], isSky, camera: null,
    scale: .5, format: 'png', turn: state.turn + 1 });
  set(isSky ? { look: 'light', azimuth: 90, ...controls } : controls);
  canvas.setAttribute('aria-label', `Picture of ${state.name}`);
  ['shell', 'python'].forEach(id => { $(id).textContent = ''; });
  notes('');
  const described = await attempt(draft, commands({ isDraft: true }), 'describe');
  if (described) describe(described.result);
  if (described) changed(); else label();
}

async function read(list) {
  const files = await Promise.all([...list].map(async file => [file.name, new Uint8Array(await file.arrayBuffer())]));
  $('scene').value = '';
  await take(files);
}

let isPlaying = false;
function play(on) {
  isPlaying = on;
  $('play').setAttribute('aria-pressed', on);
  $('play').textContent = on ? '⏸ Pause' : '▶ Play';
  if (!on) return;
  let last = performance.now();
  const step = now => {
    if (!isPlaying) return;
    const time = $('time');
    const [low, high] = [+time.min, +time.max];
    const next = +time.value + (now - last) / 8000 * (high - low);
    last = now;
    time.value = next > high ? low : next;
    changed();
    requestAnimationFrame(step);
  };
  requestAnimationFrame(step);
}

async function save(format) {
  state.format = format;
  const file = outputName(format);
  clearTimeout(restTimer);
  full.stop();
  tell(await attempt(full, commands({ file }), 'lines'));
  const answer = await attempt(full, commands({ file }), 'file');
  if (!answer) return;
  const type = format === 'svg' ? 'image/svg+xml' : 'image/png';
  const link = document.createElement('a');
  link.href = URL.createObjectURL(new Blob([answer.result], { type }));
  link.download = file;
  link.click();
  setTimeout(() => URL.revokeObjectURL(link.href), 60000);
  drawFull();
}

async function copy(id) {
  const text = $(id).textContent;
  try {
    await navigator.clipboard.writeText(text);
  } catch {
    getSelection().selectAllChildren($(id));
    document.execCommand('copy');
  }
}

/** Calls `move` with how far a pointer is dragged on an element, and `pinch` with the factor of two. */
function onDrag(element, move, pinch = () => {}) {
  const pointers = new Map();
  const span = () => {
    const [a, b] = [...pointers.values()];
    return Math.hypot(a[0] - b[0], a[1] - b[1]);
  };
  element.addEventListener('pointerdown', event => {
    element.setPointerCapture(event.pointerId);
    pointers.set(event.pointerId, [event.clientX, event.clientY]);
    move(event, 0, 0);
  });
  element.addEventListener('pointermove', event => {
    const last = pointers.get(event.pointerId);
    if (!last) return;
    const before = pointers.size === 2 ? span() : 0;
    pointers.set(event.pointerId, [event.clientX, event.clientY]);
    if (pointers.size === 1) move(event, event.clientX - last[0], event.clientY - last[1]);
    if (pointers.size === 2) pinch(before / Math.max(1, span()));
  });
  ['pointerup', 'pointercancel'].forEach(kind => element.addEventListener(kind, event => pointers.delete(event.pointerId)));
}

/** Calls what `actions` have for a key. */
function onKeys(element, actions) {
  element.addEventListener('keydown', event => {
    if (!actions[event.key] || event.ctrlKey || event.metaKey || event.altKey) return;
    event.preventDefault();
    actions[event.key]();
  });
}

function pointArrow(azimuth) {
  state.azimuth = ((Math.round(azimuth) + 540) % 360) - 180;
  changed();
}

function climb(by) {
  $('climb').value = +$('climb').value + by;
  changed();
}

function listen() {
  $('controls').addEventListener('input', () => { state.format = 'png'; changed(); });
  $('controls').addEventListener('submit', event => event.preventDefault());
  $('scene').addEventListener('change', () => {
    const name = $('scene').value;
    const [, , controls] = SCENES.find(([file]) => file === name) ?? [];
    take([[name, new TextEncoder().encode(scenes[name])]], controls ?? { moves: 'own' });
  });
  $('open').addEventListener('click', () => $('files').click());
  $('files').addEventListener('change', () => { read($('files').files); $('files').value = ''; });
  $('play').addEventListener('click', () => play(!isPlaying));
  $('now').addEventListener('click', () => { play(false); $('time').value = 0; changed(); });
  $('png').addEventListener('click', () => save('png'));
  $('svg').addEventListener('click', () => save('svg'));
  $('reset').addEventListener('click', () => {
    if (!state.camera) return;
    if (state.isSky) Object.assign(state.camera, { azimuth: state.azimuth, climb: +$('climb').value, angle: 90 });
    else state.camera.isMoved = false;
    changed();
  });
  document.querySelectorAll('[data-copy]').forEach(button => button.addEventListener('click', () => copy(button.dataset.copy)));
  onDrag(canvas, (event, x, y) => {
    const degrees = state.isSky ? state.camera?.angle / canvas.clientWidth : .4;
    if (x || y) turnCamera((state.isSky ? degrees : -degrees) * x, degrees * y);
  }, factor => turnCamera(0, 0, factor));
  canvas.addEventListener('wheel', event => {
    event.preventDefault();
    turnCamera(0, 0, Math.exp(Math.sign(event.deltaY) * Math.min(.3, Math.abs(event.deltaY) / 800)));
  }, { passive: false });
  onKeys(canvas, {
    ArrowLeft: () => turnCamera(state.isSky ? 5 : -5, 0), ArrowRight: () => turnCamera(state.isSky ? -5 : 5, 0),
    ArrowUp: () => turnCamera(0, 5), ArrowDown: () => turnCamera(0, -5), '+': () => turnCamera(0, 0, .9), '-': () => turnCamera(0, 0, 1 / .9),
    ' ': () => play(!isPlaying),
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
    read(event.dataTransfer.files);
  });
}

// ---- Start ----------------------------------------------------------------------------------

/** The bytes that a script element holds: base64 of zlib. */
async function packed(id) {
  const bytes = Uint8Array.from(atob($(id).textContent), c => c.charCodeAt(0));
  const stream = new Blob([bytes]).stream().pipeThrough(new DecompressionStream('deflate'));
  return new Response(stream).arrayBuffer();
}

const workerUrl = URL.createObjectURL(new Blob([$('worker').textContent], { type: 'text/javascript' }));

async function start() {
  scenes = JSON.parse(new TextDecoder().decode(await packed('scenes')));
  module = await WebAssembly.compile(await packed('module'));
  const others = Object.keys(scenes).filter(name => !SCENES.some(([file]) => file === name)).map(name => [name, name]);
  const group = (title, list) => {
    const options = list.map(([file, name]) => new Option(name, file));
    const element = Object.assign(document.createElement('optgroup'), { label: title });
    element.append(...options);
    return element;
  };
  $('scene').append(group('To begin with', SCENES), group('More', others), new Option('your files', ''));
  listen();
  $('scene').value = SCENES[0][0];
  $('scene').dispatchEvent(new Event('change'));
}

start().catch(error => complain(`this browser cannot run the programs: ${error.message}`));
