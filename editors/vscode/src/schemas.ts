// Schemas of TOML files, for the extension Even Better TOML.

import * as vscode from "vscode";

const TOML = "tamasfe.even-better-toml";
const SETTING = "evenBetterToml.schema.associations";
// Schemas by name, each with the pattern of the addresses of its files.
const FILES: Readonly<Record<string, string>> = {
  "project.schema.json": "^.*/swarm\\.toml$",
  "tests.schema.json": "^.*\\.swarmtest\\.toml$",
  "scenario.schema.json": "^.*/scenarios/[^/]+\\.toml$",
};

/** Name the schemas in the settings of the user, since only absolute addresses work there. */
export async function useSchemas({ extensionUri, globalStorageUri }: vscode.ExtensionContext): Promise<void> {
  if (!vscode.extensions.getExtension(TOML)) {
    const show = "Show Extension";
    const text = "Even Better TOML completes and checks TOML files by schemas. It is not installed.";
    if (await vscode.window.showInformationMessage(text, show)) {
      await vscode.commands.executeCommand("workbench.extensions.search", `@id:${TOML}`);
    }
    return;
  }
  const kept = keptSchemas(globalStorageUri);
  await copySchemas(extensionUri, kept);
  const settings = vscode.workspace.getConfiguration();
  const added = Object.entries(FILES).map(([name, pattern]): [string, string] => [
    pattern,
    vscode.Uri.joinPath(kept, name).toString(),
  ]);
  const named = settings.inspect<Record<string, string>>(SETTING)?.globalValue;
  const all = { ...named, ...Object.fromEntries(added) };
  await settings.update(SETTING, all, vscode.ConfigurationTarget.Global);
  const reload = "Reload Window";
  const text = "Even Better TOML uses the schemas when the window is reloaded.";
  if (await vscode.window.showInformationMessage(text, reload)) {
    await vscode.commands.executeCommand("workbench.action.reloadWindow");
  }
}

/** Copy the schemas of this version, if those of another one are in use. */
export async function renewSchemas({ extensionUri, globalStorageUri }: vscode.ExtensionContext): Promise<void> {
  const kept = keptSchemas(globalStorageUri);
  try {
    await vscode.workspace.fs.stat(kept);
  } catch {
    return; // they are not in use
  }
  await copySchemas(extensionUri, kept);
}

/** Folder of the schemas: unlike that of the extension, it stays when the version changes. */
function keptSchemas(storage: vscode.Uri): vscode.Uri {
  return vscode.Uri.joinPath(storage, "schemas");
}

async function copySchemas(extension: vscode.Uri, kept: vscode.Uri): Promise<void> {
  for (const name of Object.keys(FILES)) {
    const [from, to] = [vscode.Uri.joinPath(extension, "schemas", name), vscode.Uri.joinPath(kept, name)];
    await vscode.workspace.fs.copy(from, to, { overwrite: true });
  }
}
