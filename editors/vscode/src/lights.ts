// Where members are, as a preview shows it.

/** The innermost active states of members; null of those that are gone. */
export type Active = Record<string, readonly string[] | null>;
/** What members have just done: transitions that they have taken, states that they have entered. */
export interface Steps {
  readonly taken?: Record<string, readonly string[]>;
  readonly entered?: Record<string, readonly string[]>;
}
/** Is told who has moved, and how. */
export type Moved = (active: Active, steps: Steps) => void;

/** Tells of members until it is disposed: then nobody is anywhere any more. */
export interface Lights {
  /** Say again where all are. */
  again(): void;
  dispose(): void;
}
