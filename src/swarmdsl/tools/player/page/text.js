// Text of the model, with the lines of the transitions that were taken or the states that were entered.
import { el, own, printable } from "./dom.js";
import { write } from "./shapes.js";

const ROW = 18; // pixels
const TOKEN = /(\/\/.*)|("(?:[^"\\]|\\.)*")|\b(\d[\w.]*)|([A-Za-z_]\w*)/g;

export const view = {
  id: "text",
  title: "Model",

  available: (recording) => Object.keys(recording.sources).length > 0,

  mount(element, player) {
    this.player = player;
    this.name = null;
    this.marked = [];
    this.texts = new Map();
    this.words = new Set(player.recording.keywords);
    const names = Object.keys(player.recording.sources);
    this.choice = el("select", { "aria-label": "File", onchange: () => this.open(names[this.choice.selectedIndex]) }, ...names.map((each) => el("option", { value: each }, each)));
    this.said = el("p", { class: "said" });
    this.box = el("div", { class: "text", tabindex: 0, role: "region", "aria-label": "Text of the model" });
    this.height = 300;
    new ResizeObserver(([{ contentRect }]) => (this.height = contentRect.height)).observe(this.box);
    element.append(el("p", { class: "bar" }, this.choice, this.said), this.box);
    this.open(names[0]);
  },

  /** Show a file. */
  open(name) {
    if (this.name === name) return;
    this.name = name;
    this.choice.selectedIndex = Object.keys(this.player.recording.sources).indexOf(name);
    if (!this.texts.has(name)) {
      const rows = this.player.recording.sources[name].split(/\r?\n/).map((line, at) => this.line(line, at + 1));
      this.texts.set(name, el("pre", {}, ...rows));
    }
    this.box.replaceChildren(this.texts.get(name));
  },

  show() {
    const places = this.places();
    const file = places[0]?.[0] ?? this.name;
    this.open(file);
    for (const each of this.marked) each.classList.remove("marked");
    this.marked = [];
    for (const [name, line] of places) {
      const row = name === file ? this.texts.get(file).children[line - 1] : null;
      if (!row) continue;
      row.classList.add("marked");
      this.marked.push(row);
    }
    write(this.said, places.length ? places.map(([name, line]) => `${name}:${line}`).join(", ") : "no line was taken");
    if (!this.marked.length) return;
    const at = (places[0][1] - 1) * ROW;
    const top = this.box.scrollTop;
    if (at < top || at > top + this.height - 2 * ROW) this.box.scrollTop = Math.max(0, at - Math.floor(this.height / 2));
  },

  /** Files and lines of what the last step has done: its transitions, else the states that it has entered or is in. */
  places() {
    const { recording, last: index } = this.player;
    const step = index < 0 ? {} : recording.step(index);
    const places = recording.machines[recording.members[recording.memberAt(index)]?.machine]?.places;
    if (!places || !step.configuration) return [];
    const ids = [step.taken, step.entered, step.configuration].find((each) => each?.length) ?? [];
    const found = ids.map((id) => own(places, id)).filter(Boolean);
    return [...new Map(found.map((each) => [each.join(":"), each])).values()];
  },

  /** A line with its number, and its words by their kind. */
  line(line, number) {
    const parts = [];
    let last = 0;
    for (const found of line.matchAll(TOKEN)) {
      const [text, comment, string, figure] = found;
      const kind = comment ? "comment" : string ? "string" : figure ? "number" : this.words.has(text) ? "keyword" : null;
      if (!kind) continue;
      parts.push(line.slice(last, found.index), el("span", { class: kind }, text));
      last = found.index + text.length;
    }
    parts.push(line.slice(last));
    return el("div", {}, el("i", {}, String(number).padStart(4)), ...parts.map((each) => (typeof each === "string" ? printable(each.replaceAll("\t", "    ")) : each)));
  },
};
