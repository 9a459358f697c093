// Live states of members for a preview.

/** Innermost active states by member; null for members that ended. */
export type Active = Record<string, readonly string[] | null>;
/** Recent steps of members: transitions taken and states entered. */
export interface Steps {
  readonly taken?: Record<string, readonly string[]>;
  readonly entered?: Record<string, readonly string[]>;
}
/** Receives changes of members. */
export type Moved = (active: Active, steps: Steps) => void;

/** Reports members until it is disposed; then all of them are gone. */
export interface Highlights {
  /** Report all members again. */
  resend(): void;
  dispose(): void;
}
