// Message sequence chart of a window around the moment: one row for all receivers of an event, and for repeats.
import { clock, el, printable } from "./dom.js";
import { robotOf } from "./recording.js";
import { press, shape, write } from "./shapes.js";

const BEFORE = 0.7; // share of the rows that are before the moment
const MOST = 1500; // lines that are looked at in each direction
const [ROW, TOP, LEFT] = [22, 26, 64];
const FATES = ["taken", "deferred", "ignored", "lost"];
const WORDS = { taken: "taken by", deferred: "kept by", ignored: "ignored by", lost: "lost on the way to" };

export const view = {
  id: "sequence",
  title: "Messages",

  available: (recording) => recording.members.length > 0,

  mount(element, player) {
    this.player = player;
    this.said = el("p", { class: "said" });
    this.picture = shape("svg", { class: "sequence", role: "list", "aria-label": "Messages and states around the moment" });
    const legend = [
      ["taken", "taken"],
      ["deferred", "kept"],
      ["ignored", "ignored"],
      ["lost", "lost"],
    ].map(([fate, word]) => el("span", {}, key(fate), ` ${word} `));
    const box = el("div", { class: "chart-box" }, this.picture);
    element.append(el("p", { class: "legend" }, ...legend, this.said), box);
    [this.width, this.height] = [600, 400];
    new ResizeObserver(([{ contentRect }]) => {
      const { width, height } = contentRect;
      if (Math.abs(width - this.width) + Math.abs(height - this.height) < ROW) return;
      [this.width, this.height] = [width, height];
      this.show(player.moment);
    }).observe(box);
  },

  show(moment) {
    const { rows, now } = this.rows(moment.index);
    const { members } = this.player.recording;
    const columns = new Map();
    for (const row of rows) for (const number of [row.member, ...FATES.flatMap((fate) => row[fate] ?? [])]) if (number >= 0) columns.set(number, 0);
    const numbers = [...columns.keys()].sort((one, other) => one - other);
    const wide = Math.max(26, Math.min(140, (this.width - LEFT - 40) / Math.max(numbers.length, 1)));
    numbers.forEach((number, at) => columns.set(number, LEFT + wide * (at + 0.5)));
    const [width, height] = [LEFT + wide * numbers.length + 20, TOP + ROW * rows.length + 8];
    const heads = numbers.map((number) => {
      const x = columns.get(number);
      const { name, role, index } = members[number];
      const label = wide > 6.5 * name.length ? name : `${role.slice(0, 1)}${index}`;
      return shape("g", {}, shape("title", {}, name), shape("text", { class: "head", x, y: 14 }, label), shape("line", { class: "life", x1: x, x2: x, y1: TOP - 6, y2: height }));
    });
    const drawn = rows.map((row, at) => this.row(row, TOP + ROW * at, columns, wide, row.line > moment.index ? "later" : at === now ? "now" : ""));
    this.picture.setAttribute("width", Math.round(width));
    this.picture.setAttribute("height", height);
    this.picture.replaceChildren(...heads, ...drawn);
    write(this.said, rows[now] ? this.words(rows[now]) : "");
  },

  /** Rows of the window, in the order of time, and which of them is about the moment. */
  rows(index) {
    const { recording, selected } = this.player;
    const chosen = selected === null ? null : new Set(recording.selected(selected));
    const most = Math.max(6, Math.floor((this.height - TOP - 8) / ROW));
    const before = Math.round(most * BEFORE);
    // Rows that say the same are joined: look for more.
    const found = bundled(this.look(index, -1, 3 * before, chosen));
    const ahead = this.look(index + 1, 1, 2 * (most - before), chosen);
    const rows = bundled([...found.slice(-before), ...ahead]).slice(0, most);
    return { rows, now: rows.findLastIndex((row) => row.line <= index) };
  },

  /** Look for some rows from a line on, in one direction. */
  look(from, way, most, chosen) {
    const { recording } = this.player;
    const rows = new Map();
    for (let at = from; at >= 0 && at < recording.count && Math.abs(at - from) < MOST; at += way) {
      for (const { key, member, event, to, fate, ...more } of this.facts(at, recording)) {
        if (chosen && !chosen.has(member) && !chosen.has(to)) continue;
        let row = rows.get(key);
        if (!row) {
          if (rows.size >= most) return [...rows.values()];
          row = { key, member, event, ...more, time: recording.time(at), line: at, lines: [], times: 1 };
          rows.set(key, row);
        }
        if (fate) (row[fate] ??= []).push(to);
        row.lines.push(at);
        row.line = Math.min(row.line, at);
        row.time = Math.min(row.time, recording.time(at));
      }
    }
    return [...rows.values()];
  },

  /** What a line adds to the chart: an event that has come or is lost, and new states. */
  *facts(at, recording) {
    const step = recording.step(at);
    const member = recording.memberAt(at);
    const message = (sender, event, sent) => ({ key: `${sender}\n${event}\n${Math.round(sent)}`, sender, member: recording.ofRobot(sender)[0] ?? -1, event });
    if (step.lost !== undefined) {
      const { event, sender, member: to, sent } = recording.value(at, "lost");
      yield { ...message(sender, event, sent), to: recording.ofRobot(to)[0] ?? -1, fate: "lost" };
      return;
    }
    if (!step.configuration || member < 0) return;
    const envelope = recording.value(at, "envelope");
    const fate = step.ignored ? "ignored" : step.deferred ? "deferred" : "taken";
    if (envelope?.sender) yield { ...message(envelope.sender, step.event, envelope.sent), to: member, fate };
    else if (step.event && step.event !== recording.lost && !/^(do|after|send)\./.test(step.event))
      yield { key: `\n${step.event}\n${recording.time(at)}`, member: -1, event: step.event, to: member, fate };
    if (step.entered.length || step.event === recording.lost) {
      const gone = step.event === recording.lost;
      const states = step.configuration.filter((id) => step.entered.includes(id));
      yield { key: at, member, states, text: gone ? "\u2717 lost" : states.map((id) => id.slice(id.lastIndexOf(".") + 1)).join(", ") };
    }
    for (const event of step.nobody ?? []) yield { key: `nobody ${at} ${event}`, member, event, fate: "lost", to: -1 };
  },

  row(row, y, columns, wide, mark) {
    const { recording } = this.player;
    const words = printable(this.words(row));
    const parts = [shape("title", {}, words), shape("rect", { class: "band", x: 0, y: y - 2, width: this.width, height: ROW })];
    parts.push(shape("text", { class: "time", x: 2, y: y + 14 }, clock(row.time)));
    const middle = y + 12;
    if (row.event === undefined) {
      const x = columns.get(row.member);
      const { machine } = recording.members[row.member];
      const long = Math.min(6.6 * row.text.length + 14, wide - 4);
      const room = Math.max(1, Math.floor((long - 10) / 6.4));
      const fill = row.states.length ? recording.colourOf(machine, row.states[0]) : "none";
      parts.push(shape("rect", { class: "state", x: x - long / 2, y: y + 2, width: long, height: ROW - 6, rx: 7, fill }));
      parts.push(shape("text", { class: "label", x, y: y + 14 }, row.text.length > room + 1 ? `${row.text.slice(0, room)}\u2026` : row.text));
    } else {
      const from = columns.get(row.member) ?? LEFT;
      let label = from;
      for (const fate of FATES) {
        const ends = (row[fate] ?? []).map((number) => columns.get(number) ?? from + 24);
        if (!ends.length) continue;
        const [low, high] = [Math.min(from, ...ends), Math.max(from, ...ends)];
        parts.push(shape("path", { class: `way ${fate}`, d: `M${low.toFixed(1)},${middle}H${high.toFixed(1)}` }));
        parts.push(shape("path", { class: `tip ${fate}`, d: ends.map((end) => tip(fate, end, middle, end < from ? -1 : 1)).join("") }));
        label = Math.max(label, high);
      }
      if (row.member >= 0) parts.push(shape("circle", { class: "source", cx: from, cy: middle, r: 3 }));
      const text = `${row.event}${row.times > 1 ? ` \u00d7${row.times}` : ""}`;
      parts.push(shape("text", { class: "event", x: Math.min(from, ...FATES.flatMap((fate) => (row[fate] ?? []).map((each) => columns.get(each) ?? from))) + 6, y: middle - 3 }, text));
    }
    const go = press(() => this.player.go(row.lines.at(-1)));
    return shape("g", { class: `row ${mark}`, role: "listitem", "aria-label": words, ...go }, ...parts);
  },

  words(row) {
    const { members } = this.player.recording;
    const name = (number) => members[number]?.name ?? "nobody";
    if (row.event === undefined) return `${clock(row.time)} ${name(row.member)}: ${row.text}`;
    const to = (fate) => (row[fate].every((each) => each < 0) ? "reaches no robot" : `${WORDS[fate]} ${[...new Set(row[fate])].map(name).join(", ")}`);
    const ends = FATES.filter((fate) => row[fate]?.length).map(to);
    const who = row.sender ?? (row.member < 0 ? "outside" : robotOf(name(row.member)));
    return `${clock(row.time)} ${row.event} from ${who}${row.times > 1 ? `, ${row.times} times` : ""}: ${ends.join("; ")}`;
  },
};

/** Join rows of one event, and those that follow each other and say the same. */
function bundled(rows) {
  const [kept, keys] = [[], new Map()];
  for (const row of rows) {
    const same = keys.get(row.key);
    if (same) for (const part of ["lines", ...FATES]) same[part] = [...(same[part] ?? []), ...(row[part] ?? [])];
    else keys.set(row.key, row);
  }
  const said = (each) => `${each.event}\n${each.member}\n${FATES.map((fate) => [...new Set(each[fate])].sort()).join("|")}`;
  for (const row of [...keys.values()].sort((one, other) => one.line - other.line)) {
    const before = kept.at(-1);
    if (before?.event !== undefined && row.event !== undefined && said(before) === said(row)) {
      before.times += 1;
      before.lines.push(...row.lines);
    } else kept.push(row);
  }
  return kept;
}

/** The end of an arrow: filled, with a bar, open, or a cross. */
function tip(fate, x, y, way) {
  const [back, at] = [-8 * way, x.toFixed(1)];
  if (fate === "lost") return `M${(x + back - 4).toFixed(1)},${y - 4}l8,8m0,-8l-8,8`;
  const arrow = `M${at},${y}l${back},-4v8z`;
  return fate === "deferred" ? `${arrow}m0,-5v10` : arrow;
}

const key = (fate) =>
  shape("svg", { class: "sequence key", width: 34, height: 12, "aria-hidden": "true" }, shape("path", { class: `way ${fate}`, d: "M0,6H30" }), shape("path", { class: `tip ${fate}`, d: tip(fate, 30, 6, 1) }));
