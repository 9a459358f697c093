// Runs machines of the page step by step, and says what they did: one line of JSON a machine.
import { readFileSync } from "node:fs";
import { Clock } from "./engine_clock.js";
import { Instance, Machine, NO_ENVELOPE, eventOf } from "./engine.js";
import { decoded, encoded } from "./engine_values.js";

class World {
  constructor() {
    Object.assign(this, { clock: new Clock(), going: [], asked: [], failures: 0 });
  }
  get time() { return this.clock.now; }
  schedule(delay, action) { return this.clock.schedule(delay, action); }
  unschedule(alarm) { this.clock.unschedule(alarm); }
  start(run) {
    this.going.push(run);
    this.asked.push(["start", run.activity.name, encoded(run.goal)]);
  }
  cancel(run) {
    this.going = this.going.filter((each) => each !== run);
    this.asked.push(["cancel", run.activity.name]);
    run.end("preempted");
  }
  send(instance, event) {
    this.asked.push(["send", event.name, encoded(event.data), event.envelope.to]);
  }
  failed() { this.failures++; }
  present(instance, role) { return BigInt(role === null || role === instance.data.self.role); }
}

function take(world, instance, step) {
  if (step.time) world.clock.step();
  else if (step.run) {
    const [state, outcome] = step.run;
    const run = world.going.find((each) => each.instance.machine.states[each.state].id === state);
    world.going = world.going.filter((each) => each !== run);
    run.end(outcome, decoded(step.data));
  } else {
    const envelope = { ...NO_ENVELOPE, sender: step.sender, sent: BigInt(step.sent) };
    instance.receive(eventOf(step.event, decoded(step.data), null, envelope));
  }
}

const CALLS = ["received", "ignored", "deferred", "dropped", "recalled", "exited", "taken", "entered",
  "started", "cancelled", "sent", "scheduled", "withdrawn"];

function observer(calls) {
  const found = {};
  for (const call of CALLS) {
    found[call] = (instance, what, delay) =>
      calls.push([call, what.called ?? what.id ?? what.name ?? what.activity.name, ...(delay === undefined ? [] : [String(delay)])]);
  }
  return found;
}

function situation(world, instance, calls) {
  const asked = world.asked.splice(0);
  return {
    active: instance.machine.states.filter((each) => (instance.configuration.active >> BigInt(each.number)) & 1n)
      .map((each) => each.id),
    histories: instance.configuration.histories.map(String),
    final: instance.final,
    data: encoded(instance.data),
    timers: instance.timers.map((each) => [each.event.name, String(each.alarm?.due ?? 0)]),
    deferred: instance.deferred.map((each) => each.name),
    runs: world.going.map((run) => run.state),
    now: String(world.time),
    failures: world.failures,
    asked,
    calls: calls.splice(0),
  };
}

function run({ machine, data, steps }) {
  const [world, calls, found] = [new World(), [], []];
  try {
    const instance = new Instance(machine, world, decoded(data), observer(calls));
    instance.start();
    found.push(situation(world, instance, calls));
    for (const step of steps) {
      take(world, instance, step);
      found.push(situation(world, instance, calls));
    }
  } catch (error) {
    if (error.constructor.name !== "LoopError") throw error;
    found.push("loop");
  }
  return found;
}

for (const line of readFileSync(process.argv[2], "utf8").split("\n").filter(Boolean)) {
  const { table, scripts } = JSON.parse(line);
  const machine = new Machine(table);
  process.stdout.write(`${JSON.stringify(scripts.map((each) => run({ machine, ...each })))}\n`);
}
