// Language server: finds it, starts it, and restarts it when another one is found.

import { homedir } from "node:os";
import { join } from "node:path";

import * as vscode from "vscode";
import { LanguageClient, State, TransportKind } from "vscode-languageclient/node";

import { DataFiles } from "./data.ts";
import { find, type Found, type Launch, type Places } from "./launch.ts";
import { interpreterIn, onPath, probe } from "./probe.ts";
import { selectedInterpreter } from "./python.ts";
import { showMissing } from "./missing.ts";

export type Status =
  | { readonly kind: "starting" | "stopped" }
  | { readonly kind: "running"; readonly launch: Launch; readonly version: string }
  | { readonly kind: "missing"; readonly why: string };

export class Server implements vscode.Disposable {
  /** The last status. */
  status: Status = { kind: "starting" };
  private readonly changed = new vscode.EventEmitter<Status>();
  readonly onChange = this.changed.event;
  private readonly filesChanged = new vscode.EventEmitter<void>();
  /** Fires when the client reports changes of files on disk. */
  readonly onFiles = this.filesChanged.event;
  private readonly data = new DataFiles();
  private client: LanguageClient | undefined;
  private launch: Launch | undefined;
  // Starts and stops run one at a time, in order.
  private queue: Promise<unknown> = Promise.resolve();

  private readonly extension: vscode.Uri;
  private readonly log: vscode.LogOutputChannel;

  constructor(extension: vscode.Uri, log: vscode.LogOutputChannel) {
    this.extension = extension;
    this.log = log;
  }

  /** Stop a running server, search again and start. */
  restart(): Promise<void> {
    return this.queued(async () => {
      await this.end();
      await this.start(await this.search());
    });
  }

  /** Restart if the search finds another server. */
  refresh(): Promise<void> {
    return this.queued(async () => {
      const found = await this.search();
      const launch = "launch" in found ? found.launch : undefined;
      if (this.client === undefined || JSON.stringify(launch) !== JSON.stringify(this.launch)) {
        await this.end();
        await this.start(found);
      }
    });
  }

  /** Launch of swarmc, or why there is none. */
  async found(): Promise<Found> {
    await this.queue;
    return this.launch ? { launch: this.launch } : this.search();
  }

  /** Launch of swarmc; shows an error and returns undefined if there is none. */
  async swarmc(): Promise<Launch | undefined> {
    const found = await this.found();
    if ("launch" in found) {
      return found.launch;
    }
    showMissing(found);
    return undefined;
  }

  /** Send a request that is not part of the protocol. */
  async request<Answer>(method: string, parameters: unknown): Promise<Answer | undefined> {
    await this.queue;
    return this.client?.sendRequest<Answer>(method, parameters);
  }

  dispose(): void {
    this.data.dispose();
    this.changed.dispose();
    this.filesChanged.dispose();
  }

  stop(): Promise<void> {
    return this.queued(() => this.end());
  }

  private queued(work: () => Promise<void>): Promise<void> {
    const done = this.queue.then(work).catch((error: unknown) => this.log.error(String(error)));
    this.queue = done;
    return done;
  }

  private async search(): Promise<Found> {
    return find(await places(this.extension), probe, (line) => this.log.info(line));
  }

  private async start(found: Found): Promise<void> {
    if (!("launch" in found)) {
      this.log.error(found.missing);
      this.tell({ kind: "missing", why: found.missing });
      showMissing(found);
      return;
    }
    const { launch } = found;
    this.launch = launch;
    this.log.info(`starting swarmc of ${launch.origin}: ${[launch.command, ...launch.args].join(" ")}`);
    this.tell({ kind: "starting" });
    const client = new LanguageClient(
      "swarmdsl",
      "Swarm",
      {
        command: launch.command,
        args: [...launch.args, "lsp"],
        transport: TransportKind.stdio,
        // Python imports modules from its working directory.
        options: { cwd: this.extension.fsPath },
      },
      {
        documentSelector: [
          { scheme: "file", language: "swarm" },
          { scheme: "untitled", language: "swarm" },
        ],
        // The same as in the problem matcher, so that each problem is shown once.
        diagnosticCollectionName: "swarmdsl",
        outputChannel: this.log,
        // Commands that the server may use in code lenses and refactorings.
        initializationOptions: {
          commands: [
            "swarmdsl.references",
            "swarmdsl.rename",
            "swarmdsl.preview",
            "swarmdsl.simulate",
            "swarmdsl.debug",
            "swarmdsl.verify",
            "swarmdsl.build",
            "swarmdsl.test",
          ],
        },
        middleware: {
          handleDiagnostics: (uri, found, next) => next(uri, this.data.shown(uri, found)),
          workspace: {
            didChangeWatchedFile: async (event, next) => {
              await next(event);
              this.filesChanged.fire();
            },
          },
        },
      },
    );
    client.onDidChangeState(({ newState }) => {
      if (client === this.client || newState === State.Running) {
        this.tell(
          newState === State.Running
            ? { kind: "running", launch, version: client.initializeResult?.serverInfo?.version ?? "" }
            : { kind: newState === State.Starting ? "starting" : "stopped" },
        );
      }
    });
    this.client = client;
    try {
      await client.start();
      this.data.follow(client);
    } catch (error) {
      this.log.error(String(error));
      const why = `The swarmc of ${launch.origin} did not start.`;
      this.tell({ kind: "missing", why });
      showMissing({ missing: why });
    }
  }

  private tell(status: Status): void {
    this.status = status;
    this.changed.fire(status);
  }

  private async end(): Promise<void> {
    const { client } = this;
    this.data.follow(undefined);
    this.client = undefined;
    this.launch = undefined;
    try {
      await client?.dispose();
    } catch (error) {
      this.log.warn(String(error)); // the server is gone already
    }
  }
}

async function places(extension: vscode.Uri): Promise<Places> {
  const folders = vscode.workspace.workspaceFolders ?? [];
  const settings = vscode.workspace.getConfiguration("swarmdsl.server");
  const [first] = folders;
  // Never run programs of an untrusted workspace.
  const trusted = vscode.workspace.isTrusted;
  const environments = trusted
    ? await Promise.all(folders.map((each) => interpreterIn(join(each.uri.fsPath, ".venv"))))
    : [];
  return {
    path: expanded(settings.get("path", ""), first),
    interpreter: expanded(settings.get("interpreter", ""), first),
    selected: trusted ? await selectedInterpreter(first?.uri) : undefined,
    environments: environments.filter((each) => each !== undefined),
    swarmc: await onPath("swarmc"),
    pythons: await onPath("python3", "python"),
    bundle: vscode.Uri.joinPath(extension, "server").fsPath,
  };
}

function expanded(path: string, folder: vscode.WorkspaceFolder | undefined): string {
  return path
    .trim()
    .replace(/^~(?=[\\/])/, () => homedir())
    .replaceAll("${workspaceFolder}", () => folder?.uri.fsPath ?? "");
}
