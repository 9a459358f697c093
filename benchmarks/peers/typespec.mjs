// Time TypeSpec: node typespec.mjs WARM_UP FILE. Prints the CPU seconds to compile and check a file
// without output.
import { compile, NodeHost } from "@typespec/compiler";

async function run(file) {
  const program = await compile(NodeHost, file, { noEmit: true, nostdlib: false });
  if (program.hasError()) throw new Error(program.diagnostics[0].message);
}

const [warmUp, file] = process.argv.slice(2);
for (let time = 0; time < 5; time++) await run(warmUp);
const start = process.cpuUsage();
await run(file);
const { user, system } = process.cpuUsage(start);
console.log((user + system) / 1e6);
