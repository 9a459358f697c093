"""Diagram of a state machine."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence

from swarmdsl.base.source import Span
from swarmdsl.codegen.diagram.graph import Diagram, Edge, Node, NodeKind
from swarmdsl.codegen.diagram.labels import (
    behaviour_lines,
    internal_transitions,
    param_line,
    transition_label,
    value_lines,
    variable_line,
)
from swarmdsl.codegen.diagram.local_variables import local_names, renamed, without_first_values
from swarmdsl.codegen.swarm_printer.reuse import Reuse, Use, find_reuse
from swarmdsl.ir import State, StateKind, StateMachine, Variable

_KINDS: dict[StateKind, NodeKind] = {
    StateKind.SIMPLE: "state",
    StateKind.COMPOSITE: "composite",
    StateKind.PARALLEL: "parallel",
    StateKind.REGION: "region",
    StateKind.FINAL: "final",
    StateKind.CHOICE: "choice",
    StateKind.HISTORY: "history",
}


def statechart(machine: StateMachine, machines: Mapping[str, StateMachine]) -> Diagram:
    """Return the diagram; a reused machine is one state that links to its own diagram.

    `machines` are those of the system by name.
    """
    reuse = find_reuse(machine, machines) or Reuse(machine.variables, {})
    local = [each for each in reuse.variables if each.owner]
    names = local_names(machine.variables)
    if names:
        machine, reuse = renamed(machine, names), renamed(reuse, names)
    nodes = tuple(_node(state, reuse.uses, local) for state in machine.states)
    shown = {node.id for top in nodes for node in top.walk()}
    places = {each.origin for each in local}
    own = (each for each in reuse.variables if each.origin is None or each.origin not in places)
    data = (*map(param_line, machine.params), *map(variable_line, own))
    frame = Node(
        "",
        "frame",
        machine.name,
        "endless statemachine" if machine.endless else "statemachine",
        (data,) if data else (),
        (_initial("", machine.origin), *nodes),
        doc=machine.doc,
        origin=machine.origin,
    )
    edges = (
        _entry("", machine.initial, machine),
        *(edge for state in machine.states for edge in _edges(state, shown)),
    )
    return Diagram("statechart", machine.name, frame, edges)


def _node(state: State, uses: Mapping[str, Use], local: Sequence[Variable]) -> Node:
    use = uses.get(state.id)
    entry = without_first_values(state.entry if use is None else use.entry, local)
    lines = (*_declared(state, local), *behaviour_lines(state, entry))
    compartments: tuple[tuple[str, ...], ...] = (lines,) if lines else ()
    kind, name, nodes = _KINDS[state.kind], state.name, state.states
    if use is not None:
        kind, name, nodes = "submachine", f"{state.name} : {state.submachine}", ()
        if use.bindings:
            compartments = (value_lines(use.bindings), *compartments)
    elif state.submachine is not None:
        name = f"{state.name} : {state.submachine}"
    elif kind == "history" and state.deep:
        kind = "deep history"
    inside = tuple(_node(child, uses, local) for child in nodes)
    if inside and state.initial is not None:
        inside = (_initial(state.id, state.origin), *inside)
    return Node(
        state.id,
        kind,
        name,
        compartments=compartments,
        internal=tuple(id_ for id_, _ in internal_transitions(state)),
        nodes=inside,
        doc=state.doc,
        origin=state.origin,
    )


def _declared(state: State, local: Iterable[Variable]) -> Iterator[str]:
    """Yield the variables that a state declares; a parallel state shows those of its regions."""
    inside = {each.id: f"{each.name}." for each in state.states if each.kind is StateKind.REGION}
    for each in local:
        if each.owner == state.id and state.kind is not StateKind.REGION:
            yield variable_line(each)
        elif each.owner in inside:
            yield variable_line(each, inside[each.owner])


def _initial(owner: str, origin: Span | None) -> Node:
    return Node(f"{owner}#initial", "initial", "", origin=origin)


def _entry(owner: str, target: str, of: State | StateMachine) -> Edge:
    source = f"{owner}#initial"
    return Edge(f"{source}->", "initial", source, target, origin=of.origin)


def _edges(state: State, shown: set[str]) -> Iterator[Edge]:
    """Yield the transitions of a state and of those inside it that are drawn."""
    if state.id not in shown:
        return
    for number, each in enumerate(state.transitions):
        if each.target is None:
            continue
        label = transition_label(each, state)
        if state.kind is StateKind.CHOICE and each.guard is None:
            label = ("[else]", *label)
        yield Edge(
            f"{state.id}->{number}",
            "transition",
            state.id,
            each.target,
            label,
            doc=each.doc,
            origin=each.origin,
        )
    if state.initial is not None and f"{state.id}#initial" in shown:
        yield _entry(state.id, state.initial, state)
    for child in state.states:
        yield from _edges(child, shown)
