// View of properties: a lane each with its verdicts over time, in words and symbols too.
import { duration, el, printable } from "./dom.js";
import { historyOf } from "./history.js";
import { shape, upTo, write } from "./shapes.js";

/** Symbols and words of verdicts. */
const VERDICTS = {
  true: ["\u2713", "holds"],
  open: ["\u2026", "pending"],
  false: ["\u2717", "violated"],
};

export const view = {
  id: "properties",
  title: "Properties",

  available: (recording) => recording.properties.length > 0,

  mount(element, player) {
    this.player = player;
    this.lanes = player.recording.properties.map((each) => {
      const cursor = shape("line", { class: "cursor", y1: 0, y2: 10 });
      const bars = shape("g");
      const picture = shape("svg", { class: "lane", viewBox: "0 0 1000 10", preserveAspectRatio: "none", "aria-hidden": "true" }, bars, cursor);
      picture.addEventListener("click", (event) => this.seek(event, picture));
      const verdict = el("td", { class: "verdict" });
      const row = el("tr", {}, el("th", { scope: "row", title: each.doc || each.text || each.name }, each.name), verdict, el("td", { class: "wide" }, picture));
      return { bars, cursor, verdict, row, drawn: -1 };
    });
    const heads = ["property", "verdict so far", "over time"].map((each) => el("th", { scope: "col" }, each));
    const rows = this.lanes.map((each) => each.row);
    element.append(el("div", { class: "scrolled" }, el("table", {}, el("thead", {}, el("tr", {}, ...heads)), el("tbody", {}, ...rows))));
  },

  seek(event, picture) {
    const { left, width } = picture.getBoundingClientRect();
    this.player.goTime(((event.clientX - left) / width) * this.player.recording.end);
  },

  show(moment) {
    const { recording } = this.player;
    const { verdicts } = historyOf(recording);
    const x = (time) => (1000 * time) / Math.max(recording.end, 1);
    this.lanes.forEach((lane, number) => {
      const changes = verdicts[number];
      if (lane.drawn !== changes.length || lane.end !== recording.end) {
        Object.assign(lane, { drawn: changes.length, end: recording.end, lines: changes.map((each) => each.at) });
        lane.bars.replaceChildren(...this.bars(recording, changes, x));
      }
      const now = changes[upTo(lane.lines, moment.index) - 1];
      const [symbol, word] = VERDICTS[now?.verdict ?? "open"] ?? ["?", now.verdict];
      const remark = now?.remark ? `: ${now.remark}` : "";
      write(lane.verdict, `${symbol} ${word}${remark}`);
      lane.verdict.dataset.verdict = now?.verdict ?? "open";
      lane.cursor.setAttribute("x1", x(this.player.time));
      lane.cursor.setAttribute("x2", x(this.player.time));
    });
  },

  bars(recording, changes, x) {
    const all = changes.length && changes[0].time <= 0 ? changes : [{ time: 0, verdict: "open" }, ...changes];
    return all.map(({ time, verdict }, at) => {
      const end = all[at + 1]?.time ?? recording.end;
      const [, word] = VERDICTS[verdict] ?? ["", verdict];
      const title = shape("title", {}, printable(`${word} from ${duration(time)} to ${duration(end)}`));
      const height = { true: 10, open: 5, false: 10 }[verdict] ?? 5; // told without colour, too
      return shape("rect", { "data-verdict": verdict, x: x(time), y: 10 - height, width: Math.max(x(end) - x(time), 2), height }, title);
    });
  },
};
