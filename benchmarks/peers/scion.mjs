// Time SCION: node scion.mjs FILE, a JSON list of [document, event names, number of events]. Prints
// a JSON list of events per second; active states are read after each event.
import { readFileSync } from "node:fs";
import scion from "@scion-scxml/scxml";

function started(text) {
  return new Promise((resolve, reject) => {
    scion.documentStringToModel("bench.scxml", text, (error, model) => {
      if (error) return reject(error);
      model.prepare((fault, made) => {
        if (fault) return reject(fault);
        const machine = new scion.core.Statechart(made);
        machine.start();
        resolve(machine);
      }, {});
    }, {});
  });
}

function send(machine, names, rounds) {
  for (let round = 0; round < rounds; round++) {
    for (const name of names) {
      machine.gen({ name });
      machine.getConfiguration();
    }
  }
}

const speeds = [];
for (const [text, names, count] of JSON.parse(readFileSync(process.argv[2], "utf8"))) {
  const machine = await started(text);
  const rounds = Math.floor(count / names.length);
  send(machine, names, rounds / 5); // warm
  const start = process.cpuUsage();
  send(machine, names, rounds);
  const { user, system } = process.cpuUsage(start);
  speeds.push((rounds * names.length) / ((user + system) / 1e6));
}
console.log(JSON.stringify(speeds));
