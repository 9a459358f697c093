// Lay out graphs with ELK: node elk.mjs FILE, a JSON list of graphs. Prints a JSON list of
// [laid-out graph, median of the CPU milliseconds of 5 layouts].
import { readFileSync } from "node:fs";
import ELK from "elkjs";

// Its source is one line, which Node would print.
process.on("uncaughtException", (error) => {
  console.log(error.message);
  process.exit(1);
});
const elk = new ELK();
const found = [];
for (const graph of JSON.parse(readFileSync(process.argv[2], "utf8"))) {
  let laidOut = await elk.layout(structuredClone(graph)); // warm
  const times = [];
  for (let round = 0; round < 5; round++) {
    const start = process.cpuUsage();
    laidOut = await elk.layout(structuredClone(graph));
    const { user, system } = process.cpuUsage(start);
    times.push((user + system) / 1e3);
  }
  times.sort((one, other) => one - other);
  found.push([laidOut, times[2]]);
}
console.log(JSON.stringify(found));
