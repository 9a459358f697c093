// Evaluates expressions of the page: a line of JSON with trees gives a line with their values.
import { readFileSync } from "node:fs";
import { compiled, encoded, Failure } from "./engine_values.js";

function value(tree) {
  try {
    return encoded(compiled(tree)({}, null));
  } catch (error) {
    if (!(error instanceof Failure)) throw new Error(`${JSON.stringify(tree)}: ${error.stack}`);
    return "failure";
  }
}

for (const line of readFileSync(process.argv[2], "utf8").split("\n").filter(Boolean)) {
  // JSON has one zero.
  const told = JSON.stringify(JSON.parse(line).map(value), (_, each) => Object.is(each, -0) ? "-0" : each);
  process.stdout.write(`${told}\n`);
}
