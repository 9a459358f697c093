"""Diagrams of a model: its swarms, the insides of its members, and its state machines.

A model becomes a graph (`composition`, `internal`, `statechart`), which is written in one of
the formats. For SVG it is laid out first.
"""

from __future__ import annotations

from collections.abc import Collection, Iterator

from swarmdsl.diagram.composition import composition
from swarmdsl.diagram.dot import dot
from swarmdsl.diagram.graph import KINDS, Diagram, Kind
from swarmdsl.diagram.internal import internal
from swarmdsl.diagram.mermaid import mermaid
from swarmdsl.diagram.plantuml import plantuml
from swarmdsl.diagram.statechart import statechart
from swarmdsl.diagram.svg import svg
from swarmdsl.ir import System

__all__ = ["FORMATS", "KINDS", "Diagram", "Kind", "diagrams"]

FORMATS = {"svg": svg, "dot": dot, "mermaid": mermaid, "plantuml": plantuml}
"""What writes a diagram, by the name of the format."""
SUFFIXES = {"svg": ".svg", "dot": ".dot", "mermaid": ".mmd", "plantuml": ".puml"}


def diagrams(system: System, kinds: Collection[Kind] = KINDS) -> Iterator[Diagram]:
    """Yield the diagrams of a system, in the order of the model.

    A member without parts has no inside to show.
    """
    if "composition" in kinds:
        for swarm in system.swarms:
            yield composition(swarm, system)
    if "internal" in kinds:
        components = {component.name: component for component in system.components}
        for member in system.members:
            if member.parts:
                yield internal(member, components)
    if "statechart" in kinds:
        machines = {machine.name: machine for machine in system.machines}
        for machine in system.machines:
            yield statechart(machine, machines)
