"""Envelopes: messages of ROS around those of swarm events that have no place for what is asked.

A header of a message may tell its sender and its time; if it does not, or if the event has an
address, an interface package of its own declares a message around it. So it does for an event
that one machine of a robot sends and another one handles: it is for other robots, and the envelope
tells which one it is from. All other events keep their type.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Mapping

from swarmdsl.base.naming import FreshNames, camel_case, snake_case
from swarmdsl.ir import (
    Address,
    Assignment,
    Cancel,
    Effect,
    EnvelopeField,
    EventTrigger,
    Expression,
    Field,
    Literal,
    Message,
    Named,
    Primitive,
    Send,
    StateMachine,
    System,
    subexpressions,
)

BRIDGE_HEADER = Named("swarmros", "EventHeader")
"""Header by which the bridge of ROS 1 identifies an event: its name and sender."""
_TEXT, _TIME = Primitive("string"), Primitive("time")


def envelopes_of(system: System) -> Mapping[str, Message]:
    """Return the envelope of each swarm event that needs one, by the name of the event."""
    needing = {name for machine in system.machines for name in _needing(machine)}
    needing |= _between_machines(system)
    package, names = f"{snake_case(system.name)}_events", FreshNames()
    return {
        event.name: Message(
            Named(package, names.new(f"{camel_case(event.name)}Envelope")),
            tuple(_fields(event.type, system)),
            external=False,
            doc=f"Event {event.name} between robots.",
            origin=event.origin,
        )
        for event in system.events
        if event.swarm and event.name in needing and isinstance(event.type, Named)
    }


def reads_envelope(content: Iterable[Expression | Effect]) -> bool:
    """Return True if guards or effects ask for a fact that only an envelope tells."""
    parts = (part for value in _values(content) for part in subexpressions(value))
    return any(isinstance(part, EnvelopeField) and part.header is None for part in parts)


def _between_machines(system: System) -> set[str]:
    """Return the events that one machine of a robot sends, and another one of it handles."""
    found = set()
    components, machines = system.components_by_name, system.machines_by_name
    for member in system.members:
        parts = [components[part.component].behavior for part in member.parts]
        run = [machines[name] for name in (member.behavior, *parts) if name is not None]
        for number, sender in enumerate(run if len(run) > 1 else ()):
            others = (*run[:number], *run[number + 1 :])
            found |= _sent(sender) & {name for other in others for name in _handled(other)}
    return found


def _sent(machine: StateMachine) -> set[str]:
    return {each.event for each in _effects(machine) if isinstance(each, Send)}


def _handled(machine: StateMachine) -> set[str]:
    return {
        trigger.event
        for state in machine.walk()
        for transition in state.transitions
        for trigger in transition.triggers
        if isinstance(trigger, EventTrigger)
    }


def _effects(machine: StateMachine) -> Iterator[Effect]:
    for state in machine.walk():
        yield from (*state.entry, *state.exit)
        for transition in state.transitions:
            yield from transition.effects


def _needing(machine: StateMachine) -> Iterator[str]:
    for state in machine.walk():
        for transition in state.transitions:
            guard = () if transition.guard is None else (transition.guard,)
            if reads_envelope((*guard, *transition.effects)):
                triggers = transition.triggers
                yield from (each.event for each in triggers if isinstance(each, EventTrigger))
    for effect in _effects(machine):
        if isinstance(effect, Send) and effect.to is not None:
            yield effect.event


def _values(content: Iterable[Expression | Effect]) -> Iterator[Expression]:
    for each in content:
        match each:
            case Assignment(value=value):
                yield value
            case Send(arguments=arguments, to=to, delay=delay):
                yield from (value for _, value in arguments)
                yield from to.values if to is not None else ()
                yield from (delay,) if delay is not None else ()
            case Cancel():
                pass
            case _:
                yield each


def _fields(wrapped: Named, system: System) -> Iterator[Field]:
    message = system.known_interface(wrapped)
    if isinstance(message, Message) and any(each.type == BRIDGE_HEADER for each in message.fields):
        yield Field("swarmio", BRIDGE_HEADER, "For the bridge between the robots.")
    yield Field("sender", _TEXT, "The robot that sent it; empty: nobody of the swarm.")
    yield Field("sent", _TIME, "When it was sent.")
    yield Field("to", _TEXT, "The robot or role that it is for; empty: all others.")
    yield Field("message", wrapped, "The event itself.")


def python_address(to: Address, value: Callable[[Expression], str]) -> str:
    """Return an address as an expression of Python, given the printer of expressions."""
    if to.id is not None:
        return value(to.id)
    if to.index is None:
        return repr(to.role)
    if isinstance(to.index, Literal):
        return repr(f"{to.role}[{to.index.value}]")
    return f"{f'{to.role}[{{}}]'!r}.format({value(to.index)})"
