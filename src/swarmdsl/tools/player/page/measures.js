// View of measures: a small chart each, and the value at the moment.
import { el } from "./dom.js";
import { historyOf } from "./history.js";
import { shape, upTo, write } from "./shapes.js";

const [WIDE, HIGH] = [400, 44];

export const view = {
  id: "measures",
  title: "Measures",

  available: (recording) => recording.measures.length > 0,

  mount(element, player) {
    this.player = player;
    this.drawn = -1;
    this.charts = player.recording.measures.map(({ name, unit = "", doc = "" }) => {
      const line = shape("path", { class: "curve" });
      const cursor = shape("line", { class: "cursor", y1: 0, y2: HIGH });
      const picture = shape("svg", { class: "chart", viewBox: `0 0 ${WIDE} ${HIGH}`, preserveAspectRatio: "none", "aria-hidden": "true" }, line, cursor);
      const value = el("span", { class: "value" });
      const range = el("span", { class: "range" });
      const figure = el("figure", {}, el("figcaption", { title: doc || name }, el("b", {}, name), " ", value, " ", range), picture);
      return { name, unit, line, cursor, value, range, figure };
    });
    element.append(el("div", { class: "charts" }, ...this.charts.map((each) => each.figure)));
  },

  show(moment) {
    const { recording } = this.player;
    const { measures } = historyOf(recording);
    if (this.drawn !== measures.length || this.end !== recording.end) {
      [this.drawn, this.end] = [measures.length, recording.end];
      this.lines = measures.map((each) => each.at);
      for (const each of this.charts) this.draw(each, measures, Math.max(recording.end, 1));
    }
    const now = measures[upTo(this.lines, moment.index) - 1];
    const x = (WIDE * this.player.time) / Math.max(recording.end, 1);
    for (const { name, unit, cursor, value } of this.charts) {
      cursor.setAttribute("x1", x);
      cursor.setAttribute("x2", x);
      write(value, number(now?.values[name], unit));
    }
  },

  /** Draw a value as steps; there is a gap where it has none. */
  draw({ name, unit, line, range }, measures, end) {
    const points = measures.map(({ time, values }) => [(WIDE * time) / end, values[name]]);
    const there = points.map(([, value]) => value).filter((value) => typeof value === "number");
    const [least, most] = there.reduce(([low, high], each) => [Math.min(low, each), Math.max(high, each)], [Infinity, -Infinity]);
    const y = (value) => HIGH - 3 - ((HIGH - 6) * (value - least)) / (most - least || 1);
    let path = "";
    points.forEach(([x, value], at) => {
      if (typeof value !== "number") return;
      const before = points[at - 1]?.[1];
      const to = points[at + 1]?.[0] ?? WIDE;
      path += `${typeof before === "number" ? "V" : `M${x.toFixed(1)},`}${y(value).toFixed(1)}H${to.toFixed(1)}`;
    });
    line.setAttribute("d", path);
    write(range, there.length ? `(${number(least, unit)} to ${number(most, unit)})` : "(no value)");
  },
};

const number = (value, unit) =>
  typeof value === "number" ? `${Number(value.toPrecision(6))}${unit && ` ${unit}`}` : "\u2013";
