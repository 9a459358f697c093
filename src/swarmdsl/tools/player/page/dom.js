// Elements of the page. Names of models and traces are text, never markup.

// Control characters, changes of the writing direction, and what cannot be seen.
const UNSEEN = /[\p{Cc}\p{Cf}\p{Cs}\u2028\u2029\ufffe\uffff]/gu;

/** A text without what hides or turns the text around it. */
export const printable = (text) => String(text).replace(UNSEEN, "\ufffd");

/** Value of a key of an object, undefined for what all objects have, like `constructor`. */
export const own = (object, key) => (Object.hasOwn(object, key) ? object[key] : undefined);

/** Make an element: attributes, listeners (`onclick`), then texts and elements inside. */
export function el(tag, attributes = {}, ...inside) {
  const made = document.createElement(tag);
  for (const [name, value] of Object.entries(attributes)) {
    if (value === null || value === undefined || value === false) continue;
    if (typeof value === "function") made.addEventListener(name.slice(2), value);
    else made.setAttribute(name, value === true ? "" : printable(value));
  }
  made.append(...inside.map((each) => (each instanceof Node ? each : printable(each))));
  return made;
}

/** Make the element of a picture that Python has drawn. */
export function picture(svg) {
  const read = new DOMParser().parseFromString(svg, "image/svg+xml");
  return document.importNode(read.documentElement, true);
}

/** Save a text as a file. */
export function download(name, text) {
  const link = el("a", { download: name });
  link.href = URL.createObjectURL(new Blob([text], { type: "application/octet-stream" }));
  link.click();
  setTimeout(() => URL.revokeObjectURL(link.href), 10000);
}

/** A time in nanoseconds: `850 ms`, `12.5 s`, `4 min 3 s`, `2 h 0 min`. */
export function duration(nanoseconds) {
  const seconds = nanoseconds / 1e9;
  if (seconds < 1) return `${Number((seconds * 1000).toPrecision(10))} ms`;
  if (seconds < 60) return `${Number(seconds.toPrecision(4))} s`;
  const [minutes, rest] = [Math.floor(Math.round(seconds) / 60), Math.round(seconds) % 60];
  return minutes < 60 ? `${minutes} min ${rest} s` : `${Math.floor(minutes / 60)} h ${minutes % 60} min`;
}

/** A time as on a clock: `1:02:03.250`. */
export function clock(nanoseconds) {
  const all = Math.round(nanoseconds / 1e6);
  const two = (number) => String(number).padStart(2, "0");
  const [hours, minutes, seconds] = [Math.floor(all / 3.6e6), Math.floor(all / 6e4) % 60, Math.floor(all / 1000) % 60];
  const whole = hours ? `${hours}:${two(minutes)}:${two(seconds)}` : `${minutes}:${two(seconds)}`;
  return `${whole}.${String(all % 1000).padStart(3, "0")}`;
}
