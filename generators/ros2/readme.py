"""Tables of the ROS interfaces of a node, for the README of its package."""

from __future__ import annotations

from collections.abc import Iterator

from swarmdsl.codegen.shared import envelopes_of
from swarmdsl.ir import StateMachine, System

from .package import called_functions, heard_events, sent_events
from .topics import place

Rows = tuple[tuple[str, ...], ...]


def tables(machine: StateMachine, system: System) -> tuple[tuple[str, str, Rows], ...]:
    """Return the title, the head and the rows of each table that is not empty."""
    found = (
        ("Servers that it calls", "name | type | function", tuple(_servers(machine, system))),
        ("Topics that it hears and sends on", "topic | type |", tuple(_topics(machine, system))),
        ("Parameters of the model", "name | type |", tuple(_params(machine))),
    )
    return tuple(table for table in found if table[2])


def _servers(machine: StateMachine, system: System) -> Iterator[tuple[str, ...]]:
    for name in called_functions(machine):
        call = system.function(name).communication
        yield call.name, f"{call.type} ({call.paradigm})", name


def _topics(machine: StateMachine, system: System) -> Iterator[tuple[str, ...]]:
    heard, sent = heard_events(machine), sent_events(machine)
    around = envelopes_of(system)
    for name in dict.fromkeys([*heard, *sent]):
        event = system.event(name)
        if event.predefined:
            continue
        topic, of_swarm = place(event, name in sent)
        type_ = around[name].type if name in around else event.type
        ways = [*(["hears"] if name in heard else []), *(["sends"] if name in sent else [])]
        where = " of the swarm" if of_swarm else ""
        yield topic, str(type_), f"{name}{where}: {' and '.join(ways)}"


def _params(machine: StateMachine) -> Iterator[tuple[str, ...]]:
    for param in machine.params:
        given = param.default is not None or param.declared is not None
        yield param.name, str(param.type), "has a default" if given else "must be given"
