"""Userdata that code generated from the CPSwarm dialect does not set up.

It gives keys no initial value, and its containers pass no key on.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator

from swarmdsl.codegen.exchange.scxml.cpswarm_structure import Vertex
from swarmdsl.ir import Activity, StateMachine, Variable, reads


def missing(machine: StateMachine, shaped: Iterable[Vertex]) -> Iterator[tuple[Variable, str]]:
    """Yield the variables that need a line by hand, with the reason."""
    calls = list(_calls(shaped, None))
    for variable in machine.variables:
        name = variable.name
        reading = {place for place, activity in calls if name in _read(activity)}
        writing = {place for place, activity in calls if name in _written(activity)}
        if reading and (variable.initial is not None or not writing):
            yield variable, f"`userdata.{name}` has no initial value"
        if len(reading | writing) > 1:
            yield variable, f"no container has `{name}` among its input and output keys"


def _calls(vertices: Iterable[Vertex], container: Vertex | None) -> Iterator[tuple[int, Activity]]:
    """Yield the activities, each with its container."""
    for vertex in vertices:
        if vertex.children:
            yield from _calls([v for v in vertex.children if isinstance(v, Vertex)], vertex)
        elif vertex.state.activity is not None:
            yield id(container), vertex.state.activity


def _read(activity: Activity) -> set[str]:
    return set().union(*(reads(value) for _, value in activity.arguments))


def _written(activity: Activity) -> set[str]:
    return {result.variable for result in activity.results}
