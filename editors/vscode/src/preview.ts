// Preview panel with the diagrams of a model, updated as the user types.

import { randomBytes } from "node:crypto";
import { basename } from "node:path";

import * as vscode from "vscode";

import type { Highlights, Moved } from "./highlights.ts";
import type { Server, Status } from "./server.ts";
import type { Subject } from "./subject.ts";

/** Messages of the page. */
interface PageMessage {
  readonly want?: { readonly id: string; readonly folded: readonly string[] };
  readonly reveal?: string;
  readonly save?: { readonly name: string; readonly base64: string };
  readonly run?: string;
  readonly debug?: DebugCommand;
}

/** Wish of the user for a debug session: a request of the protocol, an event to send, or a robot to look at. */
export interface DebugCommand {
  readonly request?: string;
  readonly event?: string;
  readonly data?: object;
  readonly look?: number;
}

/** Element of a diagram, as named by the language server; the frame has an empty name. */
interface DiagramElement {
  readonly diagram: string;
  readonly element: string;
}

// Diagram kinds of swarmc by kind of subject.
const DIAGRAMS = { swarm: "composition", member: "internal", machine: "statechart" } as const;
const DEBOUNCE = 150;
// Remedies that the page offers as buttons.
const ACTIONS = [
  { title: "Select Interpreter", command: "swarmdsl.selectInterpreter" },
  { title: "Restart Server", command: "swarmdsl.restartServer" },
  { title: "Show Log", command: "swarmdsl.showLog" },
];

/** Single panel for all models; it follows the active file. */
export class Preview implements vscode.Disposable {
  private panel: vscode.WebviewPanel | undefined;
  private file: vscode.Uri | undefined;
  private first: string | undefined; // initial diagram of a new page
  private wanted: PageMessage["want"];
  private highlights: Highlights | undefined;
  private debugging: { readonly act: (command: DebugCommand) => void; readonly shown: object } | undefined;
  private isNew = false;
  private isMove = false; // the cursor has moved, not only the text around it
  private version: number | undefined; // of the text at the last position of the cursor
  private positions = 0; // number of positions of the cursor
  private timer: NodeJS.Timeout | undefined;
  private readonly extension: vscode.Uri;
  private readonly server: Server;
  private readonly listening: vscode.Disposable;

  constructor(extension: vscode.Uri, server: Server) {
    this.server = server;
    this.extension = extension;
    this.listening = vscode.Disposable.from(
      vscode.workspace.onDidChangeTextDocument(({ document }) => this.follow(document)),
      vscode.window.onDidChangeActiveTextEditor((each) => {
        if (each?.document.languageId === "swarm") {
          this.isMove = true;
          this.follow(each.document);
        }
      }),
      vscode.window.onDidChangeTextEditorSelection(({ textEditor }) => {
        this.isMove ||= textEditor.document.version === this.version;
        void this.markCursor(textEditor);
      }),
      // Catches changes of files that are not shown or not open.
      vscode.languages.onDidChangeDiagnostics(
        ({ uris }) => uris.some(({ path }) => path.endsWith(".swarm")) && this.scheduleUpdate(),
      ),
      server.onFiles(() => this.scheduleUpdate()),
      server.onChange(() => this.scheduleUpdate()),
    );
  }

  /** Show the diagrams of a file's model beside it, starting with that of `subject`. */
  async show(file: vscode.Uri, subject?: Subject): Promise<void> {
    this.file = file;
    const wanted = subject && `${subject.name}.${DIAGRAMS[subject.kind]}`;
    if (this.panel) {
      this.panel.reveal(undefined, true);
      this.isMove = !wanted;
      await (wanted ? this.panel.webview.postMessage({ show: wanted }) : this.update());
      return;
    }
    const editor = vscode.window.activeTextEditor;
    const atCursor = !wanted && editor ? await this.elements(editor) : [];
    this.first = wanted ?? atCursor[0]?.diagram;
    this.isMove = !wanted;
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

  /** Show the controls of a debug session, or none; `act` is called for what the user wants of it. */
  showDebug(shown: object | null, act: (command: DebugCommand) => void): void {
    this.debugging = shown ? { shown, act } : undefined;
    void this.panel?.webview.postMessage({ debug: shown });
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

  private async receive({ want, reveal, save, run, debug }: PageMessage): Promise<void> {
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
      if (this.debugging) {
        await this.panel?.webview.postMessage({ debug: this.debugging.shown });
      }
    }
    const place = /^(.*):(\d+):(\d+)$/.exec(reveal ?? "");
    if (place?.[1] !== undefined) {
      const at = new vscode.Position(Number(place[2]) - 1, Number(place[3]) - 1);
      await vscode.window.showTextDocument(vscode.Uri.file(place[1]), {
        viewColumn: vscode.ViewColumn.One,
        selection: new vscode.Range(at, at),
      });
    }
    if (ACTIONS.some(({ command }) => command === run)) {
      await vscode.commands.executeCommand(run ?? "");
    }
    if (debug) {
      this.debugging?.act(debug);
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
    const reason = unavailable(this.server.status);
    const shown = reason ?? (await this.pictures(this.file));
    await this.panel?.webview.postMessage(shown);
    if (!reason && vscode.window.activeTextEditor) {
      await this.markCursor(vscode.window.activeTextEditor);
    }
  }

  private async pictures(file: vscode.Uri): Promise<object> {
    const parameters = { textDocument: { uri: file.toString() }, ...this.wanted };
    try {
      const shown = await this.server.request<object | null>("swarmdsl/pictures", parameters);
      return shown ?? explained(`${basename(file.fsPath)} is not open.`, []);
    } catch (error) {
      return explained(`The language server has not drawn the model: ${String(error)}.`);
    }
  }

  private async markCursor(editor: vscode.TextEditor): Promise<void> {
    if (!this.panel || editor.document.languageId !== "swarm") {
      return;
    }
    this.version = editor.document.version;
    const number = ++this.positions;
    const cursor = await this.elements(editor);
    // The answer to an earlier position must not win.
    if (number === this.positions) {
      const moved = this.isMove;
      this.isMove = false;
      await this.panel?.webview.postMessage({ cursor, moved });
    }
  }

  /** Elements of diagrams at the cursor; none without a server, or with one that does not tell. */
  private async elements({ document, selection }: vscode.TextEditor): Promise<DiagramElement[]> {
    const { line, character } = selection.active;
    const parameters = { textDocument: { uri: document.uri.toString() }, position: { line, character } };
    try {
      return (await this.server.request<DiagramElement[]>("swarmdsl/diagramElements", parameters)) ?? [];
    } catch {
      return [];
    }
  }
}

/** Message of why there are no diagrams; undefined if a server runs. */
function unavailable(status: Status): object | undefined {
  switch (status.kind) {
    case "running":
      return undefined;
    case "starting":
      return explained("The language server is starting.", []);
    case "stopped":
      return explained("The diagrams come from the language server, which is not running.");
    case "missing":
      return explained(`The diagrams come from the language server, which is missing. ${status.why}`);
  }
}

function explained(text: string, actions = ACTIONS): object {
  return { unavailable: { text, actions } };
}
