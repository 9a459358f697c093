// Which nodes of which diagrams are folded, and the marks that fold and unfold them.

import { made, sides } from "./shapes.js";

const HALF = 7;
const OUT = 3; // where no line ends

export class Folding {
  #folded; // { ID OF A DIAGRAM: [IDS OF NODES] }

  constructor(folded = {}) {
    this.#folded = folded;
  }

  /** All that is folded, to be remembered. */
  get all() {
    return this.#folded;
  }

  /** The nodes of a diagram that are folded; there may be some that the text has no more. */
  of(diagram) {
    return this.#folded[diagram] ?? [];
  }

  toggle(diagram, id) {
    const folded = this.of(diagram);
    const others = folded.filter((each) => each !== id);
    this.#folded[diagram] = others.length < folded.length ? others : [...folded, id];
  }

  /** Put a mark at the corner of each node that can be folded. */
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
