// The view beside the text that shows the diagrams of a model, as the text is now.

import { randomBytes } from "node:crypto";

import * as vscode from "vscode";

import type { Lights, Moved } from "./lights.ts";
import type { Server } from "./server.ts";
import type { Subject } from "./subject.ts";

/** What the page says. */
interface Said {
  readonly want?: { readonly id: string; readonly folded: readonly string[] };
  readonly reveal?: string;
  readonly save?: { readonly name: string; readonly base64: string };
}

// Diagrams by what they are of, as swarmc calls them.
const DIAGRAMS = { swarm: "composition", member: "internal", machine: "statechart" } as const;
const PAUSE = 150;

/** One view for all models: it follows the file in front. */
export class Preview implements vscode.Disposable {
  private panel: vscode.WebviewPanel | undefined;
  private file: vscode.Uri | undefined;
  private first: string | undefined; // what is shown when the page begins
  private wanted: Said["want"];
  private lights: Lights | undefined;
  private begins = false;
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
      vscode.window.onDidChangeTextEditorSelection(({ textEditor }) => this.point(textEditor)),
      // Also where a file was changed that is not shown, or not even open.
      vscode.languages.onDidChangeDiagnostics(
        ({ uris }) => uris.some(({ path }) => path.endsWith(".swarm")) && this.later(),
      ),
      server.onFiles(() => this.later()),
      server.onChange(({ kind }) => kind === "running" && this.later()),
    );
  }

  /** Show the diagrams of a file's model, beside it; that of `subject` if one is named. */
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
    this.begins = true;
    panel.onDidDispose(() => {
      this.panel = undefined;
      this.lights?.dispose();
      this.lights = undefined;
    });
    panel.webview.onDidReceiveMessage((said: Said) => this.hear(said));
    panel.webview.html = await this.html();
  }

  /** Light up where members are by what `begin` begins, in place of what did so before. */
  light<Kind extends Lights>(begin: (moved: Moved) => Kind): Kind {
    this.lights?.dispose();
    const lights = begin((active, steps) => void this.panel?.webview.postMessage({ active, ...steps }));
    this.lights = lights;
    return lights;
  }

  dispose(): void {
    clearTimeout(this.timer);
    this.lights?.dispose();
    this.listening.dispose();
    this.panel?.dispose();
  }

  /** The page with all that it needs: nothing is fetched when it is shown. */
  private async html(): Promise<string> {
    const page = ["server", "swarmdsl", "preview", "page"];
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

  private async hear({ want, reveal, save }: Said): Promise<void> {
    if (want !== undefined) {
      // The page says at first what it showed before, if anything.
      const first = this.begins ? this.first : undefined;
      this.begins = false;
      if (first !== undefined && first !== want.id) {
        await this.panel?.webview.postMessage({ show: first });
        return;
      }
      this.wanted = want;
      await this.update();
      this.lights?.again();
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
    if (this.panel && document.languageId === "swarm" && document.uri.scheme === "file") {
      this.file = document.uri;
      this.later();
    }
  }

  // Keys come faster than pictures.
  private later(): void {
    clearTimeout(this.timer);
    this.timer = setTimeout(() => void this.update(), PAUSE);
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
      this.point(vscode.window.activeTextEditor);
    }
  }

  private point({ document, selection }: vscode.TextEditor): void {
    if (this.panel && document.languageId === "swarm") {
      const cursor = { file: document.uri.fsPath, line: selection.active.line + 1 };
      void this.panel.webview.postMessage({ cursor });
    }
  }
}
