// Controls of a simulation that the user drives: steps, events that would do something now, variables.
//
// They stay while they are updated, so that a key can be pressed again.

import { button, fill, made, select } from "./elements.js";
import { Sending } from "./sending.js";

const STEPS = [
  ["go", "Continue", "Go on to the next breakpoint, fault or end", "c"],
  ["next", "Step", "Go on to the next moment of the swarm", "n"],
  ["stepIn", "Into", "Go on to the next state or transition of this robot", "i"],
  ["stepBack", "Back", "Go back to the moment before", "b"],
  ["restart", "Restart", "Run the model as it is now, from the start"],
  ["terminate", "End", "End the simulation"],
];
const ALWAYS = new Set(["go", "restart", "terminate"]);
const AFTER_END = new Set(["restart", "terminate"]);
const SPEEDS = [["1", "real time"], ["10", "10 times as fast"], ["100", "100 times as fast"], ["", "at once"]];
const NO_SCENARIO = "no scenario";

/**
 * Bar of a simulation; `act` is called with `{ start: { subject, scenario, speed } }`, `{ request }`,
 * `{ event, data }`, `{ look: THREAD }` or `{ speed }`, and `shown` tells the diagram that is shown.
 */
export class Debugging {
  #bar;
  #act;
  #shown;
  #session; // null for none
  #lost; // element that had the focus and cannot have it for now
  #subjects; // { NAME: DIAGRAM } of what can be started here; undefined if an editor starts it
  #isChosen = false; // the user has chosen one of them
  #values = {}; // variables by name, as they were
  #thread; // robot whose variables these are
  #steps = new Map(); // buttons by request
  #group = made("span", "steps");

  #start = button("Simulate", "Run the model, and stop where the first robot has started");
  #subject = select("What to simulate", []);
  #scenario = select("Scenario", []);
  #speed = select("Speed of Continue", SPEEDS);
  #who = select("Robot to look at", []);
  #where = made("span", "where");
  #said = made("span", "said");
  #list = made("ul", "values");
  #sending;

  constructor(bar, act, shown) {
    this.#bar = bar;
    this.#act = act;
    this.#shown = shown;
    for (const [request, label, title, key] of STEPS) {
      const step = button(label, key ? `${title} (${key})` : title);
      step.addEventListener("click", () => this.#go(request));
      this.#steps.set(request, step);
    }
    this.#sending = new Sending((command) => this.#do(command));
    this.#said.setAttribute("role", "status");
    this.#list.setAttribute("aria-label", "Variables");
    this.#start.addEventListener("click", () => this.#begin());
    this.#subject.addEventListener("change", () => (this.#isChosen = true));
    this.#speed.addEventListener("change", () => this.#session && this.#do({ speed: this.#rate }));
    this.#who.addEventListener("change", () => this.#do({ look: Number(this.#who.value) }));
    this.#group.append(...this.#steps.values());
    bar.replaceChildren(
      this.#start,
      this.#subject,
      this.#scenario,
      this.#group,
      this.#speed,
      this.#who,
      this.#where,
      this.#said,
      ...this.#sending.parts,
      this.#list,
    );
    document.addEventListener("keydown", (event) => this.#press(event));
  }

  /** Offer to start a swarm or a state machine, with a scenario. */
  offer(subjects, scenarios) {
    this.#subjects = subjects;
    fill(this.#subject, Object.keys(subjects).map((each) => [each, each]));
    fill(this.#scenario, [["", NO_SCENARIO], ...scenarios.map((each) => [each, each])]);
    this.#refresh();
  }

  /** Show a session, or none. */
  show(session) {
    this.#session = session;
    this.#refresh();
  }

  /** Say why the last wish was not fulfilled. */
  fail(why) {
    this.#say(why, true);
  }

  #refresh() {
    const before = document.activeElement;
    const focused = this.#bar.contains(before) ? before : before === document.body && this.#lost;
    this.#update();
    const isKept = this.#bar.contains(document.activeElement) && isUsable(document.activeElement);
    if (focused && !isKept) {
      const others = [this.#steps.get("go"), this.#steps.get("restart"), this.#start];
      const next = [focused, ...others].find(isUsable);
      next?.focus();
      this.#lost = next ? undefined : focused;
    } else {
      this.#lost = undefined;
    }
  }

  #update() {
    const session = this.#session;
    const isRun = Boolean(session && !session.failed);
    this.#bar.hidden = !isRun && !this.#subject.options.length;
    this.#start.hidden = isRun;
    for (const each of [this.#subject, this.#scenario]) {
      each.hidden = isRun || each.options.length < 2;
    }
    this.follow();
    this.#speed.hidden = !this.#subjects;
    if (isRun && session.speed !== undefined) {
      this.#speed.value = session.speed === null ? "" : String(session.speed);
    }
    this.#updateSteps(isRun ? session : null);
    this.#updateWhere(isRun ? session : {});
    this.#updateValues(isRun ? session : {});
    this.#sending.show((isRun && session.events) || []);
    const said = [session?.failed, session?.reason, session?.changed, session?.starts && "starting ..."];
    this.#say(said.filter(Boolean).join("; "), Boolean(session?.failed));
  }

  /** Choose the state machine that is shown, if there is no swarm and the user has chosen nothing. */
  follow() {
    const [first, ...others] = Object.entries(this.#subjects ?? {});
    if (first && !this.#isChosen) {
      const isSwarm = first[0].startsWith("swarm ");
      const shown = others.find(([, diagram]) => !isSwarm && diagram === this.#shown());
      this.#subject.value = (shown ?? first)[0];
    }
  }

  get #rate() {
    return Number(this.#speed.value) || null;
  }

  #begin() {
    const [subject, scenario] = [this.#subject.value, this.#scenario.value];
    this.#do({ start: { subject, scenario, speed: this.#rate } });
  }

  #go(request) {
    this.#do({ request: request === "go" ? (this.#session.held ? "continue" : "pause") : request });
  }

  #do(command) {
    if (this.#said.classList.contains("wrong")) {
      this.#say("", false);
    }
    this.#act(command);
  }

  #press(event) {
    const isText = event.target.closest("input, select, textarea");
    const found = STEPS.find(([, , , key]) => key === event.key);
    const step = found && this.#steps.get(found[0]);
    if (step && !isText && !event.ctrlKey && !event.metaKey && !event.altKey && step.checkVisibility()) {
      event.preventDefault();
      step.click(); // a disabled one does nothing
    }
  }

  #updateSteps(session) {
    this.#group.hidden = !session;
    this.#steps.get("go").textContent = session && !session.held && !session.over ? "Pause" : "Continue";
    for (const [request, step] of this.#steps) {
      step.hidden = request === "restart" && !this.#subjects;
      const isReady = session?.over ? AFTER_END.has(request) : session?.held || ALWAYS.has(request);
      step.disabled = !isReady || Boolean(session?.starts && request !== "terminate");
    }
  }

  #updateWhere({ about, held, time, thread, member, members }) {
    const names = (held && members) || [];
    this.#who.hidden = names.length < 2;
    fill(this.#who, names.map((name, number) => [String(number + 1), name]));
    this.#who.value = String(thread);
    const who = held && names.length < 2 ? member : about;
    const at = typeof time === "number" ? `${held ? "" : "last step "}at ${time.toFixed(3)} s` : "";
    this.#where.textContent = [who, at].filter(Boolean).join(", ");
  }

  /** List variables; those of the same robot that have changed stand out. */
  #updateValues({ thread, variables }) {
    const names = Object.keys(variables ?? {});
    const before = thread === this.#thread ? this.#values : {};
    this.#list.hidden = !names.length;
    this.#list.replaceChildren(
      ...names.map((name) => {
        const isNew = name in before && before[name] !== variables[name];
        const item = made("li", isNew ? "changed" : "", made("code", "", `${name} = ${variables[name]}`));
        item.title = variables[name];
        return item;
      }),
    );
    if (variables) {
      this.#values = variables;
      this.#thread = thread;
    }
  }

  #say(text, isWrong) {
    this.#said.textContent = text;
    this.#said.classList.toggle("wrong", isWrong);
  }
}

/** True if an element can have the focus. */
function isUsable(element) {
  return element.checkVisibility() && !element.disabled;
}
