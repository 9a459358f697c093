// Arrows of swarm events in the lanes.
import { bundles } from "./stays.js";

const BUNDLE = 5; // pixels
const CROWD = 3; // receivers from which on a bundle is a trunk

/** Draw the swarm events of the window, those of one sender at nearly one time together. */
export function drawArrows(pen, lanes) {
  const near = ((lanes.to - lanes.from) / lanes.width) * BUNDLE;
  const { messages } = lanes.recording;
  const key = [lanes.from, lanes.to, near, messages.length].join();
  if (lanes.bundled !== key) lanes.drawn = bundles(messages, lanes.from, lanes.to, near);
  lanes.bundled = key;
  pen.strokeStyle = pen.fillStyle = lanes.ink;
  const { selected } = lanes.player;
  const chosen = selected === null ? [] : lanes.recording.selected(selected);
  for (const each of lanes.drawn) {
    const source = lanes.of.get(each.from);
    const targets = each.to.flatMap((to) => {
      const row = lanes.of.get(to.member);
      return to.fate === "nobody" ? [{ ...to, row: source }] : row && row !== source ? [{ ...to, row }] : [];
    });
    if (!source || !targets.length) continue;
    const own = chosen.includes(each.from) || each.to.some((to) => chosen.includes(to.member));
    pen.globalAlpha = !chosen.length || own ? 0.75 : 0.12;
    pen.lineWidth = Math.min(1 + Math.log2(each.count) / 3, 3);
    if (targets.length > CROWD) trunk(pen, lanes, each, source, targets);
    else for (const to of targets) arrow(pen, lanes, each, source, to);
    pen.globalAlpha = 1;
  }
}

/** Draw an event to many: one line past all rows, with a mark at each that gets it. */
function trunk(pen, lanes, each, source, targets) {
  const x = lanes.x(each.sent);
  const middles = [source, ...targets.map((to) => to.row)].map((row) => row.top + row.height / 2);
  pen.beginPath();
  pen.moveTo(x, Math.min(...middles));
  pen.lineTo(x, Math.max(...middles));
  pen.stroke();
  pen.fillRect(x - 2.5, source.top + source.height / 2 - 2.5, 5, 5);
  for (const to of targets) mark(pen, x, to.row.top + to.row.height / 2, to.fate);
}

function arrow(pen, lanes, each, source, to) {
  const down = to.row.top >= source.top;
  const [x, end] = [lanes.x(each.sent), lanes.x(to.received)];
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
  mark(pen, over, stop, to.fate, down);
}

/** Draw the end of an arrow: a tip where an event is taken, with a bar where it is kept, a circle where it is ignored, a cross where it is lost. */
function mark(pen, x, y, fate, down) {
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
  if (fate === "deferred") pen.fillRect(x - 5, y - 1, 10, 2);
}
