// What of a model is shown or run: a declaration, as the language server names it.

export interface Subject {
  readonly kind: "swarm" | "member" | "machine";
  readonly name: string;
}
