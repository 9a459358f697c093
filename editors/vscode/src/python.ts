// Interpreter selected in an installed Python extension.

import * as vscode from "vscode";

// The used parts of the APIs of these extensions.
interface Environments {
  getEnvironment(
    scope: vscode.Uri | undefined,
  ): Promise<{ execInfo?: { run?: { executable?: string } } } | undefined>;
  onDidChangeEnvironment?: vscode.Event<unknown>;
}
interface PythonExtension {
  environments: {
    getActiveEnvironmentPath(resource?: vscode.Uri): { path: string };
    resolveEnvironment(
      environment: unknown,
    ): Promise<{ executable: { uri?: vscode.Uri } } | undefined>;
    onDidChangeActiveEnvironmentPath: vscode.Event<unknown>;
  };
}

/** The selected interpreter; undefined without such an extension or a selection. */
export async function selectedInterpreter(
  folder: vscode.Uri | undefined,
): Promise<string | undefined> {
  try {
    const newer = await exported<Environments>("ms-python.vscode-python-envs");
    const found = await newer?.getEnvironment(folder);
    if (found?.execInfo?.run?.executable) {
      return found.execInfo.run.executable;
    }
    const older = (await exported<PythonExtension>("ms-python.python"))?.environments;
    const resolved = await older?.resolveEnvironment(older.getActiveEnvironmentPath(folder));
    return resolved?.executable.uri?.fsPath;
  } catch {
    return undefined; // errors of other extensions are not ours to report
  }
}

/** Listen for changes of the selected interpreter. */
export async function onSelect(listener: () => void): Promise<vscode.Disposable> {
  const newer = await exported<Environments>("ms-python.vscode-python-envs");
  const older = await exported<PythonExtension>("ms-python.python");
  const events = [
    newer?.onDidChangeEnvironment,
    older?.environments?.onDidChangeActiveEnvironmentPath,
  ];
  return vscode.Disposable.from(
    ...events.flatMap((event) => (event ? [event(() => listener())] : [])),
  );
}

async function exported<Api>(id: string): Promise<Api | undefined> {
  try {
    return await vscode.extensions.getExtension<Api>(id)?.activate();
  } catch {
    return undefined;
  }
}
