// Langium language server for the language: node langium_server.mjs GRAMMAR --stdio. It has the
// generic features of Langium; the grammar links no names.
import { readFileSync } from "node:fs";
import { createServicesForGrammar } from "langium/grammar";
import { startLanguageServer } from "langium/lsp";
import { NodeFileSystem } from "langium/node";
import { createConnection, ProposedFeatures } from "vscode-languageserver/node";

// Chevrotain needs this function of Node 21 to create a parser, not to parse.
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
