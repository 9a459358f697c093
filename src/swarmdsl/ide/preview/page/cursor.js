// Element at the cursor of the editor: the diagram that shows it, and its mark.

import { visible } from "./shapes.js";

export class Cursor {
  #elements = []; // [{ diagram, element }], that of its own diagram first

  /**
   * Store the elements at the cursor; returns the diagram to show.
   *
   * The user may have chosen another diagram: only a move to another element leaves it, and only if
   * it does not show that element. An edit is no move.
   */
  move(elements, isMove, shown, titles) {
    const before = JSON.stringify(this.#elements);
    this.#elements = elements;
    const isOther = isMove && before !== JSON.stringify(elements);
    const own = isOther && this.in(shown) === undefined && elements.find(({ diagram }) => diagram in titles);
    return own ? own.diagram : shown;
  }

  /** Id of the element in a diagram; empty for its frame, undefined if it is not there. */
  in(diagram) {
    return this.#elements.find((each) => each.diagram === diagram)?.element;
  }

  /** Mark the element, or the folded node around it; returns it, unless it is the frame. */
  mark(picture, diagram) {
    for (const each of picture.querySelectorAll(".marked")) {
      each.classList.remove("marked");
    }
    const id = this.in(diagram);
    const found = id === undefined ? undefined : visible(picture, id);
    found?.classList.add("marked");
    return found;
  }
}
