// Lanes: a row for each member, bars of states over time, arrows of swarm events.
import { clock, duration, el, printable } from "./dom.js";
import { historyOf } from "./history.js";
import { drawArrows } from "./lane_arrows.js";
import { drawAxis, drawRow } from "./lane_bars.js";
import { robotOf } from "./recording.js";
import { upTo } from "./shapes.js";
import { staysOf } from "./stays.js";

const ROW = 20; // height of a region
const GAP = 4;
const HEAD = 22; // height of the head of a role, and of the axis
const MOST_ROWS = 500; // of one role; others are found by search
const PROPERTIES = "\n"; // the group of properties, which is no role
const SOME = 6; // properties that are shown without folding; a violated one always is
const FEW = 60; // members that are shown without folding

export class Lanes {
  constructor(element, player, title = "") {
    const { recording } = player;
    this.player = player;
    this.recording = recording;
    this.stays = staysOf(recording);
    this.seen = recording.count;
    this.fleet = recording.fleet?.now;
    this.lost = lostOf(this.fleet);
    this.folded = new Set();
    this.sought = "";
    this.arrows = true;
    this.end = Math.max(recording.end, 1);
    [this.from, this.to, this.range] = [0, this.end, this.end];
    this.changed = () => {}; // called when another window is drawn
    const roles = [...new Set(recording.members.map((each) => each.role))];
    if (recording.properties.length > SOME) this.folded.add(PROPERTIES);
    if (recording.members.length > FEW) roles.forEach((each) => this.folded.add(each));
    this.#build(element, title);
    new ResizeObserver(() => this.draw()).observe(this.scroller);
    matchMedia("(prefers-color-scheme: dark)").addEventListener("change", () => this.draw());
    player.on("selection", () => this.draw());
    player.on("bookmarks", () => this.draw());
    this.layOut();
  }

  /** Show a moment: the cursor, and the states in the heads of the rows. */
  show(moment) {
    if (this.seen !== this.recording.count) this.grow();
    if (this.fleet !== this.recording.fleet?.now) this.#seeFleet();
    const { time } = this.player;
    const x = this.x(time);
    const isSeen = x > -1 && x < this.width + 1;
    if (!isSeen && this.shown !== time) {
      this.shown = time;
      return this.zoom(1); // which shows it
    }
    this.shown = time;
    this.cursor.style.transform = `translateX(${x}px)`;
    this.cursor.hidden = !isSeen;
    for (const row of this.rows) {
      if (row.members.length !== 1) continue;
      const { states, alive, line } = moment.members[row.members[0]];
      const last = states.map((each) => each.split(".").at(-1)).join(", ");
      const text = line < 0 ? "" : !alive ? "lost" : this.isSilent(row.members[0], time) ? `lost, was in ${last}` : last;
      if (row.text !== text) row.state.textContent = printable((row.text = text));
    }
  }

  /** Take in the lines of a run that goes on. */
  grow() {
    const { recording } = this;
    const rows = () => this.stays.reduce((sum, each) => sum + each.rows, 0);
    const before = rows();
    const length = this.to - this.from;
    const last = this.to === this.range; // then the end stays in view
    staysOf(recording, this.stays, this.seen);
    this.seen = recording.count;
    this.end = this.range = Math.max(recording.end, 1);
    if (last) [this.from, this.to] = [this.from && this.end - length, this.end];
    if (rows() === before) this.draw();
    else this.layOut();
  }

  /** Return true if a robot of a fleet is lost, and was not heard after its last line, at or before a time. */
  isSilent(number, time) {
    return this.lost.has(robotOf(this.recording.members[number].name)) && this.stays[number].heard <= time;
  }

  /** Take in who is lost in a fleet now. */
  #seeFleet() {
    const before = [...this.lost].join();
    this.fleet = this.recording.fleet?.now;
    this.lost = lostOf(this.fleet);
    if ([...this.lost].join() !== before) this.draw();
  }

  x(time) {
    return ((time - this.from) / (this.to - this.from)) * this.width;
  }

  time(x) {
    return this.from + (x / this.width) * (this.to - this.from);
  }

  /** Zoom by a factor, so that a time keeps its place, or comes into view. */
  zoom(factor, around = this.player.time) {
    const length = Math.min(this.range, Math.max((this.to - this.from) / factor, 1e6));
    const seen = around >= this.from && around <= this.to;
    const share = seen ? (around - this.from) / (this.to - this.from) : 0.1;
    this.from = Math.max(0, Math.min(around - share * length, this.range - length));
    this.to = this.from + length;
    this.draw();
    this.show(this.player.moment);
  }

  seek(text) {
    this.sought = text.trim().toLowerCase();
    this.layOut();
  }

  fold(role) {
    if (!this.folded.delete(role)) this.folded.add(role);
    this.layOut();
  }

  /** Make the rows: heads of roles, members that are not folded, properties. */
  layOut() {
    const { members, properties } = this.recording;
    this.rows = [];
    let top = 0;
    const add = (row, height) => {
      this.rows.push({ ...row, top, height });
      top += height + GAP;
    };
    const roles = new Map();
    members.forEach((each, number) => {
      if (!this.#fits(each, number)) return;
      if (!roles.has(each.role)) roles.set(each.role, []);
      roles.get(each.role).push(number);
    });
    for (const [role, numbers] of roles) {
      const folded = this.folded.has(role) && !this.sought;
      const grouped = numbers.length > 1 || roles.size > 1;
      if (grouped) add({ role, name: role, members: folded ? numbers : [], count: numbers.length, folded }, folded ? 2 * ROW : HEAD - 6);
      if (folded) continue;
      for (const number of numbers.slice(0, MOST_ROWS))
        add({ name: members[number].name, members: [number] }, this.stays[number].rows * ROW);
      if (numbers.length > MOST_ROWS)
        add({ name: `and ${numbers.length - MOST_ROWS} more: search for them`, members: [] }, ROW);
    }
    const folded = this.folded.has(PROPERTIES);
    const { verdicts } = historyOf(this.recording);
    if (properties.length) add({ role: PROPERTIES, name: "properties", members: [], count: properties.length, folded }, HEAD - 6);
    properties.forEach((each, number) => {
      const violated = verdicts[number].some(({ verdict }) => verdict === "false");
      if (!folded || violated) add({ name: each.name, property: number, members: [] }, ROW - 4);
    });
    this.bottom = top;
    this.scroller.style.height = `${HEAD + top + 2}px`; // the page shrinks it if there are many
    this.of = new Map();
    for (const row of this.rows) for (const each of row.members) this.of.set(each, row);
    this.#heads();
    this.draw();
    this.show(this.player.moment);
  }

  draw() {
    const ratio = devicePixelRatio || 1;
    const [width, height] = [this.scroller.clientWidth - this.heads.offsetWidth, this.scroller.clientHeight];
    if (width < 10 || height < 10) return;
    this.width = width;
    this.canvas.width = Math.round(width * ratio);
    this.canvas.height = Math.round(height * ratio);
    this.canvas.style.width = `${width}px`;
    this.canvas.style.height = `${height}px`;
    this.canvas.style.transform = `translateY(${this.scroller.scrollTop}px)`;
    this.body.style.height = `${this.bottom + HEAD}px`;
    this.cursor.style.height = `${Math.max(this.bottom + HEAD, height)}px`;
    const pen = this.canvas.getContext("2d");
    const style = getComputedStyle(this.canvas);
    this.ink = style.color;
    this.faint = style.borderColor;
    pen.scale(ratio, ratio);
    pen.font = "11px system-ui, sans-serif";
    pen.textBaseline = "middle";
    drawAxis(pen, this, height);
    pen.save();
    pen.beginPath();
    pen.rect(0, HEAD, width, height - HEAD);
    pen.clip();
    pen.translate(0, HEAD - this.scroller.scrollTop);
    for (const row of this.rows) {
      if (row.top + row.height < this.scroller.scrollTop || row.top > this.scroller.scrollTop + height) continue;
      drawRow(pen, this, row);
    }
    if (this.arrows) drawArrows(pen, this);
    pen.restore();
    this.changed();
  }

  #fits(member, number) {
    if (!this.sought) return true;
    if (member.name.toLowerCase().includes(this.sought)) return true;
    return this.stays[number].states.some((each) => each?.some((state) => state.toLowerCase().includes(this.sought)));
  }

  #build(element, title) {
    const { player } = this;
    this.heads = el("div", { class: "heads", role: "list", "aria-label": "members" });
    this.canvas = el("canvas", { "aria-hidden": "true" });
    this.cursor = el("div", { class: "cursor" });
    this.body = el("div", { class: "bars" }, this.canvas, this.cursor);
    this.hint = el("div", { class: "hint", hidden: true });
    this.scroller = el("div", { class: "lanes" }, this.heads, this.body);
    this.search = el("input", {
      type: "search",
      placeholder: "search members and states",
      "aria-label": "search members and states",
      oninput: () => this.seek(this.search.value),
    });
    const arrows = el("input", { type: "checkbox", checked: true, onchange: () => this.draw((this.arrows = arrows.checked)) });
    const bar = el(
      "div",
      { class: "bar" },
      ...(title ? [el("strong", {}, title)] : []),
      this.search,
      el("label", {}, arrows, " swarm events"),
      el("button", { type: "button", title: "zoom in (+)", onclick: () => this.zoom(2) }, "+"),
      el("button", { type: "button", title: "zoom out (-)", onclick: () => this.zoom(0.5) }, "\u2212"),
      el("button", { type: "button", title: "whole run (0)", onclick: () => this.zoom(1e-9) }, "whole run"),
      el("span", { class: "key" }, "\u2192 taken, \u21e5 kept, \u25cb ignored, \u00d7 lost"),
    );
    element.append(bar, this.scroller, this.hint);
    this.scroller.addEventListener("scroll", () => this.draw());
    this.scroller.addEventListener(
      "wheel",
      (event) => {
        if (!event.ctrlKey && !event.metaKey && !event.altKey) return;
        event.preventDefault();
        this.zoom(event.deltaY < 0 ? 1.25 : 0.8, this.time(event.offsetX));
      },
      { passive: false },
    );
    const place = (event) => {
      const box = this.body.getBoundingClientRect();
      return [event.clientX - box.left, event.clientY - box.top - HEAD];
    };
    let brush = null;
    this.body.addEventListener("pointerdown", (event) => {
      const [x, y] = place(event);
      this.body.setPointerCapture(event.pointerId);
      brush = event.shiftKey ? x : null;
      if (brush !== null) return;
      const row = this.rowAt(y);
      player.goTime(this.time(x));
      if (row) player.select(row.members.length === 1 ? row.name : row.members.length ? row.role : null);
    });
    this.body.addEventListener("pointermove", (event) => {
      const [x, y] = place(event);
      if (event.buttons && brush === null) player.goTime(this.time(x));
      this.#tell(x, y, event);
    });
    this.body.addEventListener("pointerup", (event) => {
      const [x] = place(event);
      if (brush !== null && Math.abs(x - brush) > 4) {
        [this.from, this.to] = [Math.max(0, this.time(Math.min(x, brush))), Math.min(this.range, this.time(Math.max(x, brush)))];
        this.draw();
        this.show(player.moment);
      }
      brush = null;
    });
    this.body.addEventListener("pointerleave", () => (this.hint.hidden = true));
  }

  rowAt(y) {
    return this.rows.find((row) => y >= row.top && y <= row.top + row.height);
  }

  #heads() {
    const made = this.rows.map((row) => {
      row.state = el("span", { class: "state" });
      const style = row.role ? "role" : row.property !== undefined ? "property" : "member";
      const chosen = () => this.player.select(row.name);
      const inside = row.role
        ? el("button", { type: "button", "aria-expanded": String(!row.folded), onclick: () => this.fold(row.role) }, `${row.folded ? "\u25b8" : "\u25be"} ${row.name} (${row.count})`)
        : row.members.length
          ? el("button", { type: "button", onclick: chosen }, row.name, " ", row.state)
          : el("span", {}, row.name, " ", row.state);
      const item = el("div", { class: style, role: "listitem" }, inside);
      item.style.top = `${row.top + HEAD}px`;
      item.style.height = `${row.height}px`;
      return item;
    });
    this.heads.replaceChildren(...made);
  }

  /** Tell what is under the pointer. */
  #tell(x, y, event) {
    const row = this.rowAt(y);
    const time = this.time(x);
    const words = [clock(time)];
    const sent = (this.arrows ? (this.drawn ?? []) : []).find((each) => Math.abs(this.x(each.sent) - x) < 3);
    if (row?.members.length === 1) {
      const stays = this.stays[row.members[0]];
      const at = upTo(stays.times, time) - 1;
      if (at >= 0) {
        const [start, end] = [stays.times[at], stays.times[at + 1] ?? this.end];
        words.push(`${row.name}: ${stays.states[at]?.join(", ") ?? "lost"}`, `${duration(start)} to ${duration(end)}: ${duration(end - start)}`);
      }
    } else if (row) words.push(row.property !== undefined ? (this.recording.properties[row.property].text ?? row.name) : row.name);
    if (sent) {
      const fates = sent.to.map((to) => `${this.recording.members[to.member]?.name ?? "nobody"} (${to.fate})`);
      words.push(`${sent.event} from ${this.recording.members[sent.from]?.name ?? "outside"} to ${fates.slice(0, 5).join(", ")}${fates.length > 5 ? ` and ${fates.length - 5} more` : ""}`);
    }
    this.hint.replaceChildren(...words.map((each) => el("div", {}, each)));
    this.hint.hidden = false;
    this.hint.style.left = `${Math.max(0, Math.min(event.clientX + 14, innerWidth - 320))}px`;
    this.hint.style.top = `${event.clientY + 16}px`;
  }
}

/** Return the names of the robots of a fleet that are lost. */
function lostOf(fleet) {
  return new Set((fleet?.robots ?? []).filter((each) => each.status === "lost").map((each) => each.robot));
}

let lanes = null;

export const view = {
  id: "lanes",
  title: "Lanes",
  available: () => true,
  mount: (element, player) => (lanes = new Lanes(element, player, player.recording.other && "this run")),
  show: (moment) => lanes.show(moment),
};

/** Acts on the lanes, for keys. */
export const act = {
  zoom: (factor) => lanes.zoom(factor),
  search: () => lanes.search.focus(),
  window: () => [lanes.from, lanes.to],
};
