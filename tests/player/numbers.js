// Draws random numbers of the page: a line of JSON with questions gives a line with what is drawn.
import { readFileSync } from "node:fs";
import { drawn, Stream } from "./engine_clock.js";

function answer([length, count, ...words]) {
  const stream = new Stream(...words);
  const numbers = Array.from({ length: count }, () => stream.random());
  return [numbers, String(drawn(length, stream))];
}

for (const line of readFileSync(process.argv[2], "utf8").split("\n").filter(Boolean)) {
  process.stdout.write(`${JSON.stringify(JSON.parse(line).map(answer))}\n`);
}
