// Behaviour tests in the language of `swarmc test`, and a branch as one.
import { decoded, plain } from "./engine_values.js";

const UNITS = [["s", 1e9], ["ms", 1e6], ["us", 1e3]];

const seconds = (length) => {
  const [unit, size] = UNITS.find(([, each]) => length % each === 0) ?? UNITS[2];
  return `${length / size} ${unit}`;
};

/** A value as TOML. */
export function toml(value) {
  if (Array.isArray(value)) return `[${value.map(toml).join(", ")}]`;
  if (value === null || typeof value !== "object") {
    return typeof value === "string" ? JSON.stringify(value).replace(/\x7f/g, "\\u007f") : String(value);
  }
  const inner = Object.keys(value).filter((key) => value[key] !== undefined && value[key] !== null)
    .map((key) => `${/^[\w-]+$/.test(key) ? key : JSON.stringify(key)} = ${toml(value[key])}`);
  return `{ ${inner.join(", ")} }`;
}

/** A test that is written step by step; times are nanoseconds. */
export class TestText {
  constructor() {
    Object.assign(this, { steps: [], now: 0 });
  }

  add(step) {
    this.steps.push(toml(step));
  }

  /** Let time pass until a time. */
  pass(time) {
    if (time > this.now) this.add({ pass: seconds(time - this.now) });
    this.now = Math.max(this.now, time);
  }

  /** The text of a file; the scenario is TOML. */
  file(comments, isSwarm, subject, scenario, name) {
    return [
      ...comments.map((each) => `# ${each}`),
      `${isSwarm ? "swarm" : "machine"} = ${toml(subject)}`,
      ...(scenario ? [`scenario = ${scenario}`] : []),
      "",
      "[[test]]",
      `name = ${toml(name)}`,
      "steps = [",
      ...this.steps.map((each) => `  ${each},`),
      "]",
      "",
    ].join("\n");
  }
}

/** A message as tests have it: times in words; null if nothing in it differs from a blank one. */
export function written(data, blank, times) {
  if (!data || JSON.stringify(data) === JSON.stringify(plain(decoded(blank)))) return null;
  const made = structuredClone(data);
  for (const path of times) {
    const held = path.slice(0, -1).reduce((found, name) => found?.[name], made);
    const name = path.at(-1);
    if (typeof held?.[name] === "number") held[name] = seconds(held[name]);
  }
  return made;
}

/** The text of a test that does what some lines tell, and expects the last states of a member. */
export function testText(branch, lines, name, member) {
  const { world, given } = branch;
  const test = new TestText();
  let way = []; // swarm events between two robots
  const inside = [];
  const gone = new Set();
  let before = null;
  const robotOf = (line) => world.names.get(line.member).robot;
  const isTimer = (line) => line.event !== null && !world.events.has(line.event) && /^(after|send)\./.test(line.event);
  // An input comes before the delays that end at the same time, if it did so.
  const reach = (line, at) => {
    const isEarly = lines.slice(at + 1, at + 100).some((each) => each.t === line.t && isTimer(each));
    test.pass(line.t * 1e6 - (isEarly ? 1000 : 0));
  };
  const drop = (each) => test.add({ drop: each.event, by: each.to, from: each.from });

  const arrive = (line, robot) => {
    const sent = Math.floor(line.envelope.sent / 1e6);
    const found = way.find((each) => each.event === line.event && each.to === robot.name
      && each.from === line.envelope.sender && each.t === sent);
    // What was sent before it on the same way was lost.
    const channel = (each) => [each.from, each.to, each.topic].join("\0");
    const taken = found ? way.slice(0, way.indexOf(found) + 1).filter((each) => channel(each) === channel(found)) : [];
    for (const each of taken) if (each !== found) drop(each);
    way = way.filter((each) => !taken.includes(each));
    test.add({ hear: line.event, by: robot.name, from: line.envelope.sender });
  };

  const end = (line) => {
    const { states } = world.names.get(line.member).machine;
    const { name: called, events } = states.find((each) => each.activity && Object.values(each.activity.events).includes(line.event)).activity;
    const outcome = Object.keys(events).find((each) => events[each] === line.event);
    const isFailed = outcome !== "succeeded";
    const isSuccess = !isFailed || line.data?.success === false;
    test.add({ end: called, of: robotOf(line).name, as: isSuccess ? null : outcome, result: isSuccess ? written(line.data, given.functions[called].blank, given.functions[called].times) : null });
  };

  lines.forEach((line, at) => {
    const robot = robotOf(line);
    const { event } = line;
    const isOne = before && before.member !== line.member && robotOf(before) === robot && before.event === event
      && before.t === line.t && before.envelope?.sent === line.envelope?.sent;
    before = line;
    const own = inside.findIndex((each) => each.robot === robot && each.event === event);
    if (event === world.lost) {
      if (!isOne) {
        reach(line, at);
        for (const each of way.filter((other) => other.to === robot.name)) drop(each);
        way = way.filter((each) => each.to !== robot.name);
        test.add({ lose: robot.name });
        gone.add(robot);
      }
    } else if (event !== null && !line.recalled && !(isOne && !event.startsWith("do."))) {
      const isDeclared = world.events.has(event) && !world.events.get(event).predefined;
      const isEnd = event.startsWith("do.") && !world.events.has(event);
      if (isDeclared && !line.envelope && own >= 0) inside.splice(own, 1);
      else if (isDeclared || isEnd) {
        reach(line, at);
        if (isEnd) end(line);
        else if (line.envelope && robot.name !== null) arrive(line, robot);
        else {
          const { blank, times } = world.events.get(event);
          test.add({ send: event, to: robot.name, data: written(line.data, blank, times), sender: line.envelope?.sender });
        }
      }
    }
    (line.sent ?? []).forEach((sent, n) => {
      const declared = world.events.get(sent);
      const to = line.to?.[n] ?? null;
      if (to === null) {
        for (const [heard, each] of world.events) {
          if (each.incoming === declared.topic && robot.members.some((m) => m.machine.listens(heard))) inside.push({ robot, event: heard });
        }
      }
      for (const other of declared.swarm ? world.robots : []) {
        const isMeant = to === null || [other.name, other.role].includes(to);
        if (other === robot || gone.has(other) || !isMeant || !other.members.some((each) => each.machine.listens(sent))) continue;
        way.push({ event: sent, from: robot.name, to: other.name, t: line.t, topic: declared.topic });
      }
    });
  });
  const last = Number(branch.time);
  test.pass(last);
  const { instance } = member;
  const states = instance.final ? [instance.final] : instance.configuration.innermost;
  test.add({ who: given.swarm ? member.name : null, in: states });
  for (const each of way) test.add({ hear: each.event, by: each.to, from: each.from });
  return test.file(
    ["Written by the player of `swarmc`. Put it into the folder of the model, and run `swarmc test`."],
    given.swarm,
    given.subject,
    given.scenario.replace("@end", seconds(Math.ceil(last / 1e9 + 60) * 1e9)),
    name,
  );
}
