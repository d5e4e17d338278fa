// Pictures: small ones at once, and the full one when nothing changes any more.

import { commands, compared, outputName } from './commands.js';
import { $, clamp, element, plain } from './dom.js';
import { flying } from './flight.js';
import { controls, sides, state } from './state.js';
import { drafts, full, stopAll } from './studio.js';

/** Milliseconds that a picture may take while something changes, of all workers together. */
const DRAFT_MS = 33;
/** The least size of a picture while something changes. */
const LEAST = [240, 135];
/** The part of a small picture's time below which fewer pixels do not help. */
const HELPS = .25;
/** Milliseconds without a change after which the full picture is drawn. */
const REST_MS = 180;
/** Milliseconds after which the page shows that it works, and after which an old picture of the same subject is dim. */
const SIGN_MS = 200;
const OLD_MS = 1200;

/** A picture on the page. */
class View {
  /** The last change that is asked for, and the one that is shown. */
  asked = -1;
  shown = -1;

  constructor(/** @type {string} */ id) {
    this.canvas = $(id);
    this.context = this.canvas.getContext('2d');
  }

  /** Shows a picture, unless that of a later change is there. */
  show(/** @type {import('./studio.js').Answer} */ { result: { width, height, pixels }, ms }, /** @type {number} */ turn) {
    if (turn < this.shown) return;
    this.shown = turn;
    const image = new ImageData(new Uint8ClampedArray(pixels.buffer, pixels.byteOffset, pixels.length), width, height);
    const [across, down] = sides();
    const isWhole = width >= across;
    const [w, h] = isWhole ? [width, height] : [across, down];
    if (this.canvas.width !== w || this.canvas.height !== h) {
      [this.canvas.width, this.canvas.height] = [w, h];
      $('stage').style.setProperty('--aspect', w / h);
    }
    if (isWhole) {
      this.context.putImageData(image, 0, 0);
    } else {
      const small = new OffscreenCanvas(width, height);
      /** @type {any} */ (small.getContext('2d')).putImageData(image, 0, 0);
      this.context.drawImage(small, 0, 0, w, h);
    }
    pictures.shown += 1;
    work.lastShown = performance.now();
    work.isNew = false;
    if (this === views[0]) $('status').textContent = `${width} × ${height}, ${Math.round(ms)} ms`;
  }
}

export const views = [new View('picture'), new View('beside')];
/** How many pictures were shown. */
export const pictures = { shown: 0 };

/** The time of a small picture: a part for all of it, and one for each pixel. */
const cost = {
  fixed: 20, pixel: 5e-5,
  /** @type {Map<number, number>} Of the last few sizes. */
  seen: new Map(),
  learn(/** @type {number} */ pixels, /** @type {number} */ ms) {
    this.seen.delete(pixels);
    this.seen.set(pixels, ms);
    if (this.seen.size > 3) this.seen.delete([...this.seen.keys()][0]);
    const sizes = [...this.seen.keys()].sort((a, b) => a - b);
    const [least, most] = [sizes[0], sizes[sizes.length - 1]];
    if (most > 1.2 * least) {
      const [low, high] = [this.seen.get(least) ?? 0, this.seen.get(most) ?? 0];
      this.pixel = Math.max(1e-6, (high - low) / (most - least));
      this.fixed = Math.max(0, low - this.pixel * least);
    } else {
      this.fixed = Math.max(0, ms - this.pixel * pixels);
    }
  },
};

/** The size of a small picture: as coarse as helps. */
function draftSize() {
  const [width, height] = sides();
  const isTwo = compared(controls()) !== null;
  const budget = DRAFT_MS * drafts.length / (isTwo ? 2 : 1);
  const forPixels = Math.max(budget - cost.fixed, HELPS * cost.fixed);
  const scale = Math.sqrt(forPixels / cost.pixel / (width * height));
  const least = Math.min(1, Math.max(LEAST[0] / width, LEAST[1] / height));
  // In steps, so that two sizes are compared often, and pictures do not change their size all the time.
  const steps = Math.floor(12 * clamp(least, scale, 1) + 1e-9);
  const factor = Math.max(least, steps / 12);
  return [width, height].map(side => Math.max(8, Math.ceil(side * factor)));
}

let restTimer = 0;

/** Something has changed: a small picture at once, and the full one when nothing changes any more. */
export function changed() {
  state.turn += 1;
  state.exposure = '';
  if (full.isBusy) full.stop();
  work.isStopped = false;
  work.since = Math.min(work.since, performance.now());
  clearTimeout(restTimer);
  restTimer = window.setTimeout(drawFull, REST_MS);
  pump();
}

/** What the views show: their controls and cameras. The second one is empty without a comparison. */
function wanted() {
  const c = controls();
  const other = compared(c);
  /** @type {({ controls: import('./state.js').Controls, pose: import('./state.js').Pose | null } | null)[]} */
  const all = [{ controls: c, pose: flying.pose() },
    other && { controls: other.controls, pose: flying.posed(c.compare, other.controls) }];
  return all;
}

/** Gives workers that are free the next small pictures. */
function pump() {
  if (!state.name || work.isStopped) return;
  wanted().forEach((picture, row) => {
    const view = views[row];
    const studio = drafts.find(worker => !worker.isBusy);
    if (picture && studio && view.asked < state.turn) drawDraft(view, studio, picture);
  });
}

async function drawDraft(/** @type {View} */ view, /** @type {import('./studio.js').Studio} */ studio,
  /** @type {{ controls: import('./state.js').Controls, pose: any }} */ picture) {
  const turn = state.turn;
  view.asked = turn;
  const size = draftSize();
  const answer = await attempt(studio, commands(picture.controls, { size, isDraft: true, pose: picture.pose }));
  if (answer) {
    view.show(answer, turn);
    cost.learn(size[0] * size[1], answer.ms);
  }
  pump();
}

async function drawFull() {
  if (!state.name || work.isStopped) return;
  if (flying.isPlaying || drafts.some(studio => studio.isBusy)) {
    restTimer = window.setTimeout(drawFull, REST_MS);
    return;
  }
  const turn = state.turn;
  const isNow = () => turn === state.turn;
  const all = wanted();
  const way = flying.way();
  told.forEach(tell => tell());
  // A picture that takes long is drawn in between, with half the sides.
  const [width, height] = sides();
  const isLong = cost.fixed + cost.pixel * width * height > 1000;
  for (const size of isLong ? [[width / 2, height / 2].map(Math.ceil)] : []) {
    const coarse = await attempt(full, commands(controls(), { size, isDraft: true, pose: flying.pose() }));
    if (coarse && isNow()) views[0].show(coarse, turn);
  }
  for (const [row, picture] of all.entries()) {
    if (!picture || !isNow()) continue;
    const full_way = row === 0 && way ? way : { pose: picture.pose };
    const files = row === 0 && way ? way.files : [];
    const answer = await attempt(full, commands(picture.controls, full_way), 'draw', files);
    if (!answer || !isNow()) return;
    views[row].show(answer, turn);
    if (row === 0) notes(answer.result.notes);
    if (row === 0 && way && !way.exposure) {
      // A film has one exposure, so its line, and that of the picture, state the one of this moment.
      state.exposure = /exposure is (\S+) stops/.exec(plain(answer.result.notes))?.[1] ?? '';
      told.forEach(tell => tell());
    }
  }
  if (!isNow()) return;
  state.drawn = turn;
  work.since = Infinity;
  for (const follow of finished) if (isNow()) await follow(isNow);
}

/** @type {(() => void)[]} What tells of the picture that is drawn. */
export const told = [];
/** @type {((isNow: () => boolean) => void | Promise<void>)[]} What follows a full picture. */
export const finished = [];

/**
 * The result of a task, or `undefined` after the message about why there is none.
 * @param {import('./studio.js').Studio} studio
 * @param {string[][]} line
 * @param {string} task
 * @param {[string, Uint8Array][]} files
 */
export async function attempt(studio, line, task = 'draw', files = []) {
  try {
    const answer = await studio.run(task, line, files);
    if (task === 'draw') $('message').hidden = true;
    return answer;
  } catch (error) {
    if (error !== 'stopped') complain(error);
  }
}

/** Shows a message in a line, and all of it on demand. */
export function complain(/** @type {unknown} */ text) {
  const lines = plain(text).trim().split('\n');
  const place = lines.find(line => /^\s*-->/.test(line))?.replace(/^\s*-->\s*/, '');
  const help = lines.find(line => /^\s*=?\s*help:/.test(line))?.replace(/^\s*=?\s*help:\s*/, '');
  const line = [lines[0], place && `(${place})`, help && `– ${help}`].filter(Boolean).join(' ');
  const more = lines.length > 1
    ? [element('details', {}, element('summary', { textContent: 'All of the message' }), element('pre', { textContent: lines.join('\n') }))]
    : [];
  $('message').replaceChildren(element('span', { textContent: line }), ...more);
  $('message').hidden = false;
  $('status').textContent = 'no picture';
  $('work').hidden = true;
  work.since = Infinity;
}

function notes(/** @type {string} */ text) {
  const lines = text ? plain(text).split('\n') : [];
  $('notes').replaceChildren(...lines.map(line => element('li', { textContent: line })));
}

/** Signs of work. */
export const work = {
  /** Since when a picture is wanted that is not there. */
  since: Infinity,
  lastShown: -Infinity,
  /** The subject is new, and nothing of it is shown. */
  isNew: true,
  isStopped: false,

  tick() {
    const now = performance.now();
    const isBusy = full.isBusy || drafts.some(studio => studio.isBusy);
    const late = now - Math.max(work.lastShown, work.since);
    const isLate = isBusy && late > SIGN_MS && !flying.isPlaying;
    const isMissing = state.drawn !== state.turn && views[0].shown < state.turn;
    const isOld = isMissing && (isBusy ? late > (work.isNew ? SIGN_MS : OLD_MS) : work.isNew && !$('message').hidden);
    $('stage').classList.toggle('old', isOld);
    $('work').hidden = !isLate;
    if (!isLate) return;
    const since = Math.min(full.since, ...drafts.map(studio => studio.since));
    const seconds = (now - since) / 1000;
    const [width, height] = sides();
    const guess = (cost.fixed + cost.pixel * width * height) / 1000;
    $('worked').textContent = `drawing ${state.name} … ${seconds.toFixed(1)} s`;
    $('progress').value = clamp(.02, seconds / (seconds + guess), .98);
  },

  /** Gives up what is being drawn. */
  stop() {
    stopAll();
    work.isStopped = true;
    work.since = Infinity;
    state.drawn = state.turn;
    clearTimeout(restTimer);
    $('status').textContent = 'stopped; any change draws again';
  },
};

/** A new subject: nothing of it is shown yet. */
export function renew() {
  stopAll();
  cost.seen.clear();
  [cost.fixed, cost.pixel] = [20, 5e-5];
  Object.assign(work, { since: performance.now(), isNew: true, isStopped: false });
  views.forEach(view => { view.asked = state.turn; });
  $('message').hidden = true;
  $('words').textContent = '';
  notes('');
}

/** Saves the full picture in a format, with the bytes of the line that is shown. */
export async function pictureFile(/** @type {string} */ format) {
  state.format = format;
  clearTimeout(restTimer);
  full.stop();
  const way = flying.way();
  const file = outputName(format, way?.flight?.name ?? state.name);
  told.forEach(tell => tell());
  const answer = await attempt(full, commands(controls(), { ...way, file }), 'file', way?.files ?? []);
  drawFull();
  return answer && { file, bytes: answer.result };
}
