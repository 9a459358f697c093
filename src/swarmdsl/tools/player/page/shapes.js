// Shapes of the pictures that views draw. Names of models and traces are text, never markup.
import { printable } from "./dom.js";

const SVG = "http://www.w3.org/2000/svg";

/** Make an element of a picture: attributes, listeners (`onclick`), then texts and elements inside. */
export function shape(tag, attributes = {}, ...inside) {
  const made = document.createElementNS(SVG, tag);
  for (const [name, value] of Object.entries(attributes))
    if (typeof value === "function") made.addEventListener(name.slice(2), value);
    else made.setAttribute(name, typeof value === "number" ? Math.round(value * 100) / 100 : printable(value));
  made.append(...inside.map((each) => (each instanceof Node ? each : printable(each))));
  return made;
}

/** Set the text of an element, if it is another one. */
export function write(element, text) {
  const shown = printable(text);
  if (element.textContent !== shown) element.textContent = shown;
}

/** Let a click and the keyboard do the same. */
export const press = (act) => ({
  tabindex: 0,
  onclick: act,
  onkeydown: (event) => {
    if (event.key !== "Enter") return;
    event.stopPropagation();
    act();
  },
});

/** Number of sorted numbers that are at most a limit. */
export function upTo(sorted, limit) {
  let [low, high] = [0, sorted.length];
  while (low < high) {
    const middle = (low + high) >> 1;
    if (sorted[middle] <= limit) low = middle + 1;
    else high = middle;
  }
  return low;
}
