// What if something else had happened: a branch of the recording, from the moment that is shown.
import { download, duration, el } from "./dom.js";
import { Branch } from "./engine_branch.js";
import { eventOf, NO_ENVELOPE } from "./engine.js";
import { copied, plain } from "./engine_values.js";
import { testText } from "./test_text.js";

const PASSES = [["next", null], ["1 s", 1e9], ["10 s", 1e10], ["1 min", 6e10]];
const MOST_ROWS = 500;

class WhatIf {
  constructor(element, player) {
    Object.assign(this, { element, player, recording: player.recording, branch: null, seen: "" });
    this.say = el("p", { role: "status" });
    this.choices = el("div", {});
    this.list = el("ol", {});
    element.append(this.say, this.choices, this.list);
  }

  /** Steps of the recording up to the moment that is shown, and their number. */
  steps() {
    const { count } = this.recording;
    const lines = Array.from({ length: count }, (_, at) => this.recording.line(at));
    const steps = lines.filter((each) => each.configuration);
    return [steps, steps.filter((each) => each.index <= this.player.index).length - 1];
  }

  fork() {
    const [steps, last] = this.steps();
    this.past = steps.slice(0, last + 1);
    this.attempt(() => {
      this.branch = new Branch(this.recording.tables, steps, last, this.recording.lost);
      const rest = BigInt(Math.round(this.player.time)) - this.branch.time;
      if (rest > 0n) this.branch.pass(rest);
    });
    this.draw();
  }

  /** Let something happen in the branch; an endless loop ends it. */
  attempt(action) {
    this.error = "";
    try {
      action();
    } catch (error) {
      this.error = error.message;
    }
  }

  act(action) {
    this.attempt(action);
    this.draw();
  }

  get member() {
    const { selected } = this.player;
    const [number] = selected === null ? [0] : this.recording.selected(selected);
    return this.branch?.world.names.get(this.recording.members[number]?.name);
  }

  show() {
    const key = [this.player.index, this.player.selected, this.branch?.rows.length].join();
    if (key !== this.seen) this.draw();
    this.seen = key;
  }

  draw() {
    const { branch } = this;
    const button = (text, onclick, attributes = {}) => el("button", { type: "button", onclick, ...attributes }, text);
    const limits = this.recording.tables.limits.map((each) => `${each}.`);
    if (!branch) {
      this.say.textContent = this.error ?? "";
      this.choices.replaceChildren(
        el("p", {}, "At any moment, the run can go on in another way: with another event, another outcome, or a robot lost.", ...limits.map((each) => ` In a branch, ${each}`)),
        button(`Fork at ${duration(this.player.time)}`, () => this.fork()),
      );
      this.list.replaceChildren();
      return;
    }
    const { member } = this;
    const differs = branch.difference && ` The engine of this page did not do as line ${branch.difference.line.index + 1} of the recording: the branch may be wrong.`;
    this.say.textContent = `${this.error ? `Stopped: ${this.error}. ` : ""}Forked after ${branch.fork} steps; it is ${duration(Number(branch.time))}.${differs ?? ""}`;
    const groups = [["Time", PASSES.map(([text, length]) =>
      button(text, () => this.act(() => (length ? branch.pass(BigInt(length)) : this.next()))))]];
    if (member?.instance.running) {
      groups.push([`${member.name}: ${member.instance.configuration.innermost.join(", ")}`, this.events(member, button)]);
      groups.push(...branch.world.runsOf(member).map((run) => [run.activity.name, Object.keys(run.activity.events).map((outcome) =>
        button(outcome, () => this.act(() => branch.world.end(run, outcome))))]));
      groups.push(["Fault", [button(`lose ${member.robot.name ?? member.name}`, () => this.act(() => member.robot.members.forEach((each) => branch.world.lose(each))))]]);
    }
    const file = [
      button("Save as test", () => this.save(), { disabled: !member }),
      button("Drop", () => { this.branch = null; this.draw(); }),
    ];
    groups.push(["Branch", file]);
    this.choices.replaceChildren(...groups.map(([name, buttons]) =>
      el("fieldset", {}, el("legend", {}, name), ...(buttons.length ? buttons : ["nothing"]))));
    this.list.replaceChildren(...branch.rows.slice(-MOST_ROWS).map((row) =>
      el("li", {}, `${duration(row.t * 1e6)} ${row.member}: ${row.event ?? "start"}${row.ignored ? " (ignored)" : ""} \u2192 ${row.configuration.join(", ")}${row.sent.length ? `; sends ${row.sent.join(", ")}` : ""}`)));
  }

  next() {
    if (!this.branch.step()) this.error = "nothing happens any more";
  }

  /** Buttons of the events that would do something now. */
  events(member, button) {
    const { world } = this.branch;
    const { instance } = member;
    const names = [...world.events.keys()].filter((name) => instance.configuration.candidates(name).length);
    return names.map((name) => {
      const { message } = world.events.get(name);
      const fields = el("input", { value: JSON.stringify(plain(message)), "aria-label": `message of ${name}`, hidden: !Object.keys(message).length });
      const send = () => this.act(() => {
        const data = this.read(fields.value, message);
        world.deliver(member, eventOf(name, data, null, NO_ENVELOPE));
      });
      return el("span", {}, button(name, send), fields);
    });
  }

  read(text, message) {
    let given;
    try {
      given = JSON.parse(text);
    } catch {
      throw new Error(`the message is not JSON: ${text}`);
    }
    return merged(copied(message), given);
  }

  save() {
    const { branch, member } = this;
    const name = `${member.name} in a branch at ${duration(Number(branch.at))}`;
    download("branch.swarmtest.toml", testText(branch, [...this.past, ...branch.rows], name, member));
  }
}

/** A message with the given fields, which have the types of those before. */
function merged(message, given) {
  if (given === null || typeof given !== "object") throw new Error("the message has no fields");
  for (const [key, value] of Object.entries(given)) {
    if (!(key in message)) throw new Error(`the message has no field \`${key}\``);
    const held = message[key];
    if (held !== null && typeof held === "object" && !Array.isArray(held)) merged(held, value);
    else if (typeof value === "number") message[key] = Number.isInteger(value) ? BigInt(value) : value;
    else message[key] = value;
  }
  return message;
}

let shown = null;

export const view = {
  id: "what-if",
  title: "What if",
  available: (recording) => Boolean(recording.tables.members),
  mount(element, player) { shown = new WhatIf(element, player); },
  show() { shown.show(); },
};
