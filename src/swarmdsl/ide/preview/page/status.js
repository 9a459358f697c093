// What the page says about itself: errors of the model, notes, and why there is no diagram.

export class Status {
  #state;
  #note;
  #explanation;

  constructor(state, note, explanation) {
    this.#state = state;
    this.#note = note;
    this.#explanation = explanation;
  }

  /** Say nothing: there is a diagram. */
  clear() {
    this.#tell("");
    this.#explanation.hidden = true;
  }

  note(text) {
    this.#note.textContent = text;
    this.#note.title = text;
  }

  tellErrors(count, isDrawn) {
    this.clear();
    const errors = `${count} error${count === 1 ? "" : "s"}`;
    this.#tell(isDrawn ? `${errors}: showing the last valid version` : errors);
    if (!isDrawn) {
      const are = count === 1 ? "is" : "are";
      this.#show({ text: `There ${are} ${errors} in the model: its diagrams appear when it has none.` });
    }
  }

  /** Say why there is no diagram, or not the latest; `run` is called with the command of a button. */
  explain(reason, isDrawn, run) {
    this.clear();
    if (isDrawn) {
      this.#tell(`${reason.text} This is the last version.`);
    }
    if (!isDrawn || reason.actions?.length) {
      this.#show(reason, run);
      this.#explanation.classList.toggle("aside", isDrawn);
    }
  }

  end() {
    this.#tell("swarmc preview has ended: start it again, and this page goes on");
  }

  #tell(text) {
    this.#state.textContent = text;
    this.#state.title = text;
  }

  #show({ text, actions = [] }, run) {
    const line = document.createElement("p");
    line.textContent = text;
    const buttons = actions.map(({ title, command }) => {
      const button = document.createElement("button");
      button.textContent = title;
      button.addEventListener("click", () => run(command));
      return button;
    });
    this.#explanation.replaceChildren(line, ...buttons);
    this.#explanation.classList.remove("aside");
    this.#explanation.hidden = false;
  }
}
