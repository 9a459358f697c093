"""Tables of the ROS interfaces of a machine, for the README of its package."""

from __future__ import annotations

from swarmdsl.codegen.shared import envelopes_of
from swarmdsl.ir import Event, EventTrigger, Send, StateMachine, System

from .package import used_items

Rows = tuple[tuple[str, str], ...]


def uses(system: System, machine: StateMachine) -> tuple[tuple[str, Rows], ...]:
    """Return the tables of params, servers and topics that are not empty."""
    heard: dict[str, str] = {}
    sent: dict[str, str] = {}
    around = envelopes_of(system)
    for item in used_items(machine):
        event: Event = system.event(item.event)
        type_ = around[event.name].type if event.name in around else event.type
        if isinstance(item, EventTrigger):
            heard.setdefault(event.incoming_topic, str(type_))
        elif isinstance(item, Send):
            sent.setdefault(event.topic, str(type_))
    servers: dict[str, str] = {}
    for state in machine.walk():
        if state.activity is not None:
            call = system.function(state.activity.function).communication
            servers.setdefault(call.name, f"{call.type} ({call.paradigm})")
    params = {f"~{param.name}": str(param.type) for param in machine.params}
    tables = (
        ("ROS parameters", params),
        ("Servers that it calls", servers),
        ("Topics that it hears", heard),
        ("Topics that it sends on", sent),
    )
    return tuple((title, tuple(rows.items())) for title, rows in tables if rows)
