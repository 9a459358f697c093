// Folded nodes of diagrams, and their fold marks.

import { made, outer, sides } from "./shapes.js";

const HALF = 7;
const OUT = 3; // outside of the lines

export class Folding {
  #folded; // { DIAGRAM ID: [NODE IDS] }

  constructor(folded = {}) {
    this.#folded = folded;
  }

  /** State to store for a reload. */
  get all() {
    return this.#folded;
  }

  /** Folded node ids of a diagram; some may no longer exist in the model. */
  of(diagram) {
    return this.#folded[diagram] ?? [];
  }

  toggle(diagram, id) {
    const folded = this.of(diagram);
    const others = folded.filter((each) => each !== id);
    this.#folded[diagram] = others.length < folded.length ? others : [...folded, id];
  }

  /** Fold exactly these nodes of a diagram. */
  fold(diagram, ids) {
    this.#folded[diagram] = [...ids];
  }

  /** Unfold the nodes around an element; returns true if one was folded. */
  unfoldPath(diagram, id) {
    const around = new Set();
    for (let each = outer(id); each; each = outer(each)) {
      around.add(each);
    }
    const before = this.of(diagram);
    this.fold(diagram, before.filter((each) => !around.has(each)));
    return this.of(diagram).length < before.length;
  }

  /** Draw a mark at the corner of each foldable node. */
  mark(picture) {
    const svg = picture.querySelector("svg");
    for (const each of picture.querySelectorAll("[data-fold]")) {
      const { right, top } = sides(each);
      const [x, y] = [right + OUT, top - OUT];
      const isClosed = each.dataset.fold === "closed";
      const word = isClosed ? "Unfold" : "Fold";
      svg.append(
        made(
          "g",
          { class: "fold", role: "button", tabindex: 0, "data-of": each.dataset.id, "aria-label": word },
          made("title", {}, word),
          made("rect", { x: x - HALF, y: y - HALF, width: 2 * HALF, height: 2 * HALF, rx: 3 }),
          made("path", { d: `M${x - 4},${y} h8${isClosed ? ` M${x},${y - 4} v8` : ""}` }),
        ),
      );
    }
  }
}
