"""Events, functions and interfaces that machines use, and the packages they need."""

from __future__ import annotations

from collections.abc import Iterable, Iterator

from swarmdsl.codegen.ros import named_types
from swarmdsl.codegen.shared import envelopes_of
from swarmdsl.ir import Cancel, EventTrigger, Named, Send, StateMachine, System


def used_items(machine: StateMachine) -> Iterator[EventTrigger | Send | Cancel]:
    """Yield the triggers and effects of machines that use an event."""
    for state in machine.walk():
        triggers = (t for transition in state.transitions for t in transition.triggers)
        effects = (e for transition in state.transitions for e in transition.effects)
        for item in (*state.deferred, *state.entry, *triggers, *effects, *state.exit):
            if isinstance(item, (EventTrigger, Send, Cancel)):
                yield item


def used_events(machines: Iterable[StateMachine]) -> list[str]:
    """Return the names of the events that the machines receive or send, each once."""
    return list(dict.fromkeys(i.event for machine in machines for i in used_items(machine)))


def used_types(system: System, machines: Iterable[StateMachine]) -> list[tuple[Named, str]]:
    """Return the interfaces that the machines use, as `msg`, `srv` or `action`."""
    found: list[tuple[Named, str]] = []
    for machine in machines:
        types = [item.type for item in machine.params] + [item.type for item in machine.variables]
        found += ((each, "msg") for type_ in types for each in named_types(type_))
        for state in machine.walk():
            if state.activity is not None:
                call = system.function(state.activity.function).communication
                found.append((call.type, "srv" if call.paradigm == "service" else "action"))
    around = envelopes_of(system)
    for name in used_events(machines):
        found += ((type_, "msg") for type_ in named_types(system.event(name).type))
        if name in around:
            found.append((around[name].type, "msg"))
    return list(dict.fromkeys(found))


def dependencies(used: Iterable[tuple[Named, str]]) -> list[str]:
    """Return the packages that the nodes depend on."""
    packages = {"genpy", "rospy", "smach", "smach_ros"}
    for type_, kind in used:
        packages |= {type_.package, *(("actionlib", "actionlib_msgs") if kind == "action" else ())}
    return sorted(packages)


def activity_modules(used: Iterable[tuple[Named, str]]) -> list[str]:
    """Return the modules with the states that call functions."""
    kinds = {kind for _, kind in used}
    return [
        module for module, kind in (("actions", "action"), ("services", "srv")) if kind in kinds
    ]
