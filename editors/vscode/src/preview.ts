// Preview panel with the diagrams of a model, updated as the user types.

import { randomBytes } from "node:crypto";

import * as vscode from "vscode";

import type { Highlights, Moved } from "./highlights.ts";
import type { Server } from "./server.ts";
import type { Subject } from "./subject.ts";

/** Messages of the page. */
interface PageMessage {
  readonly want?: { readonly id: string; readonly folded: readonly string[] };
  readonly reveal?: string;
  readonly save?: { readonly name: string; readonly base64: string };
}

// Diagram kinds of swarmc by kind of subject.
const DIAGRAMS = { swarm: "composition", member: "internal", machine: "statechart" } as const;
const DEBOUNCE = 150;

/** Single panel for all models; it follows the active file. */
export class Preview implements vscode.Disposable {
  private panel: vscode.WebviewPanel | undefined;
  private file: vscode.Uri | undefined;
  private first: string | undefined; // initial diagram of a new page
  private wanted: PageMessage["want"];
  private highlights: Highlights | undefined;
  private isNew = false;
  private timer: NodeJS.Timeout | undefined;
  private readonly extension: vscode.Uri;
  private readonly server: Server;
  private readonly listening: vscode.Disposable;

  constructor(extension: vscode.Uri, server: Server) {
    this.server = server;
    this.extension = extension;
    this.listening = vscode.Disposable.from(
      vscode.workspace.onDidChangeTextDocument(({ document }) => this.follow(document)),
      vscode.window.onDidChangeActiveTextEditor((each) => each && this.follow(each.document)),
      vscode.window.onDidChangeTextEditorSelection(({ textEditor }) => this.markCursor(textEditor)),
      // Catches changes of files that are not shown or not open.
      vscode.languages.onDidChangeDiagnostics(
        ({ uris }) => uris.some(({ path }) => path.endsWith(".swarm")) && this.scheduleUpdate(),
      ),
      server.onFiles(() => this.scheduleUpdate()),
      server.onChange(({ kind }) => kind === "running" && this.scheduleUpdate()),
    );
  }

  /** Show the diagrams of a file's model beside it, starting with that of `subject`. */
  async show(file: vscode.Uri, subject?: Subject): Promise<void> {
    this.file = file;
    const wanted = subject && `${subject.name}.${DIAGRAMS[subject.kind]}`;
    if (this.panel) {
      this.panel.reveal(undefined, true);
      await (wanted ? this.panel.webview.postMessage({ show: wanted }) : this.update());
      return;
    }
    this.first = wanted;
    const panel = vscode.window.createWebviewPanel(
      "swarmdsl.preview",
      "Swarm Preview",
      { viewColumn: vscode.ViewColumn.Beside, preserveFocus: true },
      { enableScripts: true, localResourceRoots: [], retainContextWhenHidden: true },
    );
    this.panel = panel;
    this.isNew = true;
    panel.onDidDispose(() => {
      this.panel = undefined;
      this.highlights?.dispose();
      this.highlights = undefined;
    });
    panel.webview.onDidReceiveMessage((message: PageMessage) => this.receive(message));
    panel.webview.html = await this.html();
  }

  /** Highlight active states from a new source, replacing the previous one. */
  highlight<Kind extends Highlights>(start: (moved: Moved) => Kind): Kind {
    this.highlights?.dispose();
    const highlights = start((active, steps) => void this.panel?.webview.postMessage({ active, ...steps }));
    this.highlights = highlights;
    return highlights;
  }

  dispose(): void {
    clearTimeout(this.timer);
    this.highlights?.dispose();
    this.listening.dispose();
    this.panel?.dispose();
  }

  /** The page with inlined resources: it fetches nothing. */
  private async html(): Promise<string> {
    const page = ["server", "swarmdsl", "ide", "preview", "page"];
    const [text, style, script] = await Promise.all([
      this.read(...page, "index.html"),
      this.read(...page, "preview.css"),
      this.read("dist", "preview.js"),
    ]);
    const nonce = randomBytes(16).toString("hex");
    const policy = [
      "default-src 'none'",
      `script-src 'nonce-${nonce}'`,
      "style-src 'unsafe-inline'",
      "img-src blob: data:",
    ].join("; ");
    return text
      .replace("<head>", `<head><meta http-equiv="Content-Security-Policy" content="${policy}">`)
      .replace(/<link rel="stylesheet".*?>/, () => `<style>${style}</style>`)
      .replace(/<script .*?>/, () => `<script nonce="${nonce}">${script}`);
  }

  private async read(...path: string[]): Promise<string> {
    const file = vscode.Uri.joinPath(this.extension, ...path);
    return new TextDecoder().decode(await vscode.workspace.fs.readFile(file));
  }

  private async receive({ want, reveal, save }: PageMessage): Promise<void> {
    if (want !== undefined) {
      // A restored page first requests the diagram that it showed before.
      const first = this.isNew ? this.first : undefined;
      this.isNew = false;
      if (first !== undefined && first !== want.id) {
        await this.panel?.webview.postMessage({ show: first });
        return;
      }
      this.wanted = want;
      await this.update();
      this.highlights?.resend();
    }
    const place = /^(.*):(\d+):(\d+)$/.exec(reveal ?? "");
    if (place?.[1] !== undefined) {
      const at = new vscode.Position(Number(place[2]) - 1, Number(place[3]) - 1);
      await vscode.window.showTextDocument(vscode.Uri.file(place[1]), {
        viewColumn: vscode.ViewColumn.One,
        selection: new vscode.Range(at, at),
      });
    }
    if (save && this.file) {
      const uri = await vscode.window.showSaveDialog({
        defaultUri: vscode.Uri.joinPath(this.file, "..", save.name),
      });
      if (uri) {
        await vscode.workspace.fs.writeFile(uri, Buffer.from(save.base64, "base64"));
      }
    }
  }

  private follow(document: vscode.TextDocument): void {
    if (this.panel && document.languageId === "swarm" && ["file", "untitled"].includes(document.uri.scheme)) {
      this.file = document.uri;
      this.scheduleUpdate();
    }
  }

  // Debounce updates while the user types.
  private scheduleUpdate(): void {
    clearTimeout(this.timer);
    this.timer = setTimeout(() => void this.update(), DEBOUNCE);
  }

  private async update(): Promise<void> {
    if (!this.panel || !this.file) {
      return;
    }
    const shown = await this.server.request("swarmdsl/pictures", {
      textDocument: { uri: this.file.toString() },
      ...this.wanted,
    });
    await this.panel?.webview.postMessage(shown ?? {});
    if (vscode.window.activeTextEditor) {
      this.markCursor(vscode.window.activeTextEditor);
    }
  }

  private markCursor({ document, selection }: vscode.TextEditor): void {
    if (this.panel && document.languageId === "swarm") {
      const cursor = { file: document.uri.fsPath, line: selection.active.line + 1 };
      void this.panel.webview.postMessage({ cursor });
    }
  }
}
