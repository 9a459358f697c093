// Where members are, as a preview shows it.

/** The innermost active states of members; null of those that are gone. */
export type Active = Record<string, readonly string[] | null>;
/** Transitions that members have just taken. */
export type Taken = Record<string, readonly string[]>;
/** Is told who has moved, and how. */
export type Moved = (active: Active, taken: Taken) => void;

/** Tells of members until it is disposed: then nobody is anywhere any more. */
export interface Lights {
  /** Say again where all are. */
  again(): void;
  dispose(): void;
}
