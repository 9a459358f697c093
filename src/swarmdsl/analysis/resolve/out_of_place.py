"""Hints for a name that means no value where it is used, but something else elsewhere.

Only a model with mistakes imports this module.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence

from swarmdsl.analysis.resolve.identity_tests import identity_tests
from swarmdsl.analysis.resolve.missing_variable import type_of
from swarmdsl.analysis.resolve.scopes import FileScope
from swarmdsl.analysis.resolve.states import variables_of
from swarmdsl.base.diagnostics.advice import write
from swarmdsl.syntax.ast import (
    Assignment,
    Element,
    Event,
    EventTrigger,
    Expression,
    Fact,
    IndexUse,
    NameUse,
    Parallel,
    Param,
    Query,
    Region,
    State,
    StateMachine,
    TopLevel,
    Transition,
    Value,
    Variable,
    nodes_of,
    walk,
)
from swarmdsl.syntax.types import ENVELOPE_FIELDS, Array, Named


def meaning_elsewhere(
    use: NameUse,
    within: Expression,
    owner: TopLevel,
    machines: Iterable[StateMachine],
    scope: FileScope,
) -> str | None:
    """Hint for a field without its item or event, or a variable of a state of the machines."""
    for query in walk(within) if within.tree is not None else ():
        if isinstance(query, Query) and _has_field(query.element, use.name, scope):
            parts = [part for part in (query.condition, query.key) if part is not None]
            if any(use is node for part in parts for node in walk(part)):
                return write(f"{query.element.name}.{use.name}")
    facts = (fact for fact in nodes_of(owner, Fact) if fact.guard is within)
    for fact in facts:
        heard = fact.act == "hears"
        if fact.event is not None and _have_field(use.name, [fact.event.target], heard, scope):
            return write(f"event.{use.name}")
        if fact.event is not None and not fact.act:
            return _of_a_robot(use.name, fact.event.name, machines)
    for machine in machines:
        if _is_field_of_event(use.name, within, machine, scope):
            return write(f"event.{use.name}")
        for state in _states(machine):
            if any(each.name == use.name for each in variables_of(state)):
                return (
                    f"it is a variable of `{state.name}`: declare it in `{machine.name}` to use it "
                    "here"
                )
    return None


def _of_a_robot(name: str, event: str, machines: Iterable[StateMachine]) -> str | None:
    """Hint for a variable of robots in the condition of an event that is about no robot."""
    for machine in machines:
        values: list[Variable | Param] = [*nodes_of(machine, Variable), *nodes_of(machine, Param)]
        if any(each.name == name for each in values):
            return f"an event from outside is about no robot: write `hears {event} [...]`"
    return None


def robot_as_value(use: NameUse, owner: TopLevel) -> str | None:
    """Hint for a robot or role without quotes, compared with the id or role of one."""
    for test in identity_tests(owner) if isinstance(owner, StateMachine) else ():
        value = test.value
        if value is use:
            name = use.name if test.of_role else f"{use.name}[0]"
        elif isinstance(value, IndexUse) and value.base is use:
            number = value.index.span.text if isinstance(value.index, Value) else "0"
            name = use.name if test.of_role else f"{use.name}[{number}]"
        else:
            continue
        what = "role" if test.of_role else "robot"
        return write(f'"{name}"', before=f"the name of a {what} is a string: ")
    return None


def _is_field_of_event(
    name: str, within: Expression, machine: StateMachine, scope: FileScope
) -> bool:
    """Return True if all events of the transition around a value have a field or a fact."""
    if any(each.target is within for each in nodes_of(machine, Assignment)):
        return False
    around = (
        each for each in nodes_of(machine, Transition) if any(n is within for n in walk(each))
    )
    transition = next(around, None)
    events = []
    for trigger in transition.triggers if transition is not None else ():
        events.append(trigger.event.target if isinstance(trigger, EventTrigger) else None)
    return _have_field(name, events, True, scope)


def _have_field(name: str, events: Sequence[Event | None], heard: bool, scope: FileScope) -> bool:
    """Return True if all events have a field, or a fact about what is heard of other robots."""
    types = {event.type.type for event in events if event is not None}
    if None in events or len(types) != 1:
        return False
    (type_,) = types
    fields = scope.interfaces.fields(type_) if isinstance(type_, Named) else None
    of_swarm = heard and all(event is not None and event.swarm for event in events)
    facts = ENVELOPE_FIELDS if of_swarm else ()
    return name in facts or any(each.name == name for each in fields or ())


def _has_field(element: Element, name: str, scope: FileScope) -> bool:
    array = type_of(element.array)
    item = array.element if isinstance(array, Array) else None
    fields = scope.interfaces.fields(item) if isinstance(item, Named) else None
    return any(each.name == name for each in fields or ())


def _states(machine: StateMachine) -> Iterator[State | Parallel | Region]:
    yield from nodes_of(machine, State)
    yield from nodes_of(machine, Parallel)
    yield from nodes_of(machine, Region)
