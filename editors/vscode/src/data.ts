// TOML files for the language server: tests, scenarios and the project file.
//
// They belong to another language, of which other extensions know more: the server only finds
// mistakes in them, and takes no part in completion or formatting.

import * as vscode from "vscode";
import type { LanguageClient } from "vscode-languageclient/node";

import { withoutRepeated } from "./repeated.ts";

/** Tells a server about open TOML files, and shows what it finds unless another extension does. */
export class DataFiles implements vscode.Disposable {
  private client: LanguageClient | undefined;
  private readonly found = new Map<string, readonly vscode.Diagnostic[]>(); // of the server, by address
  private readonly listening: vscode.Disposable;

  constructor() {
    this.listening = vscode.Disposable.from(
      vscode.workspace.onDidOpenTextDocument((document) => this.opened(document)),
      vscode.workspace.onDidChangeTextDocument(({ document }) => this.changed(document)),
      vscode.workspace.onDidCloseTextDocument((document) => this.closed(document)),
      vscode.languages.onDidChangeDiagnostics(({ uris }) => uris.forEach((each) => this.review(each))),
    );
  }

  /** Tell a server that has started what is open; undefined if none runs. */
  follow(client: LanguageClient | undefined): void {
    this.client = client;
    this.found.clear();
    vscode.workspace.textDocuments.forEach((each) => this.opened(each));
  }

  /** Diagnostics of the server to show for a file. */
  shown(uri: vscode.Uri, found: vscode.Diagnostic[]): vscode.Diagnostic[] {
    if (!isData(uri)) {
      return found;
    }
    this.found.set(uri.toString(), found);
    return withoutRepeated(found, vscode.languages.getDiagnostics(uri));
  }

  dispose(): void {
    this.listening.dispose();
  }

  private opened(document: vscode.TextDocument): void {
    const { version, languageId } = document;
    this.tell("didOpen", document, { version, languageId, text: document.getText() });
  }

  private changed(document: vscode.TextDocument): void {
    this.tell("didChange", document, { version: document.version }, [{ text: document.getText() }]);
  }

  private closed(document: vscode.TextDocument): void {
    this.tell("didClose", document, {});
  }

  private tell(what: string, { uri }: vscode.TextDocument, about: object, contentChanges?: object[]): void {
    if (this.client && isData(uri)) {
      const textDocument = { uri: this.client.code2ProtocolConverter.asUri(uri), ...about };
      const parameters = { textDocument, ...(contentChanges && { contentChanges }) };
      void this.client.sendNotification(`textDocument/${what}`, parameters);
    }
  }

  /** Show again what another extension does not report any more, and the other way round. */
  private review(uri: vscode.Uri): void {
    const found = this.found.get(uri.toString());
    const shown = this.client?.diagnostics;
    if (found && shown) {
      const now = withoutRepeated(found, vscode.languages.getDiagnostics(uri));
      // Only a change, which this is told about too.
      if (now.length !== (shown.get(uri)?.length ?? 0)) {
        shown.set(uri, now);
      }
    }
  }
}

function isData(uri: vscode.Uri): boolean {
  return uri.scheme === "file" && uri.path.endsWith(".toml");
}
