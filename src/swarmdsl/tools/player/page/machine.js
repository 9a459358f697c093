// View of a machine: its states with who is in them, and the transition that was just taken.
import { clock, el, picture, printable } from "./dom.js";
import { shape, write } from "./shapes.js";

const NAMED = 12; // members that are named in a title

export const view = {
  id: "machine",
  title: "State machine",

  available: (recording) => recording.members.length > 0,

  mount(element, player) {
    this.player = player;
    this.machine = this.chosen = null;
    this.choice = el("select", { "aria-label": "State machine", onchange: () => this.change() });
    this.said = el("p", { class: "said" });
    this.drawing = el("div", { class: "drawing fit", tabindex: "0", role: "region", "aria-label": "Picture of the states" });
    const fit = el("input", { type: "checkbox", checked: true, onchange: () => this.drawing.classList.toggle("fit", fit.checked) });
    element.append(el("p", { class: "bar" }, this.choice, el("label", {}, fit, " fit"), this.said), this.drawing);
  },

  change() {
    this.turn([...this.chosen.keys()][this.choice.selectedIndex]);
    this.show(this.player.moment);
  },

  /** Offer the machines of the selected members. */
  offer() {
    const { numbers, recording } = this.player;
    this.chosen = new Map(); // numbers of members by machine
    for (const number of numbers) {
      const { machine } = recording.members[number];
      if (!this.chosen.has(machine)) this.chosen.set(machine, []);
      this.chosen.get(machine).push(number);
    }
    const names = [...this.chosen.keys()];
    this.choice.replaceChildren(...names.map((name) => el("option", { value: name }, name || "unknown machine")));
    this.choice.hidden = names.length < 2;
    if (names.length) this.turn(names.includes(this.machine) ? this.machine : names[0]);
  },

  /** Show another machine. */
  turn(name) {
    this.choice.selectedIndex = [...this.chosen.keys()].indexOf(name);
    if (this.machine === name) return;
    this.machine = name;
    const machine = this.player.recording.machines[name];
    this.nodes = new Map();
    this.edges = new Map();
    this.lit = [];
    this.counts = shape("g", { class: "counts" });
    const note = (each, kind) => this[kind].set(each.dataset.id, [...(this[kind].get(each.dataset.id) ?? []), each]);
    if (machine?.picture) {
      const svg = picture(machine.picture);
      for (const each of svg.querySelectorAll(".node")) note(each, "nodes");
      for (const each of svg.querySelectorAll(".edge, text[data-id]")) note(each, "edges");
      svg.append(this.counts);
      this.drawing.replaceChildren(svg);
    } else {
      for (const id of machine?.states ?? []) this.nodes.set(id, [el("li", {}, id)]);
      this.drawing.replaceChildren(el("ul", { class: "states" }, ...[...this.nodes.values()].flat()));
    }
  },

  show(moment) {
    const { recording, selected } = this.player;
    if (this.selected !== selected || !this.chosen) this.offer();
    this.selected = selected;
    const numbers = this.chosen.get(this.machine) ?? [];
    const inside = new Map(); // numbers of members by state
    for (const number of numbers)
      for (const state of moment.members[number]?.states ?? []) {
        if (!inside.has(state)) inside.set(state, []);
        inside.get(state).push(number);
      }
    for (const [each, mark] of this.lit) each.classList.remove(mark);
    this.lit = [];
    const counts = [];
    for (const [state, here] of inside) {
      let id = state;
      while (id && !this.nodes.has(id)) id = outer(id);
      this.light(this.nodes.get(id), "lit");
      for (let around = outer(id); around; around = outer(around)) this.light(this.nodes.get(around), "around");
      if (numbers.length > 1 && id) counts.push(this.count(this.nodes.get(id)[0], here));
    }
    this.counts.replaceChildren(...counts.filter(Boolean));
    const last = numbers.reduce((line, each) => Math.max(line, moment.members[each]?.line ?? -1), -1);
    const step = last < 0 ? {} : recording.step(last);
    const taken = step.taken ?? [];
    for (const id of taken) this.light(this.edges.get(id), "taken");
    for (const [id, [edge]] of this.edges) if (begins(id, edge, step, this.edges)) this.light([edge], "taken");
    write(this.said, this.words(moment, inside, numbers, taken.length ? last : -1));
  },

  words(moment, inside, numbers, last) {
    const { recording } = this.player;
    const who = (here) => (numbers.length > 1 ? `${here.length} in ` : "");
    const states = [...inside].map(([state, here]) => `${who(here)}${state}`);
    const absent = numbers.filter((each) => !moment.members[each]?.alive).length;
    if (absent) states.push(numbers.length > 1 ? `${absent} not there` : "not there");
    const line = last < 0 ? "" : `. Last taken: ${recording.step(last).taken.join(", ")} of ${recording.members[recording.memberAt(last)].name} at ${clock(recording.time(last))}`;
    return `${states.join(", ")}${line}`;
  },

  light(elements, mark) {
    for (const each of elements ?? []) {
      each.classList.add(mark);
      this.lit.push([each, mark]);
    }
  },

  /** Number of members in a state, at the corner of its box. */
  count(node, here) {
    const box = node.querySelector?.("rect, circle");
    if (!box) return null;
    const number = (name) => Number(box.getAttribute(name));
    const [x, y] = box.localName === "rect" ? [number("x"), number("y")] : [number("cx") - number("r"), number("cy") - number("r")];
    const text = String(here.length);
    const width = 10 + 7 * text.length;
    const names = here.slice(0, NAMED).map((each) => this.player.recording.members[each].name);
    if (here.length > NAMED) names.push(`and ${here.length - NAMED} more`);
    return shape(
      "g",
      { class: "count" },
      shape("title", {}, ...names.flatMap((each) => [each, document.createTextNode("\n")])),
      shape("rect", { x: x + 4 - width, y: y - 10, width, height: 16, rx: 8 }),
      shape("text", { x: x + 4 - width / 2, y: y + 2, "text-anchor": "middle" }, printable(text)),
    );
  },
};

const outer = (id) => id.slice(0, Math.max(id.lastIndexOf("."), 0));
const INITIAL = "#initial->";

/** Return true for the arrow from an initial state, if the step has entered its target by it. */
function begins(id, edge, step, edges) {
  if (!id.endsWith(INITIAL) || !step.entered?.includes(edge.dataset.to)) return false;
  const around = id.slice(0, -INITIAL.length);
  if (around ? !step.entered.includes(around) : step.event !== null) return false;
  const isInside = (state) => !around || state.startsWith(`${around}.`);
  return !(step.taken ?? []).some((each) => isInside(edges.get(each)?.[0].dataset.to ?? "") && !isInside(each));
}
