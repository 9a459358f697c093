// The world of a branch: members in virtual time, their events, and the functions that they call.
// What is random is drawn from the same numbers as in the simulator, by its questions.
import { Clock, drawn, Stream } from "./engine_clock.js";
import { eventOf, Instance, Machine, NO_ENVELOPE, Servers } from "./engine.js";
import { copied, decoded, Failure, plain } from "./engine_values.js";

const MILLISECOND = 1000000n;
const RETRY = 100n * MILLISECOND;
const MOST = 10000; // lines at one point in time

export const timeOf = (line) => BigInt(Math.round(line.t)) * MILLISECOND;

/** Data of a trace as values; floats that are whole count as integers, which are equal. */
export function typed(value, blank) {
  if (typeof value === "number") return Number.isInteger(value) ? BigInt(value) : value;
  if (typeof value === "string" && typeof blank === "bigint") return Number(value);
  if (Array.isArray(value)) return value.map((each) => typed(each, null));
  if (value === null || typeof value !== "object") return value;
  const made = Object.create(null);
  for (const key of Object.keys(value)) made[key] = typed(value[key], blank?.[key]);
  return made;
}

export class World {
  constructor(given, heard) {
    Object.assign(this, { given, heard, clock: new Clock(), row: null, held: null });
    Object.assign(this, { counts: new Map(), arrivals: new Map(), ends: new Map(), busy: [0n, 0] });
    const machines = new Map(Object.entries(given.machines).map(([name, table]) => [name, new Machine(table)]));
    this.events = new Map(Object.entries(given.events));
    for (const each of this.events.values()) each.message = decoded(each.blank);
    this.robots = given.robots.map((each) => ({ ...each, members: [], isGone: false, missing: new Map() }));
    this.members = given.members.map(({ name, robot, machine, data }) => {
      const member = { name, robot: this.robots[robot], machine: machines.get(machine), data };
      member.robot.members.push(member);
      this.renew(member);
      return member;
    });
    this.names = new Map(this.members.map((each) => [each.name, each]));
  }

  /** Give a member a new instance, with the first values of its variables. */
  renew(member) {
    const { robot } = member;
    if (robot.members[0] === member) robot.servers = new Servers();
    member.instance = new Instance(member.machine, this, decoded(member.data), this, robot.servers);
    member.instance.member = member;
  }

  count(...words) {
    const key = words.join("\0");
    this.counts.set(key, (this.counts.get(key) ?? 0) + 1);
    return this.counts.get(key);
  }

  // ---- called by a branch

  startMember(member) {
    if (member.instance.running || member.instance.final) this.renew(member);
    member.robot.isGone = false;
    this.begin(member, null);
    member.instance.start();
    this.flush();
  }

  lose(member) {
    this.begin(member, this.lost);
    member.robot.isGone = true;
    member.instance.running = false;
    for (const run of [...this.ends.keys()]) if (run.instance === member.instance) this.leave(run);
    this.flush();
  }

  /** Let a member process an event. */
  deliver(member, event) {
    const { robot, instance } = member;
    if (this.events.get(event.name)?.predefined) {
      if (event.name === "member_lost") robot.missing.set(event.data?.id, event.data?.role);
      else robot.missing.delete(event.data?.id);
    }
    if (!instance.running) return;
    this.begin(member, event.name, event.data, event.envelope);
    instance.receive(event);
    this.flush();
  }

  /** End a run with an outcome, and the result of a success. */
  end(run, outcome, data = null) {
    const { blank, service } = this.given.functions[run.activity.name];
    if (outcome === "succeeded") data ??= decoded(blank);
    if (outcome === "succeeded" && service && data?.success === false) outcome = run.activity.refused;
    this.leave(run);
    run.end(outcome, data);
    this.flush();
  }

  /** Runs of the functions that a member has called. */
  runsOf(member) {
    return [...this.ends.keys()].filter((run) => run.instance === member.instance);
  }

  // ---- called by instances

  get time() {
    return this.clock.now;
  }

  schedule(delay, action, timer) {
    const alarm = this.clock.schedule(delay, action);
    if (this.held && timer) this.hold(Object.assign(alarm, { timer }));
    return alarm;
  }

  /** While lines are replayed, timers and ends of functions wait: lines tell when they come. */
  hold(alarm) {
    this.clock.alarms = this.clock.alarms.filter((each) => each !== alarm);
    this.held.push(alarm);
  }

  unschedule(alarm) {
    this.clock.unschedule(alarm);
  }

  failed() {}

  present({ member }, role) {
    const there = this.robots.filter((each) => role === null || each.role === role).length;
    const missing = [...member.robot.missing.values()].filter((each) => role === null || each === role);
    return BigInt(there - missing.length);
  }

  neighbors() {
    throw new Failure("robots have no places here");
  }

  run(run) {
    const { robot } = run.instance.member;
    const found = this.given.functions[run.activity.name];
    return [robot.name, found.kinds[found.robots[this.robots.indexOf(robot)]], decoded(found.blank)];
  }

  /** Start a run of a function; a run that a space or nobody ends waits for the user. */
  start(run) {
    const name = run.activity.name;
    const [robot, kind, blank] = this.run(run);
    const call = this.count("call", robot, name);
    this.ends.set(run, null);
    if (this.held || kind.model) return;
    const stream = new Stream(this.given.seed, robot ?? "None", name, call);
    const isCertain = !(kind.aborted || kind.preempted || kind.never || kind.results.length > 1);
    let [outcome, result] = ["succeeded", kind.results[0]];
    if (!isCertain || kind.duration[0] !== "fixed") {
      let chance = stream.random();
      for (const word of ["aborted", "preempted", "never"]) {
        if (outcome === "succeeded" && chance < kind[word]) outcome = word;
        chance -= kind[word];
      }
      result = kind.results[Math.floor(stream.random() * kind.results.length)] ?? kind.results[0];
    }
    if (outcome === "never") return;
    const data = outcome === "succeeded" ? Object.assign(blank, result && decoded({ m: result.m })) : null;
    this.ends.set(run, this.clock.schedule(drawn(kind.duration, stream), () => this.end(run, outcome, data)));
  }

  cancel(run) {
    this.leave(run);
    const [robot, kind] = this.run(run);
    const call = this.counts.get(["call", robot, run.activity.name].join("\0"));
    const stream = new Stream(this.given.seed, robot ?? "None", run.activity.name, call, "stops");
    this.clock.schedule(drawn(kind.stopping, stream), () => run.end("preempted"));
  }

  leave(run) {
    const alarm = this.ends.get(run);
    if (alarm) this.unschedule(alarm);
    this.ends.delete(run);
  }

  send({ member }, event) {
    const { robot } = member;
    const declared = this.events.get(event.name);
    const { to } = event.envelope;
    const data = this.signed(declared, event.data, robot.name ?? "");
    const here = to === null ? [...this.events].filter(([, each]) => each.incoming === declared.topic) : [];
    for (const [name] of here) {
      const own = robot.members.filter((each) => each.machine.listens(name));
      if (own.length && !this.held) {
        this.clock.schedule(0n, () => { for (const each of own) this.deliver(each, eventOf(name, data)); });
      }
    }
    if (!declared.swarm) return;
    const arriving = eventOf(event.name, data, null, { sender: robot.name ?? "", sent: this.time, to });
    const others = this.robots.filter((each) => each !== robot && (to === null || (to && [each.name, each.role].includes(to))));
    if (!others.length && to !== null && robot.name !== null) this.row?.nobody.push(event.name);
    for (const other of others) {
      const heard = other.members.filter((each) => each.machine.listens(event.name));
      if (heard.length) this.transmit(arriving, declared, robot, other, heard);
    }
  }

  transmit(event, { topic, reliable }, robot, other, heard) {
    const { seed, latency, loss } = this.given;
    const number = this.count("to", robot.name, other.name);
    if (other.isGone || robot.isGone) return;
    const isCertain = latency[0] === "fixed" && !loss;
    const stream = isCertain ? null : new Stream(seed, robot.name, "to", other.name, number);
    let wait = 0n;
    let isLost = loss > 0 && stream.random() < loss;
    if (!isCertain && !loss) stream.random();
    while (isLost && reliable && loss < 1) {
      wait += RETRY;
      isLost = stream.random() < loss;
    }
    const due = this.time + wait + drawn(latency, stream);
    if (isLost) return;
    const channel = [robot.name, other.name, topic].join("\0");
    const last = this.arrivals.get(channel) ?? 0n;
    const arrives = due > last ? due : last;
    this.arrivals.set(channel, arrives);
    // Its arrival has a line, but what is sent later must not overtake it.
    if (this.held) this.count("way", other.name, robot.name, event.name, this.time / MILLISECOND);
    else this.clock.schedule(arrives - this.time, () => { for (const each of heard) this.deliver(each, event); });
  }

  /** A message with the headers that robots fill in. */
  signed({ headers, topic, swarm }, data, sender) {
    for (const [name, kind] of headers) {
      data = Object.assign(Object.create(null), data);
      const header = (data[name] = copied(data[name] ?? Object.create(null)));
      if (kind === "ros") header.stamp ||= this.time;
      else {
        if (swarm && sender) header.node = sender;
        header.name ||= topic;
        header.node ||= sender;
      }
    }
    return data;
  }

  // ---- lines of the trace

  begin(member, event, data = null, envelope = NO_ENVELOPE) {
    this.flush();
    this.busy = this.busy[0] === this.time ? [this.time, this.busy[1] + 1] : [this.time, 1];
    if (this.busy[1] > MOST) throw new Error("too much happens at one point in time");
    const lists = ["entered", "exited", "taken", "started", "cancelled", "sent", "to", "nobody", "scheduled", "withdrawn", "dropped"];
    this.row = { t: Number(this.time / MILLISECOND), member: member.name, event, data: plain(data), envelope, of: member };
    for (const each of lists) this.row[each] = [];
  }

  flush() {
    if (!this.row) return;
    const { of, data, envelope, ...row } = this.row;
    this.row = null;
    const { final, configuration } = of.instance;
    row.configuration = final ? [final] : configuration.innermost;
    row.taken = [...new Set(row.taken)];
    if (data !== null && typeof data === "object" && Object.keys(data).length) row.data = data;
    if (envelope.sender) row.envelope = { sender: envelope.sender, sent: Number(envelope.sent) };
    for (const key of ["scheduled", "withdrawn", "dropped", "nobody"]) if (!row[key].length) delete row[key];
    if (row.to.every((each) => each === null)) delete row.to;
    const { self, ...variables } = plain(of.instance.data);
    row.variables = variables;
    this.heard(row);
  }

  received({ member }, event) {
    if (event.origin) this.begin(member, event.name, event.data);
  }
  recalled({ member }, event) {
    this.begin(member, event.name, event.data, event.envelope);
    this.row.recalled = true;
  }
  ignored() { this.row.ignored = true; }
  deferred() { this.row.deferred = true; }
  dropped(instance, event) { this.row.dropped.push(event.name); }
  entered(instance, state) { this.row.entered.push(state.id); }
  exited(instance, state) { if (instance.final === null) this.row.exited.push(state.id); }
  taken(instance, edge) { this.row.taken.push(edge.called); }
  started(instance, run) { this.row.started.push(run.activity.name); }
  cancelled(instance, run) { this.row.cancelled.push(run.activity.name); }
  withdrawn(instance, event) { this.row.withdrawn.push(event.name); }
  sent(instance, event) {
    this.row.sent.push(event.name);
    this.row.to.push(event.envelope.to);
  }
  scheduled(instance, event, delay) {
    this.row.scheduled.push({ event: event.name, to: event.envelope.to, after: Number(delay / MILLISECOND) });
  }
}
