// Declarations to show or run, as named by the language server.

export interface Subject {
  readonly kind: "swarm" | "member" | "machine";
  readonly name: string;
}

export interface Simulated {
  readonly kind: "swarm" | "machine" | "property";
  readonly name: string;
}
