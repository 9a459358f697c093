// View of two runs side by side, by time, with the times from which on members are in different states.
import { clock, el, printable } from "./dom.js";
import { upTo } from "./shapes.js";
import { staysOf } from "./stays.js";

const MOST = 200; // rows
const words = ({ times, states }, time) => said(states[upTo(times, time) - 1]);
const said = (states) => (states === undefined ? "not there" : states === null ? "lost" : states.join(", "));

/** Times at which the states of two stays begin to differ. */
function partings(mine, theirs) {
  const times = [...new Set([...mine.times, ...theirs.times])].sort((a, b) => a - b);
  const found = [];
  let same = true;
  for (const time of times) {
    const now = words(mine, time) === words(theirs, time);
    if (same && !now) found.push(time);
    same = now;
  }
  return found;
}

/** Members of both runs with the times at which they begin to differ, and all of these times. */
export function differences(recording) {
  const { other } = recording;
  const [mine, theirs] = [staysOf(recording), staysOf(other)];
  const none = { times: [], states: [] };
  const names = [...new Set([...recording.members, ...other.members].map((each) => each.name))];
  const of = (run, stays, name) => stays[run.number(name)] ?? none;
  const rows = names.map((name) => {
    const pair = [of(recording, mine, name), of(other, theirs, name)];
    return { name, pair, partings: partings(...pair) };
  });
  return { rows, times: [...new Set(rows.flatMap((each) => each.partings))].sort((a, b) => a - b) };
}

export const view = {
  id: "compare",
  title: "Comparison",

  available: (recording) => Boolean(recording.other),

  mount(element, player) {
    this.player = player;
    const { recording } = player;
    const { other } = recording;
    Object.assign(this, differences(recording));
    this.said = el("p", { class: "said", role: "status" });
    const go = (way) => {
      const found = way > 0 ? this.times.find((each) => each > player.time) : this.times.findLast((each) => each < player.time);
      if (found !== undefined) player.goTime(found);
    };
    const button = (text, act) => el("button", { type: "button", disabled: !this.times.length, onclick: act }, text);
    const bar = el("p", {}, button("first difference", () => player.goTime(this.times[0])), button("next", () => go(1)), button("before", () => go(-1)));
    const run = (each) => [each.scenario, each.seed === null ? "" : `seed ${each.seed}`].filter(Boolean).join(", ");
    const head = el("tr", {}, el("th", {}, "member"), el("th", {}, `this run ${run(recording)}`), el("th", {}, `the other ${run(other)}`), el("th", {}, "differ from"));
    const rows = [...this.rows].sort((a, b) => (a.partings[0] ?? Infinity) - (b.partings[0] ?? Infinity)).slice(0, MOST);
    const body = rows.map((row) => {
      const from = row.partings[0];
      const at = from === undefined ? "never" : el("button", { type: "button", onclick: () => player.goTime(from) }, clock(from));
      row.cells = [el("td"), el("td")];
      row.element = el("tr", {}, el("th", { scope: "row" }, row.name), ...row.cells, el("td", {}, at));
      return row.element;
    });
    this.shown = rows;
    element.append(this.said, bar, el("table", {}, el("thead", {}, head), el("tbody", {}, ...body)));
  },

  show() {
    const { time } = this.player;
    for (const row of this.shown) {
      const states = row.pair.map((each) => words(each, time));
      row.element.classList.toggle("differs", states[0] !== states[1]);
      row.cells.forEach((cell, at) => (cell.textContent = printable(`${at && states[0] !== states[1] ? "\u2260 " : ""}${states[at]}`)));
    }
    const [first] = this.times;
    const who = this.rows.filter((each) => each.partings.includes(first)).map((each) => each.name);
    const [mine, theirs] = [this.player.recording.end, this.player.recording.other.end];
    const until = mine === theirs ? "" : ` This run ends at ${clock(mine)}, the other at ${clock(theirs)}.`;
    const result = first === undefined ? "The states of both runs are the same at all times." : `The runs differ from ${clock(first)} on, first in ${who.slice(0, 5).join(", ")}${who.length > 5 ? ` and ${who.length - 5} more` : ""}.`;
    this.said.textContent = printable(result + until);
  },
};
