// View of variables: the values of the selected members, and those that the last step has changed.
import { el, printable } from "./dom.js";
import { historyOf } from "./history.js";

const MOST = 60; // members in the table
const LONGEST = 40; // letters of a value

export const view = {
  id: "variables",
  title: "Variables",

  available: (recording) => historyOf(recording).hasVariables,

  mount(element, player) {
    this.player = player;
    this.names = null;
    this.note = el("p", { class: "said" });
    this.head = el("thead");
    this.body = el("tbody");
    element.append(this.note, el("div", { class: "scrolled" }, el("table", {}, this.head, this.body)));
  },

  show(moment) {
    const { numbers: all, recording } = this.player;
    const numbers = all.filter((each) => Object.keys(moment.members[each]?.variables ?? {}).length).slice(0, MOST);
    const names = [...new Set(numbers.flatMap((each) => Object.keys(moment.members[each].variables)))].filter((each) => each !== "self");
    const shown = `${numbers.join()}\n${names.join("\n")}`;
    if (shown !== this.names) {
      this.names = shown;
      this.build(numbers, names);
    }
    const changer = recording.memberAt(moment.index);
    const changed = (moment.index >= 0 && recording.value(moment.index, "variables")) || {};
    for (const [number, name, cell] of this.cells) {
      const values = moment.members[number].variables;
      const text = Object.hasOwn(values, name) ? written(values[name]) : "";
      const isNew = number === changer && Object.hasOwn(changed, name);
      if (cell.shown === text && cell.isNew === isNew) continue;
      Object.assign(cell, { shown: text, isNew });
      cell.element.textContent = printable(`${isNew ? "\u25cf " : ""}${text.length > LONGEST ? `${text.slice(0, LONGEST)}\u2026` : text}`);
      cell.element.title = printable(isNew ? `${text} (changed in this step)` : text);
      cell.element.classList.toggle("changed", isNew);
    }
    this.note.textContent = numbers.length ? (all.length > MOST ? `the first ${MOST} members` : "") : "no variables";
  },

  /** Make the table: a row a variable, a column a member; for many members the other way round. */
  build(numbers, names) {
    const { members } = this.player.recording;
    const cells = new Map();
    const cell = (number, name) => {
      const element = el("td");
      cells.set(`${number} ${name}`, [number, name, { element }]);
      return element;
    };
    const turned = numbers.length > names.length;
    const [rows, columns] = turned ? [numbers, names] : [names, numbers];
    const said = (each) => (typeof each === "number" ? members[each].name : each);
    const head = (scope) => (each) => el("th", { scope }, said(each));
    this.head.replaceChildren(el("tr", {}, el("td", {}, turned ? "member" : "variable"), ...columns.map(head("col"))));
    const row = (each) => columns.map((other) => (turned ? cell(each, other) : cell(other, each)));
    this.body.replaceChildren(...rows.map((each) => el("tr", {}, head("row")(each), ...row(each))));
    this.cells = [...cells.values()];
  },
};

const written = (value) => (typeof value === "string" ? `"${value}"` : JSON.stringify(value));
