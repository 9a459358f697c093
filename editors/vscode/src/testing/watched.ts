// Changes of files that may change the list of tests; paths are relative to the workspace.

const READ = /\.(swarm|toml|scxml|msg|srv|action)$/;

/** True if swarmc reads a file: a model, a project, a scenario, a test, or an interface. */
export function isRead(path: string): boolean {
  return READ.test(path);
}

/**
 * True if what is created or deleted may have such files: it is one, or a folder.
 *
 * Folders are told apart by their names alone. swarmc does not look into those that begin with a dot.
 */
export function mayHold(path: string): boolean {
  return isRead(path) || (/(^|\/)[^/.]+$/.test(path) && !isHidden(path));
}

/** True if a path is in a folder whose name begins with a dot. */
export function isHidden(path: string): boolean {
  return /(^|\/)\.[^/]*\//.test(path);
}
