"""ROS topics that a member uses in its behaviour, ports and functions."""

from __future__ import annotations

from collections.abc import Iterator

from swarmdsl.base.records import dataclass, field
from swarmdsl.base.source import Span
from swarmdsl.codegen.shared.wiring import member_wiring
from swarmdsl.ir import (
    Component,
    Effect,
    EventTrigger,
    Member,
    Port,
    Send,
    StateMachine,
    System,
    Type,
)


@dataclass(frozen=True)
class Use:
    """Subscription to a topic or publication on it; `origin` names the topic."""

    topic: str
    type: Type
    heard: bool
    origin: Span | None = field(default=None, compare=False)


def uses(member: Member, system: System) -> Iterator[Use]:
    """Yield each use once, in the order of the model."""
    components = system.components_by_name
    machines = system.machines_by_name
    owners: list[Member | Component] = [member]
    owners += [components[part.component] for part in member.parts]
    found: dict[Use, None] = {}
    for owner in owners:
        if owner.behavior is not None:
            found.update(dict.fromkeys(_of_machine(machines[owner.behavior], system)))
    wired = member_wiring(member, system)
    for ref, port in wired.ports.items():
        found.update(dict.fromkeys(_of_port(port, wired.topic(ref))))
    yield from found


def _of_machine(machine: StateMachine, system: System) -> Iterator[Use]:
    for state in machine.walk():
        if state.activity is not None:
            for port in system.function(state.activity.function).ports:
                yield Use(port.topic, port.type, port.direction == "in", port.origin)
        yield from _of_effects((*state.entry, *state.exit), system)
        for deferred in state.deferred:
            yield from _of_trigger(deferred, system)
        for transition in state.transitions:
            for trigger in transition.triggers:
                if isinstance(trigger, EventTrigger):
                    yield from _of_trigger(trigger, system)
            yield from _of_effects(transition.effects, system)


def _of_trigger(trigger: EventTrigger, system: System) -> Iterator[Use]:
    event = system.event(trigger.event)
    if not event.predefined:
        yield Use(event.incoming_topic, event.type, True, event.origin)


def _of_effects(effects: tuple[Effect, ...], system: System) -> Iterator[Use]:
    for effect in effects:
        if isinstance(effect, Send):
            event = system.event(effect.event)
            yield Use(event.topic, event.type, False, event.origin)


def _of_port(port: Port, topic: str) -> Iterator[Use]:
    if port.direction != "out":
        yield Use(topic, port.type, True, port.origin)
    if port.direction != "in":
        yield Use(topic, port.type, False, port.origin)
