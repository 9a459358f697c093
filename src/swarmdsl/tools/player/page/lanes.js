// Lanes: a row for each member, bars of states over time, arrows of swarm events.
import { clock, duration, el, printable } from "./dom.js";
import { bundles, stayAt, staysOf } from "./stays.js";

const ROW = 20; // height of a region
const GAP = 4;
const HEAD = 22; // height of the head of a role, and of the axis
const LETTER = 6.3;
const MOST_ROWS = 500; // of one role; others are found by search
const PROPERTIES = "\n"; // the group of properties, which is no role
const SOME = 6; // properties that are shown without folding; a violated one always is
const FEW = 60; // members that are shown without folding
const BUNDLE = 5; // pixels
const CROWD = 3; // receivers from which on a bundle is a trunk
const STEPS = [0.001, 0.002, 0.005, 0.01, 0.02, 0.05, 0.1, 0.2, 0.5, 1, 2, 5, 10, 15, 30, 60, 120, 300, 600, 900, 1800, 3600, 7200, 21600];
const VERDICTS = { true: "#44bb99", open: "#eedd88", false: "#ee8866" };

class Lanes {
  constructor(element, player) {
    const { recording } = player;
    this.player = player;
    this.recording = recording;
    this.stays = staysOf(recording);
    this.folded = new Set();
    this.sought = "";
    this.arrows = true;
    this.end = Math.max(recording.end, 1);
    [this.from, this.to] = [0, this.end];
    this.verdicts = this.#verdicts();
    const roles = [...new Set(recording.members.map((each) => each.role))];
    if (recording.properties.length > SOME) this.folded.add(PROPERTIES);
    if (recording.members.length > FEW) roles.forEach((each) => this.folded.add(each));
    this.#build(element);
    new ResizeObserver(() => this.draw()).observe(this.scroller);
    matchMedia("(prefers-color-scheme: dark)").addEventListener("change", () => this.draw());
    player.on("selection", () => this.draw());
    player.on("bookmarks", () => this.draw());
    this.layOut();
  }

  /** Show a moment: the cursor, and the states in the heads of the rows. */
  show(moment) {
    const x = this.x(this.player.time);
    const inside = x >= 0 && x <= this.width;
    if (!inside && this.player.playing) this.zoom(1, this.player.time);
    this.cursor.style.transform = `translateX(${this.x(this.player.time)}px)`;
    this.cursor.hidden = x < 0 || x > this.width;
    for (const row of this.rows) {
      if (row.members.length !== 1) continue;
      const { states, alive, line } = moment.members[row.members[0]];
      const text = line < 0 ? "" : alive ? states.map((each) => each.split(".").at(-1)).join(", ") : "lost";
      if (row.text !== text) row.state.textContent = printable((row.text = text));
    }
  }

  x(time) {
    return ((time - this.from) / (this.to - this.from)) * this.width;
  }

  time(x) {
    return this.from + (x / this.width) * (this.to - this.from);
  }

  /** Zoom by a factor, so that a time keeps its place, or comes into view. */
  zoom(factor, around = this.player.time) {
    const length = Math.min(this.end, Math.max((this.to - this.from) / factor, 1e6));
    const seen = around >= this.from && around <= this.to;
    const share = seen ? (around - this.from) / (this.to - this.from) : 0.1;
    this.from = Math.max(0, Math.min(around - share * length, this.end - length));
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
    if (properties.length) add({ role: PROPERTIES, name: "properties", members: [], count: properties.length, folded }, HEAD - 6);
    properties.forEach((each, number) => {
      const violated = this.verdicts[number].some(({ verdict }) => verdict === "false");
      if (!folded || violated) add({ name: each.name, property: number, members: [] }, ROW - 4);
    });
    this.bottom = top;
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
    this.#axis(pen, height);
    pen.save();
    pen.beginPath();
    pen.rect(0, HEAD, width, height - HEAD);
    pen.clip();
    pen.translate(0, HEAD - this.scroller.scrollTop);
    for (const row of this.rows) {
      if (row.top + row.height < this.scroller.scrollTop || row.top > this.scroller.scrollTop + height) continue;
      if (row.property !== undefined) this.#property(pen, row);
      else if (row.folded && row.members.length) this.#crowd(pen, row);
      else if (row.members.length) this.#lane(pen, row);
    }
    if (this.arrows) this.#arrows(pen);
    pen.restore();
  }

  #fits(member, number) {
    if (!this.sought) return true;
    if (member.name.toLowerCase().includes(this.sought)) return true;
    return this.stays[number].states.some((each) => each?.some((state) => state.toLowerCase().includes(this.sought)));
  }

  #build(element) {
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
      this.search,
      el("label", {}, arrows, " swarm events"),
      el("button", { type: "button", title: "zoom in (+)", onclick: () => this.zoom(2) }, "+"),
      el("button", { type: "button", title: "zoom out (-)", onclick: () => this.zoom(0.5) }, "\u2212"),
      el("button", { type: "button", title: "whole run (0)", onclick: () => this.zoom(1e-9) }, "whole run"),
      el("span", { class: "key" }, "\u2192 taken, \u25cb ignored, \u00d7 lost"),
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
        [this.from, this.to] = [Math.max(0, this.time(Math.min(x, brush))), Math.min(this.end, this.time(Math.max(x, brush)))];
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

  #axis(pen, height) {
    const seconds = (this.to - this.from) / 1e9;
    const step = STEPS.find((each) => seconds / each <= this.width / 90) ?? seconds / 8;
    pen.textAlign = "left";
    for (let at = Math.ceil(this.from / 1e9 / step) * step; at <= this.to / 1e9; at += step) {
      const x = this.x(at * 1e9);
      pen.fillStyle = this.faint;
      pen.fillRect(x, 0, 1, height);
      pen.fillStyle = this.ink;
      pen.fillText(step < 1 ? clock(at * 1e9) : clock(at * 1e9).slice(0, -4), x + 4, HEAD / 2);
    }
    pen.fillStyle = "#aa3377";
    for (const each of this.player.bookmarks) pen.fillRect(this.x(each) - 1, 0, 3, HEAD);
  }

  #lane(pen, row) {
    const [number] = row.members;
    const { machine, name } = this.recording.members[number];
    const stays = this.stays[number];
    const { selected } = this.player;
    if (selected === name || selected === this.recording.members[number].role) {
      pen.fillStyle = "#aa3377";
      pen.fillRect(0, row.top - 2, this.width, 1);
      pen.fillRect(0, row.top + row.height + 1, this.width, 1);
    }
    let last = -1; // the pixel up to which is drawn
    for (let at = Math.max(0, stayAt(stays, this.from)); at < stays.times.length && stays.times[at] <= this.to; at++) {
      const start = Math.max(0, this.x(stays.times[at]));
      const end = Math.min(this.width, this.x(stays.times[at + 1] ?? this.end));
      if (end - last < 0.7 && end < this.width) continue; // it is below a pixel that is drawn
      last = end;
      this.#bar(pen, machine, stays.states[at], start, end - start, row);
    }
  }

  #bar(pen, machine, states, x, width, row) {
    if (states === null || !states.length) {
      this.#hatch(pen, x, row.top, width, row.height, states === null ? "lost" : "");
      return;
    }
    const height = row.height / states.length;
    states.forEach((state, slot) => {
      const top = row.top + slot * height;
      pen.fillStyle = this.recording.colourOf(machine, state);
      pen.fillRect(x, top, Math.max(width - (width > 3 ? 0.75 : 0), 0.7), height - 0.5);
      const label = shortened(state, width - 6);
      if (!label) return;
      pen.fillStyle = "#1d2733";
      pen.fillText(label, x + 3, top + height / 2);
    });
  }

  #hatch(pen, x, top, width, height, label) {
    pen.save();
    pen.beginPath();
    pen.rect(x, top, width, height);
    pen.clip();
    pen.strokeStyle = this.ink;
    pen.lineWidth = 1;
    pen.beginPath();
    for (let at = x - height - (x % 6); at < x + width; at += 6) {
      pen.moveTo(at, top + height);
      pen.lineTo(at + height, top);
    }
    pen.stroke();
    pen.restore();
    if (width > LETTER * (label.length + 1)) {
      pen.fillStyle = this.ink;
      pen.fillText(label, x + 3, top + height / 2);
    }
  }

  /** Draw how many of a role are in which state. */
  #crowd(pen, row) {
    const next = row.members.map((each) => stayAt(this.stays[each], this.from));
    const { machine } = this.recording.members[row.members[0]];
    const share = row.height / row.members.length;
    for (let x = 0; x < this.width; x += 2) {
      const time = this.time(x + 1);
      const counts = new Map();
      row.members.forEach((each, at) => {
        const { times, states } = this.stays[each];
        while (times[next[at] + 1] <= time) next[at] += 1;
        for (const state of states[next[at]] ?? [""]) counts.set(state, (counts.get(state) ?? 0) + 1 / (states[next[at]]?.length || 1));
      });
      let top = row.top;
      for (const state of [...counts.keys()].sort()) {
        const height = counts.get(state) * share;
        pen.fillStyle = state ? this.recording.colourOf(machine, state) : this.faint;
        pen.fillRect(x, top, 2, height);
        top += height;
      }
    }
  }

  #property(pen, row) {
    const changes = this.verdicts[row.property];
    changes.forEach(({ time, verdict }, at) => {
      const [start, end] = [Math.max(0, this.x(time)), Math.min(this.width, this.x(changes[at + 1]?.time ?? this.end))];
      if (end <= start) return;
      pen.fillStyle = VERDICTS[verdict] ?? this.faint;
      pen.fillRect(start, row.top, Math.max(end - start, 1), row.height);
      pen.fillStyle = "#1d2733";
      if (end - start > LETTER * (verdict.length + 1)) pen.fillText(verdict, start + 3, row.top + row.height / 2);
    });
  }

  #verdicts() {
    const found = this.recording.properties.map(() => [{ time: 0, verdict: "open" }]);
    for (let at = 0; at < this.recording.count; at++) {
      const { property, verdict } = this.recording.step(at);
      const number = property === undefined ? -1 : this.recording.properties.findIndex((each) => each.name === property);
      if (number >= 0) found[number].push({ time: this.recording.time(at), verdict });
    }
    return found;
  }

  #arrows(pen) {
    const near = ((this.to - this.from) / this.width) * BUNDLE;
    const { messages } = this.recording;
    const key = [this.from, this.to, near, messages.length].join();
    if (this.bundled !== key) this.drawn = bundles(messages, this.from, this.to, near);
    this.bundled = key;
    pen.strokeStyle = pen.fillStyle = this.ink;
    const { selected } = this.player;
    const chosen = selected === null ? [] : this.recording.selected(selected);
    for (const each of this.drawn) {
      const source = this.of.get(each.from);
      const targets = each.to.flatMap((to) => {
        const row = this.of.get(to.member);
        return to.fate === "nobody" ? [{ ...to, row: source }] : row && row !== source ? [{ ...to, row }] : [];
      });
      if (!source || !targets.length) continue;
      const own = chosen.includes(each.from) || each.to.some((to) => chosen.includes(to.member));
      pen.globalAlpha = !chosen.length || own ? 0.75 : 0.12;
      pen.lineWidth = Math.min(1 + Math.log2(each.count) / 3, 3);
      if (targets.length > CROWD) this.#trunk(pen, each, source, targets);
      else for (const to of targets) this.#arrow(pen, each, source, to);
      pen.globalAlpha = 1;
    }
  }

  /** Draw an event to many: one line past all rows, with a mark at each that gets it. */
  #trunk(pen, each, source, targets) {
    const x = this.x(each.sent);
    const middles = [source, ...targets.map((to) => to.row)].map((row) => row.top + row.height / 2);
    pen.beginPath();
    pen.moveTo(x, Math.min(...middles));
    pen.lineTo(x, Math.max(...middles));
    pen.stroke();
    pen.fillRect(x - 2.5, source.top + source.height / 2 - 2.5, 5, 5);
    for (const to of targets) this.#mark(pen, x, to.row.top + to.row.height / 2, to.fate);
  }

  #arrow(pen, each, source, to) {
    const down = to.row.top >= source.top;
    const [x, end] = [this.x(each.sent), this.x(to.received)];
    const start = source.top + (down ? source.height : 0);
    const tip = to.fate === "nobody" ? start + 8 : to.row.top + (down ? 0 : to.row.height);
    const stop = to.fate === "lost" || to.fate === "nobody" ? (start + tip) / 2 : tip;
    const over = to.fate === "lost" ? (x + end) / 2 : end;
    pen.setLineDash(to.fate === "lost" ? [3, 3] : to.fate === "ignored" ? [1, 2] : []);
    pen.beginPath();
    pen.moveTo(x, start);
    pen.lineTo(over, stop);
    pen.stroke();
    pen.setLineDash([]);
    this.#mark(pen, over, stop, to.fate, down);
  }

  /** Draw the end of an arrow: a tip where an event is taken, a circle where it is ignored, a cross where it is lost. */
  #mark(pen, x, y, fate, down) {
    pen.beginPath();
    if (fate === "lost" || fate === "nobody") {
      pen.moveTo(x - 3, y - 3);
      pen.lineTo(x + 3, y + 3);
      pen.moveTo(x - 3, y + 3);
      pen.lineTo(x + 3, y - 3);
      pen.stroke();
    } else if (fate === "ignored") {
      pen.arc(x, y, 2.5, 0, 7);
      pen.stroke();
    } else if (down === undefined) {
      pen.arc(x, y, 2, 0, 7);
      pen.fill();
    } else {
      const back = down ? -5 : 5;
      pen.moveTo(x, y);
      pen.lineTo(x - 3, y + back);
      pen.lineTo(x + 3, y + back);
      pen.fill();
    }
  }

  /** Tell what is under the pointer. */
  #tell(x, y, event) {
    const row = this.rowAt(y);
    const time = this.time(x);
    const words = [clock(time)];
    const sent = (this.arrows ? (this.drawn ?? []) : []).find((each) => Math.abs(this.x(each.sent) - x) < 3);
    if (row?.members.length === 1) {
      const stays = this.stays[row.members[0]];
      const at = stayAt(stays, time);
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
    this.hint.style.left = `${Math.min(event.clientX + 14, innerWidth - 320)}px`;
    this.hint.style.top = `${event.clientY + 16}px`;
  }
}

/** Shorten a name to fit: its last segment, or its first letters. */
function shortened(state, width) {
  const room = Math.floor(width / LETTER);
  const last = printable(state.slice(state.lastIndexOf(".") + 1));
  if (last.length <= room) return last;
  return room >= 4 ? `${last.slice(0, room - 1)}\u2026` : "";
}

let lanes = null;

export const view = {
  id: "lanes",
  title: "Lanes",
  available: () => true,
  mount: (element, player) => (lanes = new Lanes(element, player)),
  show: (moment) => lanes.show(moment),
};

/** Acts on the lanes, for keys. */
export const act = {
  zoom: (factor) => lanes.zoom(factor),
  search: () => lanes.search.focus(),
  window: () => [lanes.from, lanes.to],
};
