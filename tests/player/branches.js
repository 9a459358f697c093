// Forks recordings and lets them go on as before: a line of JSON a recording gives one with the
// first difference of each fork, or null.
import { readFileSync } from "node:fs";
import { Branch } from "./engine_branch.js";

const KEYS = ["t", "member", "event", "configuration", "entered", "exited", "taken", "started", "cancelled",
  "sent", "ignored", "deferred", "recalled", "dropped", "scheduled", "withdrawn", "envelope", "to", "nobody", "variables", "data"];
const told = (line) => line && JSON.stringify(KEYS.map((key) => line[key] ?? null));

function differs({ world, lines, lost, end }, last) {
  const branch = new Branch(world, lines, last, lost);
  if (branch.difference) return ["replay", branch.difference];
  branch.pass(BigInt(end) - branch.time);
  const rest = lines.slice(last + 1);
  for (let at = 0; at < Math.max(rest.length, branch.rows.length); at++) {
    if (told(rest[at]) !== told(branch.rows[at])) return [last + 1 + at, rest[at], branch.rows[at]];
  }
  return null;
}

for (const line of readFileSync(process.argv[2], "utf8").split("\n").filter(Boolean)) {
  const given = JSON.parse(line);
  process.stdout.write(`${JSON.stringify(given.forks.map((last) => differs(given, last)))}\n`);
}
