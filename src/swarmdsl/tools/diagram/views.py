"""Diagrams of a model."""

from __future__ import annotations

from collections.abc import Collection, Iterator

from swarmdsl.codegen.diagram.composition import composition
from swarmdsl.codegen.diagram.graph import KINDS, Diagram, Kind
from swarmdsl.codegen.diagram.internal import internal
from swarmdsl.codegen.diagram.statechart import statechart
from swarmdsl.ir import System


def diagrams(system: System, kinds: Collection[Kind] = KINDS) -> Iterator[Diagram]:
    """Yield the diagrams of a system in model order.

    A member without parts has no internal diagram.
    """
    if "composition" in kinds:
        for swarm in system.swarms:
            yield composition(swarm, system)
    if "internal" in kinds:
        components = system.components_by_name
        for member in system.members:
            if member.parts:
                yield internal(member, components)
    if "statechart" in kinds:
        machines = system.machines_by_name
        for machine in system.machines:
            yield statechart(machine, machines)
