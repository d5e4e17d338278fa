// The programs, in workers.

import { $ } from './dom.js';
import { state } from './state.js';

/**
 * @typedef {string[][]} Commands
 * @typedef {{ id: number, task: string, commands: Commands, files: [string, Uint8Array][] }} Message
 * @typedef {{ width: number, height: number, pixels: Uint8Array, notes: string }} Drawn
 * @typedef {{ result: any, ms: number }} Answer
 */

/** @type {WebAssembly.Module} */
let wasm;
let workerUrl = '';

/** The bytes that a script element holds: base64 of zlib. */
export async function packed(/** @type {string} */ id) {
  const bytes = Uint8Array.from(atob($(id).textContent), c => c.charCodeAt(0));
  const stream = new Blob([bytes]).stream().pipeThrough(new DecompressionStream('deflate'));
  return new Response(stream).arrayBuffer();
}

/** Compiles the programs, for workers and for this thread, which flies and writes lines. */
export async function load() {
  const worker = $('glue').textContent + $('worker').textContent;
  workerUrl = URL.createObjectURL(new Blob([worker], { type: 'text/javascript' }));
  wasm = await WebAssembly.compile(await packed('module'));
  await wasm_bindgen({ module_or_path: wasm });
}

/** A worker that does one task at a time. It is started when needed, with the files of the subject. */
export class Studio {
  /** @type {Worker | null} */
  #worker = null;
  /** @type {{ id: number, since: number, resolve: (answer: Answer) => void, reject: (error: string) => void } | null} */
  #task = null;
  #next = 0;

  get isBusy() { return this.#task !== null; }

  /** When the present task began. */
  get since() { return this.#task?.since ?? Infinity; }

  stop() {
    this.#worker?.terminate();
    this.#worker = null;
    this.#task?.reject('stopped');
    this.#task = null;
  }

  /**
   * Does a task. Rejects with the message of a program, or with `stopped`.
   * @param {string} task
   * @param {Commands} commands
   * @param {[string, Uint8Array][]} files files that are new, or have another content
   * @returns {Promise<Answer>}
   */
  run(task, commands, files = []) {
    const worker = this.#worker ?? this.#start();
    return new Promise((resolve, reject) => {
      const id = ++this.#next;
      this.#task = { id, since: performance.now(), resolve, reject };
      worker.postMessage({ id, task, commands, files });
    });
  }

  #start() {
    const worker = new Worker(workerUrl);
    this.#worker = worker;
    worker.onmessage = ({ data }) => this.#finish(data);
    worker.onerror = event => this.#finish({ id: this.#task?.id, error: event.message, isDead: true });
    worker.postMessage({ module: wasm, files: state.files });
    return worker;
  }

  #finish(/** @type {any} */ { id, result, ms, error, isDead }) {
    const task = this.#task;
    if (!task || task.id !== id) return;
    this.#task = null;
    if (isDead) this.stop();
    if (error === undefined) task.resolve({ result, ms });
    else task.reject(error);
  }
}

/** Draw small pictures at once, in turn: two to four, each with its own copy of the subject. */
export const drafts = Array.from({ length: Math.max(2, Math.min(4, navigator.hardwareConcurrency || 2)) }, () => new Studio());

/** Draws full pictures, which may take long and are given up for newer ones. */
export const full = new Studio();

export const stopAll = () => [...drafts, full].forEach(studio => studio.stop());
