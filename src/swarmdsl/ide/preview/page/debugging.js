// Controls of a debug session: steps, the events that would do something now, and variables.

const STEPS = [
  ["continue", "Continue", "Go on to the next breakpoint"],
  ["next", "Step", "Go on to the next moment of the swarm"],
  ["stepIn", "Into", "Go on to the next state or transition of this robot"],
  ["stepBack", "Back", "Go back to the moment before"],
  ["pause", "Pause", "Stop at the next moment"],
  ["terminate", "End", "End the session"],
];
const WHILE_RUNNING = new Set(["pause", "terminate"]);

/** Bar of a session; `act` is called with `{ request }` or `{ event }`. */
export class Debugging {
  #bar;
  #act;

  constructor(bar, act) {
    this.#bar = bar;
    this.#act = act;
  }

  /** Show a session, or none. */
  show(session) {
    this.#bar.hidden = !session;
    this.#bar.replaceChildren(...(session ? this.#parts(session) : []));
  }

  #parts({ held, time, member, events, variables }) {
    const steps = STEPS.map(([request, label, title]) => {
      const button = this.#button(label, title, { request });
      button.disabled = request === "pause" ? held : !held && !WHILE_RUNNING.has(request);
      return button;
    });
    const at = time === undefined ? "" : `${time.toFixed(3)} s`;
    const where = text("span", held ? `${member}, at ${at}` : at);
    where.className = "where";
    const sends = (events ?? []).map(({ event, label, to }) =>
      this.#button(label, `Send it to ${to.join(", ")}`, { event }),
    );
    const values = Object.entries(variables ?? {}).map(([name, value]) => text("code", `${name} = ${value}`));
    return [
      group("steps", steps),
      where,
      ...(sends.length ? [group("sends", [text("span", "Send"), ...sends])] : []),
      ...(values.length ? [group("values", values)] : []),
    ];
  }

  #button(label, title, command) {
    const button = text("button", label);
    button.title = title;
    button.addEventListener("click", () => this.#act(command));
    return button;
  }
}

function text(tag, content) {
  const made = document.createElement(tag);
  made.textContent = content;
  return made;
}

function group(name, parts) {
  const made = document.createElement("span");
  made.className = name;
  made.append(...parts);
  return made;
}
