// State machines: the algorithm of SCXML 1.0, Appendix D, as the simulator has it.
// Sets of states are BigInts with one bit for each; times are nanoseconds, as BigInt.

import { bounded, ceiled, compiled, copied, decoded, Failure, field, truth } from "./engine_values.js";

const bit = (number) => 1n << BigInt(number);

function members(set) {
  const found = [];
  for (let number = 0; set; number++, set >>= 1n) if (set & 1n) found.push(number);
  return found;
}

const matches = (events, name) => events.some((event) =>
  event.endsWith("*") ? `${name}.`.startsWith(event.slice(0, -1)) : event === name);

export const NO_ENVELOPE = { sender: "", sent: 0n, to: null };

/** An event; `origin` is the delay or run of the instance itself that sends it. */
export const eventOf = (name, data = null, origin = null, envelope = NO_ENVELOPE) =>
  ({ name, data, origin, envelope });

/** An event leads to an endless loop. */
export class LoopError extends Error {}

// ---- effects

const path = (held, fields) => fields.reduce((found, name) => {
  if (found === null || typeof found !== "object" || Array.isArray(found)) return null;
  return found[name] ??= Object.create(null);
}, held);

function store(data, variable, fields, value) {
  if (!fields.length) {
    data[variable] = value;
    return;
  }
  const held = path(data[variable], fields.slice(0, -1));
  if (held === null || typeof held !== "object" || Array.isArray(held)) {
    throw new Failure(`\`${variable}\` has no \`${fields.join(".")}\` to assign to`);
  }
  held[fields.at(-1)] = value;
}

const pairs = (list) => list.map(([name, tree]) => [name, compiled(tree)]);

/** Compile an effect to a function of an instance and an event. */
function effectOf([word, ...rest]) {
  switch (word) {
    case "all": {
      const effects = rest.map(effectOf);
      return (instance, event) => { for (const each of effects) each(instance, event); };
    }
    case "set": {
      const value = compiled(rest[2]);
      return (instance, event) => store(instance.data, rest[0], rest[1], value(instance, event));
    }
    case "send": return sending(...rest);
    case "cancel": return (instance) => instance.cancel(rest[0]);
    case "raise": return (instance) => instance.raise(eventOf(rest[0]));
    case "stop": return (instance) => { for (const name of rest) instance.cancel(name); };
    case "start": {
      const timers = pairs(rest);
      return (instance) => {
        for (const [name, delay] of timers) {
          instance.begin(name, ceiled(delay(instance, null)));
        }
      };
    }
    case "results": return (instance, event) => {
      for (const [name, bound, variable, fields] of rest) {
        const value = field(event.data, name);
        if (bound !== null) bounded(value, bound);
        store(instance.data, variable, fields, copied(value));
      }
    };
  }
  throw new Error(word);
}

function sending(name, blank, fields, address, delay) {
  const [first, values] = [decoded(blank), pairs(fields)];
  const wait = delay && compiled(delay);
  let to = () => null;
  if (address?.[0] === "id") to = compiled(address[1]);
  if (address?.[0] === "role") {
    const index = address[2] && compiled(address[2]);
    to = (...given) => index ? `${address[1]}[${index(...given)}]` : address[1];
  }
  return (instance, event) => {
    const message = copied(first);
    for (const [name, value] of values) message[name] = value(instance, event);
    const made = eventOf(name, message, null, { ...NO_ENVELOPE, to: to(instance, event) });
    if (wait) instance.emitAfter(made, ceiled(wait(instance, event)));
    else instance.emit(made);
  };
}

// ---- tables

/** A state machine, shared by its instances. */
export class Machine {
  constructor(table) {
    Object.assign(this, { name: table.name, limit: table.limit, most: table.most });
    this.configurations = new Map();
    let edges = 0;
    const edge = (each) => ({
      source: 0,
      ...each,
      number: edges++,
      test: each.guard ? compiled(each.guard) : null,
      run: each.effect ? effectOf(each.effect) : null,
    });
    this.states = table.states.map((each, number) => ({
      parent: 0,
      ...each,
      number,
      edges: (each.edges ?? []).map(edge),
      first: each.first ? edge(each.first) : null,
      entry: (each.entry ?? []).map(effectOf),
      exit: (each.exit ?? []).map(effectOf),
      deferred: each.deferred ?? [],
      activity: each.activity ? this.activity(each.activity) : null,
      inside: 0n,
      children: [],
    }));
    this.numbers = new Map(this.states.map((state) => [state.id, state.number]));
    // In the order of the states around them.
    this.histories = this.states.filter((each) => each.kind.endsWith("history"))
      .sort((one, other) => one.parent - other.parent).map((each) => each.number);
    this.eventless = 0n;
    for (const state of this.states) {
      if (state.edges.some((each) => !each.events.length)) this.eventless |= bit(state.number);
      if (!state.number) continue;
      if (!state.kind.endsWith("history")) this.states[state.parent].children.push(state.number);
      for (const around of this.around(state.number)) this.states[around].inside |= bit(state.number);
    }
    this.events = new Set(this.states.flatMap((state) => state.edges.flatMap((each) => each.events)));
  }

  activity(written) {
    const goal = written.goal && pairs(written.goal);
    return { ...written, goal, finalize: written.finalize && effectOf(written.finalize) };
  }

  /** The states around a state, innermost first, and the machine. */
  around(number) {
    const found = [];
    while (number) found.push(number = this.states[number].parent);
    return found;
  }

  ancestors(number) {
    return this.around(number).slice(0, -1);
  }

  listens(event) {
    return matches([...this.events], event);
  }
}

// ---- configurations: what events lead to depends only on active states and histories

class Configuration {
  constructor(machine, active, histories) {
    Object.assign(this, { machine, active, histories });
    this.restless = (active & machine.eventless) !== 0n;
    this.decisions = new Map();
    this.steps = new Map();
  }

  static at(machine, active, histories) {
    const key = `${active.toString(36)} ${histories.join()}`;
    let found = machine.configurations.get(key);
    if (!found) {
      if (machine.configurations.size >= 5000) machine.configurations.clear();
      machine.configurations.set(key, found = new Configuration(machine, active, histories));
    }
    return found;
  }

  get leaves() {
    return members(this.active).filter((n) => !(this.machine.states[n].inside & this.active));
  }

  get innermost() {
    return this.leaves.map((number) => this.machine.states[number].id);
  }

  /** Transitions to try for each active leaf, with the state that defers the event, or 0. */
  candidates(name) {
    let found = this.decisions.get(name);
    if (found) return found;
    found = [];
    for (const leaf of this.leaves) {
      const way = [];
      let holder = 0;
      for (const number of [leaf, ...this.machine.ancestors(leaf)]) {
        const state = this.machine.states[number];
        way.push(...state.edges.filter((edge) =>
          name && edge.events.length ? matches(edge.events, name) : !name && !edge.events.length));
        if (name && matches(state.deferred, name)) {
          holder = number;
          break;
        }
      }
      const sure = way.findIndex((edge) => !edge.test);
      if (sure >= 0) found.push([way.slice(0, sure + 1), 0]);
      else if (way.length || holder) found.push([way, holder]);
    }
    this.decisions.set(name, found);
    return found;
  }

  choose(instance, event, name) {
    let enabled = [];
    const refused = new Set();
    let deferring = 0n;
    for (const [way, holder] of this.candidates(name)) {
      let found = false;
      for (const edge of way) {
        found = enabled.includes(edge);
        if (!found && !refused.has(edge)) {
          found = !edge.test || instance.holds(edge.test, event);
          if (found) enabled.push(edge);
          else refused.add(edge);
        }
        if (found) break;
      }
      if (!found && holder) deferring |= bit(holder);
    }
    if (deferring) {
      enabled = enabled.filter((edge) => !(this.machine.states[edge.source].inside & deferring));
    }
    return [enabled, deferring !== 0n && !enabled.length];
  }

  step(enabled) {
    const key = enabled.map((edge) => edge.number).join();
    let found = this.steps.get(key);
    if (!found) this.steps.set(key, found = new Microstep(this).take(enabled));
    return found;
  }

  end() {
    const step = new Microstep(this);
    return { program: step.exits(this.active), target: Configuration.at(this.machine, 0n, this.histories), starts: [], final: 0 };
  }
}

/** Compute a microstep: its operations, each with the states that are active then. */
class Microstep {
  constructor({ machine, active, histories }) {
    Object.assign(this, { machine, active, states: machine.states, entered: 0n });
    this.held = new Map(machine.histories.map((number, at) => [number, histories[at]]));
  }

  take(enabled) {
    const edges = this.withoutConflicts(enabled);
    const left = edges.reduce((found, edge) => found | this.exitSet(edge), 0n);
    this.record(left);
    for (const edge of edges) {
      for (const target of edge.targets) this.addDescendants(target);
      const domain = this.domain(edge);
      for (const target of this.effective(edge)) this.addAncestors(target, domain);
    }
    const program = this.exits(left);
    let active = this.active & ~left;
    for (const edge of edges) {
      if (edge.source || edge.events.length) {
        program.push([active, (instance) => instance.notify("taken", edge)]);
      }
      if (edge.run) program.push([active, edge.run]);
    }
    const starts = [];
    let final = 0;
    for (const number of members(this.entered)) {
      const state = this.states[number];
      active |= bit(number);
      for (const each of this.entries(state)) program.push([active, each]);
      if (state.activity) starts.push(number);
      if (state.kind === "final") {
        if (!state.parent) final = number;
        for (const each of this.done(state, active)) program.push([active, each]);
      }
    }
    return { program, starts, final, target: Configuration.at(this.machine, active, [...this.held.values()]) };
  }

  withoutConflicts(enabled) {
    let kept = [];
    for (const edge of enabled) {
      const leaves = this.exitSet(edge);
      const rivals = kept.filter((other) => this.exitSet(other) & leaves);
      if (rivals.every((other) => this.states[other.source].inside & bit(edge.source))) {
        kept = kept.filter((other) => !rivals.includes(other));
        kept.push(edge);
      }
    }
    return kept;
  }

  exitSet(edge) {
    return edge.targets.length ? this.active & this.states[this.domain(edge)].inside : 0n;
  }

  /** The state that a transition does not exit. */
  domain(edge) {
    const targets = this.effective(edge);
    const source = this.states[edge.source];
    const around = this.machine.around(edge.source);
    if (!edge.source || (edge.internal && source.kind === "state" && source.children.length)) {
      around.unshift(edge.source);
    }
    return around.find((number) => this.states[number].kind !== "parallel"
      && targets.every((target) => this.states[number].inside & bit(target))) ?? 0;
  }

  effective(edge) {
    return edge.targets.flatMap((target) => {
      if (!this.held.has(target)) return [target];
      const held = this.held.get(target);
      return held ? members(held) : this.effective(this.states[target].first);
    });
  }

  addDescendants(number) {
    const state = this.states[number];
    if (this.held.has(number)) {
      const held = this.held.get(number);
      this.addAll(held ? members(held) : state.first.targets, state.parent);
      return;
    }
    this.entered |= bit(number);
    if (state.kind === "parallel") this.addRegions(state);
    else if (state.children.length) this.addAll(state.first.targets, number);
  }

  addAll(targets, around) {
    for (const target of targets) this.addDescendants(target);
    for (const target of targets) this.addAncestors(target, around);
  }

  addAncestors(number, around) {
    for (const ancestor of this.machine.ancestors(number)) {
      if (ancestor === around) return;
      this.entered |= bit(ancestor);
      if (this.states[ancestor].kind === "parallel") this.addRegions(this.states[ancestor]);
    }
  }

  addRegions(state) {
    for (const child of state.children) {
      if (!(this.entered & (this.states[child].inside | bit(child)))) this.addDescendants(child);
    }
  }

  exits(left) {
    const program = [];
    let active = this.active;
    for (const number of members(left).reverse()) {
      const state = this.states[number];
      for (const each of state.exit) program.push([active, each]);
      if (state.activity) program.push([active, (instance) => instance.stopActivity(number)]);
      active &= ~bit(number);
      program.push([active, (instance) => instance.notify("exited", state)]);
    }
    return program;
  }

  entries(state) {
    const program = [(instance) => instance.notify("entered", state)];
    if (state.timed) program.push((instance) => instance.entries.set(state.id, instance.world.time));
    program.push(...state.entry);
    return program;
  }

  /** Operations of a final state that is entered. */
  done(state, active) {
    if (!state.parent) return [];
    const raising = (id) => (instance) => instance.raise(eventOf(`done.state.${id}`));
    const parent = this.states[state.parent];
    const around = this.states[parent.parent];
    const found = [raising(parent.id)];
    if (around.kind === "parallel" && this.isFinal(around, active)) found.push(raising(around.id));
    return found;
  }

  isFinal(state, active) {
    const children = state.children.map((number) => this.states[number]);
    if (state.kind === "parallel") return children.every((child) => this.isFinal(child, active));
    return children.some((child) => child.kind === "final" && active & bit(child.number));
  }

  /** Record the active states in the histories of the exited states. */
  record(left) {
    for (const history of this.held.keys()) {
      const { parent, kind } = this.states[history];
      if (!(left & bit(parent))) continue;
      const inside = members(this.states[parent].inside & this.active);
      const found = inside.filter((n) => kind === "history" ? this.states[n].parent === parent
        : !(this.states[n].inside & this.active));
      this.held.set(history, found.reduce((set, n) => set | bit(n), 0n));
    }
  }
}

// ---- instances

/** A run of the activity of a state: `over` for the machine, `ended` when its server is free. */
export class Run {
  constructor(instance, state, activity) {
    Object.assign(this, { instance, state, activity, goal: null, over: false, ended: false });
  }

  end(outcome, result = null) {
    if (this.ended) return;
    this.ended = true;
    if (this.over) this.instance.servers.stopped(this);
    else this.instance.receive(eventOf(this.activity.events[outcome], result, this));
  }
}

/** The servers of a robot: a run waits while another one is stopping on its server. */
export class Servers {
  constructor() {
    this.stopping = [];
    this.waiting = [];
  }

  start(run) {
    if (this.stopping.some((each) => each.activity.server === run.activity.server)) this.waiting.push(run);
    else run.instance.world.start(run);
  }

  cancel(run) {
    if (this.waiting.includes(run)) this.waiting = this.waiting.filter((each) => each !== run);
    else {
      this.stopping.push(run);
      run.instance.world.cancel(run);
    }
  }

  stopped(run) {
    this.stopping = this.stopping.filter((each) => each !== run);
    const waiting = this.waiting;
    this.waiting = [];
    for (const each of waiting) this.start(each);
  }
}

/** A machine that runs in a world; `receive` processes an event to completion. */
export class Instance {
  constructor(machine, world, data, observer = null, servers = new Servers()) {
    Object.assign(this, { machine, world, data, observer, servers, running: false, final: null });
    this.configuration = Configuration.at(machine, 0n, machine.histories.map(() => 0n));
    Object.assign(this, { busy: false, during: null, isDeferred: false, entries: new Map() });
    Object.assign(this, { external: [], internal: [], deferred: [], pending: [], timers: [], runs: new Map() });
  }

  start() {
    this.running = true;
    this.alone(() => {
      const event = eventOf("");
      this.take(this.configuration.step([this.machine.states[0].first]), event);
      this.settle(event);
    });
  }

  receive(event) {
    if (this.busy) this.external.push(event);
    else if (this.running) this.alone(() => this.process(event));
  }

  /** Do something, and then process the events that have come meanwhile. */
  alone(action) {
    this.busy = true;
    try {
      action();
      for (let events = 1; this.external.length; events++) {
        const event = this.external.shift();
        if (events > this.machine.limit) this.giveUp();
        if (this.running) this.process(event);
      }
    } finally {
      this.busy = false;
      this.during = null;
    }
  }

  // ---- called by guards and effects

  isActive(state) {
    return ((this.during ?? this.configuration.active) & bit(this.machine.numbers.get(state))) !== 0n;
  }

  elapsed(state) {
    return this.world.time - this.entries.get(state);
  }

  raise(event) {
    this.internal.push(event);
  }

  emitAfter(event, delay) {
    this.notify("scheduled", event, delay > 0n ? delay : 0n);
    this.begin(`send.${event.name}`, delay, event);
  }

  /** Let an event come after a delay; one with a message sends it to others then. */
  begin(name, delay, message = null) {
    const timer = { message, over: false, alarm: null };
    timer.event = eventOf(name, null, timer);
    this.timers.push(timer);
    if (delay > 0n) timer.alarm = this.world.schedule(delay, () => timer.over || this.receive(timer.event), timer);
    else this.receive(timer.event);
  }

  cancel(name) {
    for (const timer of this.timers.filter((each) => each.event.name === name)) {
      this.unschedule(timer);
      if (timer.message) this.notify("withdrawn", timer.message);
    }
  }

  fail(error) {
    this.world.failed(this, error);
    this.raise(eventOf("error.execution", error.message));
  }

  emit(event) {
    this.notify("sent", event);
    this.world.send(this, event);
  }

  notify(call, ...what) {
    this.observer?.[call]?.(this, ...what);
  }

  stopActivity(state) {
    this.pending = this.pending.filter((each) => each !== state);
    const run = this.runs.get(state);
    this.runs.delete(state);
    if (!run) return;
    run.over = true;
    if (run.ended) return;
    this.notify("cancelled", run);
    this.servers.cancel(run);
  }

  // ---- the algorithm

  process(event) {
    if (event.origin && !this.accepts(event)) return;
    this.notify("received", event);
    if (event.origin?.message) {
      this.attempt(() => this.emit(event.origin.message));
      if (this.internal.length) this.settle(event);
      return;
    }
    const before = this.configuration;
    const step = this.select(event.name, event);
    if (!step && this.isDeferred) this.defer(event);
    this.finish(step, event);
    if (this.deferred.length && this.configuration !== before) this.recall();
  }

  finish(step, event) {
    if (step) this.take(step, event);
    else if (!this.isDeferred) this.notify("ignored", event);
    this.settle(event);
  }

  defer(event) {
    if (this.deferred.length >= this.machine.most) this.notify("dropped", this.deferred.shift());
    this.deferred.push(event);
    this.notify("deferred", event);
  }

  /** Process the events that are no longer deferred; begin again after each change. */
  recall() {
    let number = 0;
    while (this.running && number < this.deferred.length) {
      const [before, event] = [this.configuration, this.deferred[number]];
      const step = this.select(event.name, event);
      if (!step && this.isDeferred) {
        number++;
        if (this.internal.length) this.settle(event);
      } else {
        this.deferred.splice(number, 1);
        this.notify("recalled", event);
        this.notify("received", event);
        this.finish(step, event);
      }
      if (this.configuration !== before) number = 0;
    }
  }

  settle(event) {
    for (let steps = 1; this.running; steps++) {
      if (steps > this.machine.limit) this.giveUp();
      let step = this.configuration.restless ? this.select("", event) : null;
      if (!step) {
        if (this.internal.length) {
          event = this.internal.shift();
          this.notify("received", event);
          step = this.select(event.name, event);
        } else if (this.pending.length) this.startActivities();
        else if (this.running) return;
      }
      if (step) this.take(step, event);
    }
    this.take(this.configuration.end(), event);
    this.forget();
  }

  select(name, event) {
    const [enabled, isDeferred] = this.configuration.choose(this, event, name);
    this.isDeferred = isDeferred;
    return enabled.length ? this.configuration.step(enabled) : null;
  }

  holds(guard, event) {
    let held = false;
    this.attempt(() => { held = truth(guard(this, event)); });
    return held;
  }

  /** Do what may fail; return true if it did not. */
  attempt(action) {
    try {
      action();
      return true;
    } catch (error) {
      if (!(error instanceof Failure)) throw error;
      this.fail(error);
      return false;
    }
  }

  take(step, event) {
    for (const [active, operation] of step.program) {
      this.during = active;
      this.attempt(() => operation(this, event));
    }
    this.during = null;
    this.configuration = step.target;
    this.pending.push(...step.starts);
    if (step.final) {
      this.final = this.machine.states[step.final].id;
      this.running = false;
    }
  }

  /** Return whether an event of this instance is still valid: its state is active. */
  accepts({ name, data, origin }) {
    if (origin.over) return false;
    origin.over = true;
    if (origin instanceof Run) {
      this.runs.delete(origin.state);
      const { finalize, events } = origin.activity;
      if (finalize && name === events.succeeded) this.attempt(() => finalize(this, eventOf(name, data, origin)));
    } else this.timers = this.timers.filter((each) => each !== origin);
    return true;
  }

  startActivities() {
    const pending = this.pending.sort((one, other) => one - other);
    this.pending = [];
    for (const state of pending) {
      const { activity } = this.machine.states[state];
      const run = new Run(this, state, activity);
      this.runs.set(state, run);
      const isMade = this.attempt(() => {
        run.goal = Object.create(null);
        for (const [name, value] of activity.goal ?? []) run.goal[name] = value(this, null);
      });
      if (!isMade) {
        run.end("aborted");
        continue;
      }
      this.notify("started", run);
      this.servers.start(run);
    }
  }

  unschedule(timer) {
    this.timers = this.timers.filter((each) => each !== timer);
    timer.over = true;
    if (timer.alarm) this.world.unschedule(timer.alarm);
  }

  forget() {
    for (const timer of this.timers) this.unschedule(timer);
    this.internal = [];
    this.external = [];
    this.deferred = [];
    this.pending = [];
  }

  /** End a machine in an endless loop, without the exit effects. */
  giveUp() {
    this.running = false;
    for (const state of [...this.runs.keys()]) this.stopActivity(state);
    this.forget();
    throw new LoopError(`machine \`${this.machine.name}\` does not come to rest`);
  }
}
