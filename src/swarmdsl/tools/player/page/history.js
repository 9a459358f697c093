// What has happened in a recording until each of its lines, collected once for the views.
import { own } from "./dom.js";
import { robotOf } from "./recording.js";

const NEAR = 0.05; // metres between two places of a trail
const known = new WeakMap();

/** The history of a recording, up to its last line. */
export function historyOf(recording) {
  if (!known.has(recording)) known.set(recording, new History(recording));
  return known.get(recording).read();
}

class History {
  #recording;
  #read = 0; // number of lines that have been read

  constructor(recording) {
    this.#recording = recording;
    this.verdicts = recording.properties.map(() => []); // [{at, time, verdict, remark}]
    this.measures = []; // [{at, time, values: {name: value}}]
    this.reached = new Map(); // lines by number of an element that coverage counts
    this.trails = new Map(); // {at, x, y, length} by name of a robot: lines, places, ways until there
    this.links = []; // [{at, pairs}]
    this.targets = []; // [{at, targets}]
    this.seen = []; // [{at, member, target, place}]
    this.told = []; // lines that the log shows
    this.hasVariables = false;
  }

  read() {
    for (; this.#read < this.#recording.count; this.#read++) this.#note(this.#read);
    return this;
  }

  #note(at) {
    const recording = this.#recording;
    const step = recording.step(at);
    if (step.moved !== undefined) this.#scene(at, step);
    else if (step.measures !== undefined) {
      const values = {};
      for (const { name, value } of recording.value(at, "measures") ?? []) values[name] = value;
      if (step.fitness?.name) values[step.fitness.name] = step.fitness.value;
      this.measures.push({ at, time: recording.time(at), values });
    } else this.told.push(at);
    if (step.property !== undefined) {
      const number = recording.properties.findIndex((each) => each.name === step.property);
      this.verdicts[number]?.push({ at, time: recording.time(at), verdict: step.verdict, remark: step.remark ?? "" });
    } else if (step.configuration) this.#step(at, step);
  }

  #step(at, step) {
    const recording = this.#recording;
    const member = recording.members[recording.memberAt(at)];
    this.hasVariables ||= step.variables !== undefined;
    if (!member) return;
    const numbers = own(recording.coverage?.of ?? {}, member.machine);
    if (numbers)
      for (const id of [...step.entered, ...(step.taken ?? [])])
        if (Object.hasOwn(numbers, id) && !this.reached.has(numbers[id])) this.reached.set(numbers[id], at);
    const place = recording.value(at, "at");
    if (place) this.#move(at, robotOf(member.name), place);
  }

  #scene(at, step) {
    const recording = this.#recording;
    const moved = recording.value(at, "moved") ?? {};
    for (const robot in moved) this.#move(at, robot, moved[robot]);
    if (step.links) this.links.push({ at, pairs: step.links });
    if (step.targets) this.targets.push({ at, targets: step.targets });
    if (step.saw && moved[step.saw.member]) this.seen.push({ at, ...step.saw, place: moved[step.saw.member] });
  }

  #move(at, robot, [x, y]) {
    let trail = this.trails.get(robot);
    if (!trail) this.trails.set(robot, (trail = { at: [], x: [], y: [], length: [] }));
    const last = trail.at.length - 1;
    const way = last < 0 ? 0 : Math.hypot(x - trail.x[last], y - trail.y[last]);
    if (last >= 0 && way < NEAR) return;
    trail.at.push(at);
    trail.x.push(x);
    trail.y.push(y);
    trail.length.push((trail.length[last] ?? 0) + way);
  }
}
