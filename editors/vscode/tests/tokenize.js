// Reads .swarm texts from standard input, one JSON string per line, and answers each with its
// tokens as a JSON list of [line, first column, column after it, scopes]; lines and columns count
// from 0.
"use strict";

const fs = require("node:fs");
const path = require("node:path");
const readline = require("node:readline");
const oniguruma = require("vscode-oniguruma");
const textmate = require("vscode-textmate");

const GRAMMAR = path.join(__dirname, "..", "syntaxes", "swarm.tmLanguage.json");

async function loadGrammar() {
  await oniguruma.loadWASM(fs.readFileSync(require.resolve("vscode-oniguruma/release/onig.wasm")));
  const registry = new textmate.Registry({
    onigLib: Promise.resolve({
      createOnigScanner: (patterns) => new oniguruma.OnigScanner(patterns),
      createOnigString: (text) => new oniguruma.OnigString(text),
    }),
    loadGrammar: async () => textmate.parseRawGrammar(fs.readFileSync(GRAMMAR, "utf8"), GRAMMAR),
  });
  return registry.loadGrammar("source.swarm");
}

function tokenize(grammar, text) {
  let stack = textmate.INITIAL;
  return text.split("\n").flatMap((line, number) => {
    const result = grammar.tokenizeLine(line, stack);
    stack = result.ruleStack;
    return result.tokens.map((token) => [number, token.startIndex, token.endIndex, token.scopes]);
  });
}

loadGrammar().then(async (grammar) => {
  for await (const line of readline.createInterface({ input: process.stdin })) {
    process.stdout.write(`${JSON.stringify(tokenize(grammar, JSON.parse(line)))}\n`);
  }
});
