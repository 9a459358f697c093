"""Mermaid diagrams in the README of a package; GitHub and GitLab draw them."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence

from swarmdsl.base.records import dataclass
from swarmdsl.codegen.diagram.composition import composition
from swarmdsl.codegen.diagram.graph import Diagram
from swarmdsl.codegen.diagram.internal import internal
from swarmdsl.codegen.diagram.mermaid import mermaid
from swarmdsl.codegen.diagram.statechart import statechart
from swarmdsl.ir import State, StateMachine, System

# Default limits of Mermaid (`maxTextSize`, `maxEdges`).
_MOST_TEXT, _MOST_EDGES = 50_000, 500


@dataclass(frozen=True)
class Picture:
    """Diagram as a block of Markdown, with the name of its subject."""

    title: str
    block: str


def pictures(system: System, machines: Sequence[StateMachine]) -> tuple[Picture, ...]:
    """Return the swarms whose members run these machines, and the machines.

    Diagrams that are too large for Mermaid are left out.
    """
    return tuple(_drawn(system, machines))


def member_pictures(system: System, members: Sequence[str]) -> tuple[Picture, ...]:
    """Return the internal diagrams of some members.

    Diagrams that are too large for Mermaid are left out.
    """
    components = system.components_by_name
    shown = (member for member in system.members if member.name in members)
    return tuple(
        picture
        for member in shown
        for picture in _picture(f"Member `{member.name}`", internal(member, components))
    )


def _drawn(system: System, machines: Sequence[StateMachine]) -> Iterator[Picture]:
    names = {machine.name for machine in machines}
    running = {member.name for member in system.members if member.behavior in names}
    for swarm in system.swarms:
        if any(role.member in running for role in swarm.roles):
            yield from _picture(f"Swarm `{swarm.name}`", composition(swarm, system))
    known = system.machines_by_name
    for machine in machines:
        # Drawing takes much longer than counting.
        if _fewest_edges(machine.states) <= _MOST_EDGES:
            yield from _picture(f"State machine `{machine.name}`", statechart(machine, known))


def _fewest_edges(states: Iterable[State]) -> int:
    """Return a lower bound of the edges drawn, without reused machines."""
    return sum(
        sum(transition.target is not None for transition in state.transitions)
        + (_fewest_edges(state.states) if state.submachine is None else 0)
        for state in states
    )


def _picture(title: str, diagram: Diagram) -> Iterator[Picture]:
    text = mermaid(diagram) if len(diagram.edges) <= _MOST_EDGES else None
    if text is not None and len(text) <= _MOST_TEXT:
        # Mermaid's own text has no backquote: it would be an entity.
        yield Picture(title, f"```mermaid\n{text}```")
