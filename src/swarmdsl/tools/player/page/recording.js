// Recording of a run: lines of a trace, and the moment after each of them.
import { unpack } from "./unpack.js";

const EVERY = 512; // lines from one snapshot to the next, more if there are more members
const MILLISECOND = 1e6;
const THOUSAND = 1000;
const NOBODY = { states: [], variables: {}, place: null, alive: false, line: -1, since: -1 };

/** Return the recording in a text of base64 of deflated JSON. */
export const load = async (text) => new Recording(JSON.parse(await unpack(text)));

/** Return the role of a name like `uav[3]`, and the name of its robot without the part. */
export const robotOf = (name) => (/^[^\].]*\[\d+\]/.exec(name) ?? [name])[0];

export class Recording {
  #steps;
  #names;
  #values;
  #columns;
  #row = {}; // by key: number of each line in the column of the key, or -1
  #times;
  #step;
  #member;
  #more = []; // lines that were appended
  #snapshots = [];
  #every;
  #numbers = new Map();
  #robots = new Map();
  #messages = null;

  constructor({ lines, count, ...head }) {
    Object.assign(this, head);
    this.count = count;
    this.members.forEach((each, number) => this.#join(each, number));
    this.#every = Math.max(EVERY, this.members.length);
    this.#steps = lines.steps;
    this.#names = lines.names;
    this.#values = lines.values;
    this.#columns = lines.columns;
    this.#times = new Float64Array(count);
    this.#step = Int32Array.from(lines.columns.step ?? []);
    this.#member = Int32Array.from(lines.columns.member ?? [], (at) => (at < 0 ? -1 : this.number(this.#names[at])));
    let time = 0;
    for (let at = 0; at < count; at++) this.#times[at] = (time += lines.columns.t[at]) * MILLISECOND;
    this.#index();
    this.#unfold();
    this.#shoot(0);
  }

  /** Number of a member by its name, or -1. */
  number(name) {
    return this.#numbers.get(name) ?? -1;
  }

  /** Numbers of the members that are a robot with its parts. */
  ofRobot(name) {
    return this.#robots.get(name) ?? [];
  }

  /** Numbers of the members that a name selects: that of a member, of a robot or of a role. */
  selected(name) {
    if (this.#numbers.has(name)) return [this.#numbers.get(name)];
    if (this.#robots.has(name)) return this.#robots.get(name);
    return this.members.flatMap((each, number) => (each.role === name ? [number] : []));
  }

  /** Time of a line in nanoseconds. */
  time(at) {
    if (at < 0) return 0;
    return at < this.#times.length ? this.#times[at] : this.#more[at - this.#times.length].time;
  }

  /** The last line at or before a time, or -1. */
  at(time) {
    let [low, high] = [0, this.count];
    while (low < high) {
      const middle = (low + high) >> 1;
      if (this.time(middle) <= time) low = middle + 1;
      else high = middle;
    }
    return low - 1;
  }

  /** What a line says of its step, without its time, its member and what varies: shared, not to be changed. */
  step(at) {
    const own = this.#times.length;
    return at < own ? this.#steps[this.#step[at]] : this.#more[at - own].line;
  }

  /** Number of the member of a line, or -1. */
  memberAt(at) {
    const own = this.#times.length;
    return at < own ? this.#member[at] : this.#more[at - own].member;
  }

  /** A line of the trace, with its `time` in nanoseconds and its `index`. */
  line(at) {
    const own = this.#times.length;
    if (at >= own) return { ...this.#more[at - own].line, time: this.time(at), index: at };
    const found = { t: this.#times[at] / MILLISECOND };
    if (this.#member[at] >= 0) found.member = this.members[this.#member[at]].name;
    Object.assign(found, this.#steps[this.#step[at]]);
    for (const key in this.#columns) if (this.#row[key]?.[at] >= 0) found[key] = this.#varying(key, at);
    return Object.assign(found, { time: this.#times[at], index: at });
  }

  /** Value of a key of a line that differs from line to line, or undefined. */
  value(at, key) {
    const own = this.#times.length;
    if (at >= own) return this.#more[at - own].line[key];
    return this.#row[key]?.[at] >= 0 ? this.#varying(key, at) : undefined;
  }

  /** State of the whole swarm after a line; -1 is before the first one. */
  moment(at) {
    const index = Math.min(at, this.count - 1);
    const number = Math.max(0, Math.floor(index / this.#every));
    const found = copied(this.#snapshots[number]);
    for (let each = number * this.#every; each <= index; each++) this.#apply(found, each);
    found.index = index;
    found.time = this.time(index);
    return found;
  }

  /** Add a member of a run that goes on. */
  join(member) {
    this.members.push(member);
    this.#join(member, this.members.length - 1);
    for (const each of this.#snapshots) each.members.push(NOBODY);
  }

  /** Append a line of a trace, of a run that goes on. */
  append(line) {
    if (line.member !== undefined && this.number(line.member) < 0)
      this.join({ name: line.member, role: line.member.replace(/\[\d+\]/, ""), machine: "", index: 0 });
    const time = line.t * MILLISECOND;
    const member = line.member === undefined ? -1 : this.number(line.member);
    this.#more.push({ line, time, member });
    this.count += 1;
    this.end = Math.max(this.end, time);
    this.#messages = null;
    this.#shoot(this.#snapshots.length);
  }

  /** A recording of the first lines up to one, without later ones, to be continued with `append`. */
  until(at) {
    const head = Object.fromEntries(Object.entries(this));
    const empty = { steps: [], names: [], values: [], columns: {} };
    const found = new Recording({ ...head, members: [...this.members], end: 0, count: 0, lines: empty });
    for (let each = 0; each <= at; each++) {
      const { time, index, ...line } = this.line(each);
      found.append(line);
    }
    return found;
  }

  /** Colour of a state, the same in all views. */
  colourOf(machine, state) {
    return this.machines[machine]?.colours[state] ?? "#c5c9cf";
  }

  /**
   * Swarm events between robots, in the order of their lines:
   * {event, from, to (numbers of members, or -1), sent, received (ns), line, fate};
   * fate is `taken`, `ignored`, `deferred`, `lost` or `nobody`.
   */
  get messages() {
    this.#messages ??= this.#collected();
    return this.#messages;
  }

  #join(member, number) {
    const robot = robotOf(member.name);
    this.#numbers.set(member.name, number);
    if (!this.#robots.has(robot)) this.#robots.set(robot, []);
    this.#robots.get(robot).push(number);
  }

  #varying(key, at) {
    const value = this.#columns[key][this.#row[key][at]];
    if (key === "envelope") return { sender: this.#names[value[0]], sent: this.#times[at] - value[1] };
    return key === "at" || key === "moved" ? value : this.#values[value];
  }

  #index() {
    const keys = Object.keys(this.#columns).filter((key) => !["t", "member", "step"].includes(key));
    for (const key of keys) {
      const rows = (this.#row[key] = new Int32Array(this.#times.length).fill(-1));
      const has = this.#steps.map((each) => each[key] === 0);
      let next = 0;
      for (let at = 0; at < rows.length; at++) if (has[this.#step[at]]) rows[at] = next++;
    }
  }

  /** Add up the ways that robots have moved. */
  #unfold() {
    const places = new Map();
    const moved = (name, way) => {
      const before = places.get(name);
      const now = way.map((each, axis) => each + (before?.length === way.length ? before[axis] : 0));
      places.set(name, now);
      return now.map((each) => each / THOUSAND);
    };
    const { at: own = [], moved: all = [] } = this.#columns;
    for (let at = 0; at < this.#times.length; at++) {
      const [one, many] = [this.#row.at?.[at] ?? -1, this.#row.moved?.[at] ?? -1];
      if (one >= 0) own[one] = moved(this.members[this.#member[at]]?.name, own[one]);
      if (many >= 0)
        all[many] = Object.fromEntries(
          all[many].map(([name, ...way]) => [this.#names[name], moved(this.#names[name], way)]),
        );
    }
  }

  /** Make the snapshots from one on. */
  #shoot(number) {
    const start = { members: this.members.map(() => NOBODY), properties: [], measures: null };
    start.properties = this.properties.map(() => "open");
    const state = number ? copied(this.#snapshots[number - 1]) : start;
    if (!number) this.#snapshots[0] = copied(start);
    for (let next = Math.max(number, 1); next * this.#every < this.count; next++) {
      for (let at = (next - 1) * this.#every; at < next * this.#every; at++) this.#apply(state, at);
      this.#snapshots[next] = copied(state);
    }
  }

  #apply(state, at) {
    const step = this.step(at);
    if (step.configuration) {
      const number = this.memberAt(at);
      if (number < 0) return;
      const before = state.members[number];
      const lost = step.event === this.lost;
      const more = this.value(at, "variables");
      const states = lost ? [] : step.configuration;
      const place = this.value(at, "at");
      state.members[number] = {
        states,
        variables: more ? { ...before.variables, ...more } : before.variables,
        place: place ?? before.place,
        alive: !lost,
        line: at,
        since: same(states, before.states) && before.alive === !lost ? before.since : at,
      };
      if (place) for (const each of this.ofRobot(robotOf(this.members[number].name))) put(state, each, place);
    } else if (step.property !== undefined) {
      const number = this.properties.findIndex((each) => each.name === step.property);
      if (number >= 0) state.properties[number] = step.verdict;
    } else if (step.measures !== undefined) {
      state.measures = this.value(at, "measures");
    } else if (step.moved !== undefined) {
      const moved = this.value(at, "moved") ?? {};
      for (const name in moved) for (const each of this.ofRobot(name)) put(state, each, moved[name]);
    }
  }

  #collected() {
    const found = [];
    const note = (event, robot, to, sent, at, fate) =>
      found.push({ event, from: this.ofRobot(robot)[0] ?? -1, to, sent, received: this.time(at), line: at, fate });
    for (let at = 0; at < this.count; at++) {
      const step = this.step(at);
      if (step.lost !== undefined) {
        const { event, sender, member, sent } = this.value(at, "lost");
        note(event, sender, this.ofRobot(member)[0] ?? -1, sent, at, "lost");
      }
      if (!step.configuration || this.memberAt(at) < 0) continue;
      for (const event of step.nobody ?? []) note(event, robotOf(this.members[this.memberAt(at)].name), -1, this.time(at), at, "nobody");
      const envelope = step.recalled ? undefined : this.value(at, "envelope");
      if (envelope?.sender) {
        const fate = step.ignored ? "ignored" : step.deferred ? "deferred" : "taken";
        note(step.event, envelope.sender, this.memberAt(at), envelope.sent, at, fate);
      }
    }
    return found;
  }
}

const copied = (state) => ({ ...state, members: [...state.members], properties: [...state.properties] });
const same = (one, other) => one.length === other.length && one.every((each, at) => each === other[at]);
const put = (state, number, place) => (state.members[number] = { ...state.members[number], place });
