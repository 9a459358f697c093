"""What machines use, and the packages that they need."""

from __future__ import annotations

from collections.abc import Iterable, Iterator

from swarmdsl.codegen.ros import named_types
from swarmdsl.ir import EventTrigger, Named, Send, StateMachine, System


def used_items(machine: StateMachine) -> Iterator[EventTrigger | Send]:
    """What waits for an event or sends one."""
    for state in machine.walk():
        triggers = (t for transition in state.transitions for t in transition.triggers)
        effects = (e for transition in state.transitions for e in transition.effects)
        for item in (*state.entry, *triggers, *effects, *state.exit):
            if isinstance(item, (EventTrigger, Send)):
                yield item


def used_events(machines: Iterable[StateMachine]) -> list[str]:
    """The names of the events that the machines wait for or send, each once."""
    return list(dict.fromkeys(i.event for machine in machines for i in used_items(machine)))


def used_types(system: System, machines: Iterable[StateMachine]) -> list[tuple[Named, str]]:
    """The interfaces that the machines use, as `msg`, `srv` or `action`."""
    found: list[tuple[Named, str]] = []
    for machine in machines:
        types = [item.type for item in machine.params] + [item.type for item in machine.variables]
        found += ((each, "msg") for type_ in types for each in named_types(type_))
        for state in machine.walk():
            if state.activity is not None:
                call = system.function(state.activity.function).communication
                found.append((call.type, "srv" if call.paradigm == "service" else "action"))
    for name in used_events(machines):
        found += ((type_, "msg") for type_ in named_types(system.event(name).type))
    return list(dict.fromkeys(found))


def dependencies(used: Iterable[tuple[Named, str]]) -> list[str]:
    """The packages that the nodes need."""
    packages = {"genpy", "rospy", "smach", "smach_ros"}
    for type_, kind in used:
        packages |= {type_.package, *(("actionlib", "actionlib_msgs") if kind == "action" else ())}
    return sorted(packages)


def activity_modules(used: Iterable[tuple[Named, str]]) -> list[str]:
    """The modules of the package with the states that call functions."""
    kinds = {kind for _, kind in used}
    return [
        module for module, kind in (("actions", "action"), ("services", "srv")) if kind in kinds
    ]
