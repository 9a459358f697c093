// Forks a recording, lets something else happen, and writes the branch as a test.
import { readFileSync } from "node:fs";
import { Branch } from "./engine_branch.js";
import { eventOf } from "./engine.js";
import { copied } from "./engine_values.js";
import { testText } from "./test_text.js";

/** End the first function that runs, or send the first event that does something. */
function change(branch, member) {
  const { world } = branch;
  const [run] = world.runsOf(member);
  if (run) world.end(run, "aborted");
  const { instance } = member;
  const event = [...world.events.keys()].find((each) => instance.configuration.candidates(each).length);
  if (event && instance.running) world.deliver(member, eventOf(event, copied(world.events.get(event).message)));
}

function saved({ world, lines, lost }, last) {
  const branch = new Branch(world, lines, last, lost);
  const number = (last + 1) % branch.world.members.length;
  const member = branch.world.members[number];
  branch.pass(1500000000n);
  change(branch, member);
  branch.pass(7000000000n);
  change(branch, branch.world.members.at(-1));
  branch.pass(500000000n);
  const rows = [...lines.slice(0, last + 1), ...branch.rows];
  return testText(branch, rows, `after ${last}`, member);
}

for (const line of readFileSync(process.argv[2], "utf8").split("\n").filter(Boolean)) {
  const given = JSON.parse(line);
  process.stdout.write(`${JSON.stringify(given.forks.map((last) => saved(given, last)))}\n`);
}
