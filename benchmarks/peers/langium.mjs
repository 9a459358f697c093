// Time Langium's parser: node langium.mjs GRAMMAR WARM_UP FILE... Prints the CPU seconds for all
// files; the warm-up file is parsed first.
import { readFileSync } from "node:fs";
import { EmptyFileSystem } from "langium";
import { createServicesForGrammar } from "langium/grammar";

// Chevrotain needs this function of Node 21 to create a parser, not to parse.
Object.groupBy ??= (items, keyOf) => {
  const groups = {};
  for (const item of items) (groups[keyOf(item)] ??= []).push(item);
  return groups;
};

const [grammar, warmUp, ...files] = process.argv.slice(2);
const services = await createServicesForGrammar({
  grammar: readFileSync(grammar, "utf8"),
  module: EmptyFileSystem,
});
const parser = services.parser.LangiumParser;

function parse(text, name) {
  const { lexerErrors, parserErrors } = parser.parse(text);
  const wrong = [...lexerErrors, ...parserErrors][0];
  if (wrong) throw new Error(`${name}: ${wrong.message} ${wrong.token?.startLine ?? wrong.line}`);
}

const warm = readFileSync(warmUp, "utf8");
for (let run = 0; run < 5; run++) parse(warm, warmUp);
const texts = files.map((file) => readFileSync(file, "utf8"));
const start = process.cpuUsage();
texts.forEach((text, index) => parse(text, files[index]));
const { user, system } = process.cpuUsage(start);
console.log((user + system) / 1e6);
