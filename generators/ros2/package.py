"""Events, functions and interfaces that machines use, and the packages they need."""

from __future__ import annotations

from collections.abc import Iterable

from swarmdsl.codegen.shared import envelopes_of
from swarmdsl.ir import Array, EventTrigger, Named, Send, StateMachine, System


def heard_events(machine: StateMachine) -> list[str]:
    """Return the names of the events that trigger transitions of a machine."""
    found: dict[str, None] = {}
    for state in machine.walk():
        for deferred in state.deferred:
            found.setdefault(deferred.event)
        for transition in state.transitions:
            for trigger in transition.triggers:
                if isinstance(trigger, EventTrigger):
                    found.setdefault(trigger.event)
    return list(found)


def sent_events(machine: StateMachine) -> list[str]:
    """Return the names of the events that a machine sends."""
    found: dict[str, None] = {}
    for state in machine.walk():
        effects = (effect for transition in state.transitions for effect in transition.effects)
        for effect in (*state.entry, *effects, *state.exit):
            if isinstance(effect, Send):
                found.setdefault(effect.event)
    return list(found)


def called_functions(machine: StateMachine) -> list[str]:
    """Return the names of the functions that a machine calls."""
    called = (state.activity for state in machine.walk())
    return list(dict.fromkeys(each.function for each in called if each is not None))


def dependencies(system: System, machines: Iterable[StateMachine]) -> list[str]:
    """Return the packages that the nodes depend on."""
    found = {"action_msgs", "builtin_interfaces", "diagnostic_msgs", "rcl_interfaces", "rclpy"}
    found.add("std_msgs")
    around = envelopes_of(system)
    promises = (each.function for member in system.members for each in member.contracts)
    for called in promises:
        if called is not None:
            found.add(system.function(called).communication.type.package)
    for machine in machines:
        for variable in machine.variables:
            element = variable.type.element if isinstance(variable.type, Array) else variable.type
            if isinstance(element, Named):
                found.add(element.package)
        for name in called_functions(machine):
            found.add(system.function(name).communication.type.package)
        for name in (*heard_events(machine), *sent_events(machine)):
            event = system.event(name)
            type_ = event.type
            if isinstance(type_, Named) and not event.predefined:
                found.add(type_.package)
            if name in around:
                found.add(around[name].type.package)
    return sorted(found)
