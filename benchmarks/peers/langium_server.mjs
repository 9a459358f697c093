// A language server by Langium for the language: node langium_server.mjs GRAMMAR --stdio
// It has what Langium brings for every language; names are not linked by the grammar.
import { readFileSync } from "node:fs";
import { createServicesForGrammar } from "langium/grammar";
import { startLanguageServer } from "langium/lsp";
import { NodeFileSystem } from "langium/node";
import { createConnection, ProposedFeatures } from "vscode-languageserver/node";

// Chevrotain asks it of Node 21 or later when a parser is made; parsing itself does not.
Object.groupBy ??= (items, keyOf) => {
  const groups = {};
  for (const item of items) (groups[keyOf(item)] ??= []).push(item);
  return groups;
};

const connection = createConnection(ProposedFeatures.all);
const { shared } = await createServicesForGrammar({
  grammar: readFileSync(process.argv[2], "utf8"),
  languageMetaData: {
    caseInsensitive: false,
    fileExtensions: [".swarm"],
    languageId: "swarm",
    mode: "production",
  },
  sharedModule: {
    lsp: { Connection: () => connection },
    workspace: { FileSystemProvider: () => NodeFileSystem.fileSystemProvider() },
  },
});
startLanguageServer(shared);
