// Elements, numbers and small helpers.

/** The element with this id. */
export const $ = (/** @type {string} */ id) => /** @type {any} */ (document.getElementById(id));

/**
 * A new element.
 * @param {string} kind
 * @param {Record<string, any>} [properties]
 * @param {(Node | string)[]} children
 * @returns {any}
 */
export function element(kind, properties = {}, ...children) {
  const made = Object.assign(document.createElement(kind), properties);
  made.append(...children);
  return made;
}

/** A number in few digits. */
export const digits = (/** @type {number} */ number, places = 4) => String(Number(number.toFixed(places)));

/** A number in three digits or more. */
export const brief = (/** @type {number} */ number) => String(Number(number.toPrecision(3)));

export const radians = (/** @type {number} */ degrees) => degrees * Math.PI / 180;
export const degrees = (/** @type {number} */ angle) => angle * 180 / Math.PI;
export const clamp = (/** @type {number} */ low, /** @type {number} */ number, /** @type {number} */ high) =>
  Math.max(low, Math.min(high, number));
/** An angle in degrees from -180 to 180. */
export const turned = (/** @type {number} */ angle) => ((angle + 540) % 360 + 360) % 360 - 180;

/**
 * The unit vector of two angles in degrees.
 * @param {number} azimuth
 * @param {number} climb
 */
export function direction(azimuth, climb) {
  const [a, c] = [radians(azimuth), radians(climb)];
  return [Math.cos(c) * Math.cos(a), Math.cos(c) * Math.sin(a), Math.sin(c)];
}

/**
 * The two angles of a vector, in degrees.
 * @param {number[]} vector
 */
export function angles([x, y, z]) {
  return { azimuth: degrees(Math.atan2(y, x)), climb: degrees(Math.asin(clamp(-1, z / Math.hypot(x, y, z), 1))) };
}

/** The words of a line, of which some may be quoted. */
export function words(/** @type {string} */ line) {
  const found = line.match(/(?:[^\s'"]|'[^']*'|"[^"]*")+/g) ?? [];
  return found.map(word => word.replace(/'([^']*)'|"([^"]*)"/g, '$1$2'));
}

/** Text without the styles of a terminal. */
export const plain = (/** @type {unknown} */ text) => String(text).replace(/\x1b\[[0-9;]*m/g, '');

/** Offers bytes or text as a file to save. */
export function download(/** @type {string} */ name, /** @type {BlobPart} */ content, /** @type {string} */ type) {
  const link = element('a', { href: URL.createObjectURL(new Blob([content], { type })), download: name });
  link.click();
  setTimeout(() => URL.revokeObjectURL(link.href), 60000);
}
