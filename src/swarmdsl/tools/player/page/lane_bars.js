// Bars of the lanes on their canvas: states of members and roles, verdicts, the axis.
import { clock, printable } from "./dom.js";
import { historyOf } from "./history.js";
import { upTo } from "./shapes.js";

const HEAD = 22; // height of the axis
const LETTER = 6.3;
const STEPS = [0.001, 0.002, 0.005, 0.01, 0.02, 0.05, 0.1, 0.2, 0.5, 1, 2, 5, 10, 15, 30, 60, 120, 300, 600, 900, 1800, 3600, 7200, 21600];
const SILENT = 8; // least width of what is not known of a lost robot
const PALE = "#88888899";
const VERDICTS = { true: "#44bb99", open: "#eedd88", false: "#ee8866" };

/** Draw the bars of a row. */
export function drawRow(pen, lanes, row) {
  if (row.property !== undefined) drawProperty(pen, lanes, row);
  else if (row.folded && row.members.length) drawCrowd(pen, lanes, row);
  else if (row.members.length) drawLane(pen, lanes, row);
}

/** Draw the times of the axis, and the bookmarks. */
export function drawAxis(pen, lanes, height) {
  const seconds = (lanes.to - lanes.from) / 1e9;
  const step = STEPS.find((each) => seconds / each <= lanes.width / 90) ?? seconds / 8;
  pen.textAlign = "left";
  for (let at = Math.ceil(lanes.from / 1e9 / step) * step; at <= lanes.to / 1e9; at += step) {
    const x = lanes.x(at * 1e9);
    pen.fillStyle = lanes.faint;
    pen.fillRect(x, 0, 1, height);
    pen.fillStyle = lanes.ink;
    pen.fillText(step < 1 ? clock(at * 1e9) : clock(at * 1e9).slice(0, -4), x + 4, HEAD / 2);
  }
  pen.fillStyle = "#aa3377";
  for (const each of lanes.player.bookmarks) pen.fillRect(lanes.x(each) - 1, 0, 3, HEAD);
}

/** Draw the states of a member. */
function drawLane(pen, lanes, row) {
  const [number] = row.members;
  const { machine, name } = lanes.recording.members[number];
  const stays = lanes.stays[number];
  const { selected } = lanes.player;
  if (selected === name || selected === lanes.recording.members[number].role) {
    pen.fillStyle = "#aa3377";
    pen.fillRect(0, row.top - 2, lanes.width, 1);
    pen.fillRect(0, row.top + row.height + 1, lanes.width, 1);
  }
  let last = -1; // the pixel up to which is drawn
  for (let at = Math.max(0, upTo(stays.times, lanes.from) - 1); at < stays.times.length && stays.times[at] <= lanes.to; at++) {
    const start = Math.max(0, lanes.x(stays.times[at]));
    const end = Math.min(lanes.width, lanes.x(stays.times[at + 1] ?? lanes.end));
    if (end - last < 0.7 && end < lanes.width) continue; // it is below a pixel that is drawn
    last = end;
    bar(pen, lanes, machine, stays.states[at], start, end - start, row);
  }
  if (!lanes.isSilent(number, lanes.to)) return;
  // Its states may be others by now.
  const end = Math.min(lanes.width, lanes.x(lanes.end));
  const start = Math.max(0, Math.min(lanes.x(stays.heard), end - SILENT));
  pen.fillStyle = PALE;
  pen.fillRect(start, row.top, end - start, row.height);
  hatch(pen, lanes.ink, start, row.top, end - start, row.height, "lost");
}

function bar(pen, lanes, machine, states, x, width, row) {
  if (states === null || !states.length) {
    hatch(pen, lanes.ink, x, row.top, width, row.height, states === null ? "lost" : "");
    return;
  }
  const height = row.height / states.length;
  states.forEach((state, slot) => {
    const top = row.top + slot * height;
    pen.fillStyle = lanes.recording.colourOf(machine, state);
    pen.fillRect(x, top, Math.max(width - (width > 3 ? 0.75 : 0), 0.7), height - 0.5);
    const label = shortened(state, width - 6);
    if (!label) return;
    pen.fillStyle = "#1d2733";
    pen.fillText(label, x + 3, top + height / 2);
  });
}

function hatch(pen, ink, x, top, width, height, label) {
  pen.save();
  pen.beginPath();
  pen.rect(x, top, width, height);
  pen.clip();
  pen.strokeStyle = ink;
  pen.lineWidth = 1;
  pen.beginPath();
  for (let at = x - height - (x % 6); at < x + width; at += 6) {
    pen.moveTo(at, top + height);
    pen.lineTo(at + height, top);
  }
  pen.stroke();
  pen.restore();
  if (width > LETTER * (label.length + 1)) {
    pen.fillStyle = ink;
    pen.fillText(label, x + 3, top + height / 2);
  }
}

/** Draw how many of a role are in which state. */
function drawCrowd(pen, lanes, row) {
  const next = row.members.map((each) => upTo(lanes.stays[each].times, lanes.from) - 1);
  const { machine } = lanes.recording.members[row.members[0]];
  const share = row.height / row.members.length;
  for (let x = 0; x < lanes.width; x += 2) {
    const time = lanes.time(x + 1);
    const counts = new Map();
    row.members.forEach((each, at) => {
      const { times, states } = lanes.stays[each];
      while (times[next[at] + 1] <= time) next[at] += 1;
      for (const state of states[next[at]] ?? [""]) counts.set(state, (counts.get(state) ?? 0) + 1 / (states[next[at]]?.length || 1));
    });
    let top = row.top;
    for (const state of [...counts.keys()].sort()) {
      const height = counts.get(state) * share;
      pen.fillStyle = state ? lanes.recording.colourOf(machine, state) : lanes.faint;
      pen.fillRect(x, top, 2, height);
      top += height;
    }
  }
}

/** Draw the verdicts on a property. */
function drawProperty(pen, lanes, row) {
  const changes = [{ time: 0, verdict: "open" }, ...historyOf(lanes.recording).verdicts[row.property]];
  changes.forEach(({ time, verdict }, at) => {
    const [start, end] = [Math.max(0, lanes.x(time)), Math.min(lanes.width, lanes.x(changes[at + 1]?.time ?? lanes.end))];
    if (end <= start) return;
    pen.fillStyle = VERDICTS[verdict] ?? lanes.faint;
    pen.fillRect(start, row.top, Math.max(end - start, 1), row.height);
    pen.fillStyle = "#1d2733";
    if (end - start > LETTER * (verdict.length + 1)) pen.fillText(verdict, start + 3, row.top + row.height / 2);
  });
}

/** Shorten a name to fit: its last segment, or its first letters. */
function shortened(state, width) {
  const room = Math.floor(width / LETTER);
  const last = printable(state.slice(state.lastIndexOf(".") + 1));
  if (last.length <= room) return last;
  return room >= 4 ? `${last.slice(0, room - 1)}\u2026` : "";
}
