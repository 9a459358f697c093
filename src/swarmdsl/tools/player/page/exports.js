// Save what is seen: the window of the lanes as a behaviour test, an events file or a picture.
import { clock, download, el, printable } from "./dom.js";
import { act } from "./lanes.js";
import { staysOf } from "./stays.js";
import { TestText, toml, written } from "./test_text.js";

const MOST = 500; // expectations of a test
const [WIDTH, LEFT, ROW, TOP] = [1200, 150, 20, 60]; // of a picture, in pixels
const LETTER = 6.3;

const millis = (time) => Math.floor(time / 1e6);

const OWN = /^(after|do|done|error|fault|node|send)\./; // events that a member makes itself

/** Events from outside in a window: `[{time, event, member, data}]`. */
function outside(recording, from, to) {
  const found = [];
  for (let at = Math.max(0, recording.at(from - 1)); at < recording.count && recording.time(at) <= to; at++) {
    const { event, recalled } = recording.step(at);
    const member = recording.memberAt(at);
    if (!event || member < 0 || recalled || OWN.test(event) || recording.time(at) < from || recording.value(at, "envelope")?.sender) continue;
    found.push({ time: millis(recording.time(at)), event, member: recording.members[member].name, data: recording.value(at, "data") });
  }
  return found;
}

/** The window as lines for `swarmc simulate --events`; its beginning is the start of the run. */
export function eventsFile(recording, from, to) {
  let last = millis(from);
  return outside(recording, from, to)
    .map(({ time, event, member, data }) => {
      const after = time - last;
      last = time;
      const one = recording.members.length > 1 || member.includes("[") ? { member } : {};
      return `${JSON.stringify({ event, after, ...one, ...(data ? { data } : {}) })}\n`;
    })
    .join("");
}

/** The states that members enter in the window, as a test for `swarmc test`. */
export function testFile(recording, from, to) {
  const { members, scenario, seed, model } = recording;
  const test = new TestText();
  // A scenario sends its events itself.
  const sends = scenario ? [] : outside(recording, 0, to);
  const alone = members.length === 1 && !members[0].name.includes("[");
  const send = ({ time, event, member, data }) => {
    test.pass(time * 1e6);
    const declared = recording.tables.events?.[event];
    const message = declared ? written(data, declared.blank, declared.times) : data;
    test.add({ send: event, to: alone ? null : member, data: message });
  };
  let expected = 0;
  const told = members.map(() => "");
  for (let at = Math.max(0, recording.at(from)); at < recording.count && recording.time(at) <= to && expected < MOST; at++) {
    const time = millis(recording.time(at));
    if (at + 1 < recording.count && millis(recording.time(at + 1)) === time) continue;
    const moment = recording.moment(at);
    const changed = moment.members.flatMap(({ states, alive, line }, number) => {
      const text = states.join();
      if (!alive || line < 0 || !states.length || told[number] === text) return [];
      told[number] = text;
      return [[members[number].name, states]];
    });
    if (!changed.length) continue;
    while (sends.length && sends[0].time <= time) send(sends.shift());
    test.pass(time * 1e6 + 999e3); // times of lines are whole milliseconds
    for (const [who, states] of changed) {
      test.add({ who: alone ? null : who, in: states });
      expected += states.length;
    }
  }
  return test.file(
    [
      `States from ${clock(from)} to ${clock(to)} of a run${seed === null ? "" : ` with seed ${seed}`}.`,
      ...(scenario ? ["The scenario belongs beside this file. Events from elsewhere are missing."] : []),
    ],
    !alone,
    model,
    scenario ? toml(scenario) : seed === null ? "" : toml({ seed }),
    `${clock(from)} to ${clock(to)}`,
  );
}

const escaped = (text) => printable(text).replace(/[&<>"]/g, (each) => `&#${each.charCodeAt(0)};`);

/** The lanes of the window as SVG. */
export function pictureFile(recording, from, to) {
  const stays = staysOf(recording);
  const x = (time) => LEFT + ((time - from) / (to - from || 1)) * WIDTH;
  const parts = [];
  const text = (left, top, words, style = "") => parts.push(`<text x="${left.toFixed(1)}" y="${top.toFixed(1)}"${style}>${escaped(words)}</text>`);
  text(12, 26, recording.title, ' font-size="17" font-weight="bold"');
  const { scenario, seed } = recording;
  text(12, 44, [scenario && `scenario ${scenario}`, seed !== null && `seed ${seed}`, `${clock(from)} to ${clock(to)}`].filter(Boolean).join(", "));
  let top = TOP;
  recording.members.forEach(({ name, machine }, number) => {
    const { times, states } = stays[number];
    const rows = Math.max(1, ...states.map((each) => each?.length ?? 1));
    text(LEFT - 8, top + (rows * ROW) / 2 + 4, name, ' text-anchor="end" font-weight="bold"');
    times.forEach((time, at) => {
      const [start, end] = [Math.max(from, time), Math.min(to, times[at + 1] ?? recording.end)];
      if (end <= start) return;
      const inside = states[at] ?? ["lost"];
      const height = (rows * ROW) / inside.length;
      inside.forEach((state, row) => {
        const width = Math.max(x(end) - x(start), 0.6);
        const colour = states[at] ? recording.colourOf(machine, state) : "#c0362c";
        parts.push(`<rect x="${x(start).toFixed(1)}" y="${(top + row * height).toFixed(1)}" width="${width.toFixed(1)}" height="${height.toFixed(1)}" fill="${escaped(colour)}" stroke="#fff"><title>${escaped(`${name}: ${state}`)}</title></rect>`);
        const label = state.split(".").at(-1);
        if (width > (label.length + 1) * LETTER) text(x(start) + 4, top + (row + 0.5) * height + 4, label);
      });
    });
    top += rows * ROW + 6;
  });
  const size = `width="${LEFT + WIDTH + 20}" height="${top + 12}"`;
  return `<svg xmlns="http://www.w3.org/2000/svg" ${size} font-family="sans-serif" font-size="11" fill="#1f2430"><rect width="100%" height="100%" fill="#fff"/>${parts.join("\n")}</svg>\n`;
}

const FILES = [
  ["Behaviour test", "run.swarmtest.toml", testFile],
  ["Events file", "events.jsonl", eventsFile],
  ["Picture", "run.svg", pictureFile],
];

/** Add a menu that saves the window of the lanes. */
export function exports(element, player) {
  const menu = el("details", { class: "save" }, el("summary", { title: "save the window of the lanes" }, "Save"));
  for (const [title, name, make] of FILES)
    menu.append(el("button", { type: "button", onclick: () => download(name, make(player.recording, ...act.window())) }, title));
  element.append(menu);
}
