// Log: the lines of the trace around the moment. Only the rows that are seen exist.
import { clock, el } from "./dom.js";
import { historyOf } from "./history.js";
import { upTo, write } from "./shapes.js";
import { words } from "./words.js";

const ROW = 20; // pixels
const SPARE = 8; // rows above and below
const SLICE = 8; // milliseconds of a search without a break

export const view = {
  id: "log",
  title: "Log",

  available: (recording) => recording.count > 0,

  mount(element, player) {
    this.player = player;
    this.found = null; // lines that match; all if null
    this.height = 300;
    this.top = 0;
    this.index = -2;
    this.said = el("span", { class: "said", role: "status" });
    this.sought = el("input", { type: "search", placeholder: "filter: words of a line", "aria-label": "Filter the log", oninput: () => this.seek() });
    this.only = el("input", { type: "checkbox", onchange: () => this.seek() });
    this.rows = el("div", { class: "rows" });
    this.space = el("div", { class: "space" }, this.rows);
    this.list = el("div", { class: "log", tabindex: 0, role: "listbox", "aria-label": "Lines of the trace" }, this.space);
    this.list.addEventListener("scroll", () => {
      this.top = this.list.scrollTop;
      this.draw();
    });
    this.list.addEventListener("keydown", (event) => {
      const way = { ArrowDown: 1, ArrowUp: -1 }[event.key];
      if (!way) return;
      event.preventDefault();
      event.stopPropagation();
      const to = this.lines()[upTo(this.lines(), player.index) - 1 + way];
      if (to !== undefined) player.go(to);
    });
    new ResizeObserver(([{ contentRect }]) => {
      this.height = contentRect.height;
      this.draw();
    }).observe(this.list);
    element.append(el("p", { class: "bar" }, this.sought, el("label", {}, this.only, " selected only"), this.said), this.list);
  },

  lines() {
    return this.found ?? historyOf(this.player.recording).told;
  },

  /** Look for the lines that match, in slices, so that the page does not stop. */
  seek() {
    const { recording, selected } = this.player;
    const sought = this.sought.value.toLowerCase().split(/\s+/).filter(Boolean);
    const chosen = this.only.checked && selected !== null ? new Set(recording.selected(selected)) : null;
    clearTimeout(this.timer);
    this.found = sought.length || chosen ? [] : null;
    let next = 0;
    const { told } = historyOf(recording);
    const matches = (at) => {
      if (chosen && !chosen.has(recording.memberAt(at))) return false;
      const text = sought.length ? this.told(at).toLowerCase() : "";
      return sought.every((each) => text.includes(each));
    };
    const search = () => {
      const until = performance.now() + SLICE;
      for (; next < told.length && performance.now() < until; next++) if (matches(told[next])) this.found.push(told[next]);
      if (next < told.length) this.timer = setTimeout(search);
      write(this.said, next < told.length ? "searching" : `${this.found.length} of ${told.length} lines`);
      this.follow();
    };
    if (this.found) search();
    else {
      write(this.said, "");
      this.follow();
    }
  },

  show(moment) {
    const { selected } = this.player;
    if (this.only.checked && this.selected !== selected) this.seek();
    this.selected = selected;
    if (this.index === moment.index && this.count === this.lines().length) return;
    this.index = moment.index;
    this.follow();
  },

  /** Scroll to the moment, if it is not in view. */
  follow() {
    const lines = this.lines();
    if (this.count !== lines.length) {
      this.count = lines.length;
      this.space.style.height = `${lines.length * ROW}px`;
    }
    const at = (upTo(lines, this.index) - 1) * ROW;
    if (at < this.top || at > this.top + this.height - 2 * ROW) {
      this.top = Math.max(0, at - Math.floor(this.height / 2 / ROW) * ROW);
      this.list.scrollTop = this.top;
    }
    this.draw();
  },

  draw() {
    const lines = this.lines();
    const first = Math.max(0, Math.floor(this.top / ROW) - SPARE);
    const last = Math.min(lines.length, Math.ceil((this.top + this.height) / ROW) + SPARE);
    const now = lines[upTo(lines, this.index) - 1];
    this.rows.style.transform = `translateY(${first * ROW}px)`;
    while (this.rows.childElementCount < last - first) this.rows.append(this.row());
    while (this.rows.childElementCount > last - first) this.rows.lastChild.remove();
    let row = this.rows.firstChild;
    for (let at = first; at < last; at++, row = row.nextSibling) {
      const isNow = lines[at] === now;
      if (row.line !== lines[at] || row.dataset.count !== String(lines.length)) {
        row.line = lines[at];
        row.dataset.count = lines.length;
        row.textContent = this.told(lines[at]);
        row.setAttribute("aria-posinset", at + 1);
        row.setAttribute("aria-setsize", lines.length);
      }
      if (row.getAttribute("aria-selected") !== String(isNow)) row.setAttribute("aria-selected", isNow);
      row.classList.toggle("later", lines[at] > this.index);
    }
  },

  told(at) {
    const { recording } = this.player;
    return `${clock(recording.time(at))}  ${words(recording, at)}`;
  },

  row() {
    const row = el("div", { role: "option" });
    row.addEventListener("click", () => this.player.go(row.line));
    return row;
  },
};
