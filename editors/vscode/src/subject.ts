// Declarations to show or run, as named by the language server.

export interface Subject {
  readonly kind: "swarm" | "member" | "machine";
  readonly name: string;
}

export interface Simulated {
  readonly kind: "swarm" | "machine" | "property";
  readonly name: string;
}

/** The whole before its parts, else in the order of the file. */
export function swarmsFirst(subjects: readonly Simulated[]): Simulated[] {
  const isPart = ({ kind }: Simulated): number => Number(kind !== "swarm");
  return [...subjects].sort((one, other) => isPart(one) - isPart(other));
}
