// A branch of a recording: its lines are replayed up to a moment, and then something else happens.
// What came from outside of the machines comes as recorded: events, losses, what was on its way,
// and the ends of functions that were running.
import { eventOf, NO_ENVELOPE } from "./engine.js";
import { decoded } from "./engine_values.js";
import { timeOf, typed, World } from "./engine_world.js";

const COMPARED = ["configuration", "entered", "exited", "started", "cancelled", "sent"];

function add(map, ...words) {
  const key = words.join("\0");
  map.set(key, (map.get(key) ?? 0) + 1);
  return map.get(key);
}

const outcomeOf = (run, event) =>
  Object.keys(run.activity.events).find((each) => run.activity.events[each] === event);

export class Branch {
  /** Fork after line `last` of the steps of a trace; `lost` is the event of a loss. */
  constructor(given, lines, last, lost) {
    Object.assign(this, { given, fork: last + 1, rows: [], difference: null, sent: new Map() });
    this.made = [];
    this.world = new World(given, (row) => this.made.push(row));
    Object.assign(this.world, { held: [], lost });
    this.lines = lines;
    const steps = lines.slice(0, last + 1);
    steps.forEach((line, at) => this.replay(line, at));
    this.at = last >= 0 ? timeOf(lines[last]) : 0n;
    this.world.clock.now = this.at;
    this.inputs = this.recorded(last);
    for (const alarm of this.world.held) if (alarm.action && !alarm.timer.over) this.world.clock.insert(alarm);
    this.world.held = null;
    this.world.heard = (row) => this.rows.push(row);
    this.made = [];
  }

  /** Let a line happen again, and compare what it does. */
  replay(line, at) {
    const member = this.world.names.get(line.member);
    if (!member) return;
    const { clock } = this.world;
    const time = timeOf(line);
    // Servers that stop at the same time as this line come later, unless its event was sent then.
    const isNew = line.envelope ? Math.floor(line.envelope.sent / 1e6) === line.t
      : this.sent.has([member.robot.name, line.event, line.t, "own"].join("\0"));
    const limit = isNew ? time : time - 1n;
    while (clock.next !== null && clock.next <= limit) clock.step();
    if (time > clock.now) clock.now = time;
    // What a machine does by itself has a line already.
    if (!this.made.length) this.happen(member, line);
    this.world.flush();
    this.note(this.sent, line);
    const row = this.made.shift();
    const isSame = row && row.member === line.member && row.event === line.event
      && COMPARED.every((key) => (row[key] ?? []).join() === (line[key] ?? []).join());
    if (isSame) return;
    this.difference ??= { at, line, row };
    this.made = [];
  }

  happen(member, line) {
    const { world } = this;
    const { event } = line;
    const { instance } = member;
    if (event === null) return world.startMember(member);
    if (event === world.lost) return world.lose(member);
    const timer = instance.timers.find((each) => each.event.name === event);
    if (timer) return instance.receive(timer.event);
    const run = [...instance.runs.values()].find((each) => outcomeOf(each, event));
    if (run && !run.ended) return this.end(run, line);
    world.deliver(member, this.event(line));
  }

  end(run, line) {
    const blank = decoded(this.given.functions[run.activity.name].blank);
    this.world.end(run, outcomeOf(run, line.event), line.data ? typed(line.data, blank) : null);
  }

  event({ event, data, envelope }) {
    const message = this.world.events.get(event)?.message;
    const facts = envelope ? { sender: envelope.sender, sent: BigInt(envelope.sent), to: null } : NO_ENVELOPE;
    return eventOf(event, data === undefined ? message ?? null : typed(data, message), null, facts);
  }

  /** Lines after the fork that begin with something from outside, or begun before. */
  recorded(last) {
    const found = [];
    const [after, seen] = [new Map(), new Map()];
    const { world, sent } = this;
    const gone = new Set();
    for (const line of this.lines.slice(last + 1)) this.note(after, line);
    this.lines.forEach((line, at) => {
      const member = world.names.get(line.member);
      if (!member || line.recalled) return;
      const { instance, robot } = member;
      const isLater = at > last;
      const put = (action) => { if (isLater) found.push({ at, time: timeOf(line), action }); };
      if (line.event === null) put(() => world.startMember(member));
      else if (line.event === world.lost) put(() => world.lose(member));
      else if (!world.events.has(line.event)) {
        const run = isLater && [...instance.runs.values()].find((each) => outcomeOf(each, line.event));
        if (run && !gone.has(run)) {
          gone.add(run);
          put(() => { if (world.ends.has(run)) this.end(run, line); });
        }
      } else {
        const { sender } = line.envelope ?? {};
        const key = sender
          ? [sender, line.event, Math.floor(line.envelope.sent / 1e6)].join("\0")
          : [robot.name, line.event, line.t, "own"].join("\0");
        const number = add(seen, line.member, key);
        const later = after.get(key) ?? 0;
        const before = (sender ? world.counts.get(`way\0${robot.name}\0${key}`) : sent.get(key)) ?? 0;
        // Of events for the robot itself, those that machines sent come last.
        const isFromOutside = !later && !(sender && before);
        if (isFromOutside || number <= before) put(() => world.deliver(member, this.event(line)));
      }
      if (isLater) {
        for (const run of instance.runs.values()) {
          if (line.exited?.includes(instance.machine.states[run.state].id)) gone.add(run);
        }
      }
    });
    return found;
  }

  /** Count what a line sends, by who hears it: other robots, or its own. */
  note(map, line) {
    const robot = this.world.names.get(line.member)?.robot;
    if (!robot) return;
    (line.sent ?? []).forEach((event, n) => {
      const declared = this.world.events.get(event);
      if (declared?.swarm) add(map, robot.name ?? "", event, line.t);
      if ((line.to?.[n] ?? null) !== null || !declared) return;
      for (const [name, each] of this.world.events) {
        if (each.incoming === declared.topic) add(map, robot.name, name, line.t, "own");
      }
    });
  }

  // ---- going on

  get time() {
    return this.world.clock.now;
  }

  /** The time of what happens next by itself, or null. */
  get next() {
    const [own, input] = [this.world.clock.next, this.inputs[0]?.time ?? null];
    return own === null || (input !== null && input < own) ? input : own;
  }

  /** Let the next thing happen; return false if there is none. */
  step() {
    const own = this.world.clock.next;
    const input = this.inputs[0];
    if (own === null && !input) return false;
    // At the same millisecond, the order is that of the recording.
    const sooner = own === null ? 1 : input ? Number(own / 1000000n - input.time / 1000000n) : -1;
    const isOwn = sooner < 0 || (sooner === 0 && this.fork + this.rows.length < input.at);
    if (isOwn) this.world.clock.step();
    else {
      this.inputs.shift();
      if (input.time > this.time) this.world.clock.now = input.time;
      input.action();
    }
    this.world.flush();
    return true;
  }

  /** Let time pass, and what comes in it. */
  pass(length) {
    const end = this.time + length;
    while (this.next !== null && this.next <= end) this.step();
    if (end > this.time) this.world.clock.now = end;
  }
}
