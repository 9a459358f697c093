"""Labels in diagrams: triggers, guards, effects and activities as in the model."""

from __future__ import annotations

from collections.abc import Iterable, Iterator

from swarmdsl.codegen.swarm_printer.actions import activity_text, effect_text
from swarmdsl.codegen.swarm_printer.expressions import default, delay, expression, with_names
from swarmdsl.ir import (
    Array,
    DoneTrigger,
    Effect,
    EventTrigger,
    Expression,
    Member,
    Named,
    OutcomeTrigger,
    Param,
    Primitive,
    Sight,
    State,
    TimeTrigger,
    Transition,
    Trigger,
    Type,
    Variable,
)
from swarmdsl.syntax.types import unit_name


def transition_label(transition: Transition, owner: State) -> tuple[str, ...]:
    """Return `trigger [guard] / effects` in pieces; branches have no trigger."""
    pieces = []
    if transition.triggers:
        pieces.append(", ".join(_trigger(each, owner) for each in transition.triggers))
    if transition.guard is not None:
        pieces.append(f"[{expression(with_names(transition.guard))}]")
    return (*pieces, *effects_label(transition.effects))


def effects_label(effects: tuple[Effect, ...]) -> tuple[str, ...]:
    """Return `/ x = 1, send Found`, one piece for each effect."""
    if not effects:
        return ()
    *others, last = map(effect_text, with_names(effects))
    first, *rest = (*(f"{each}," for each in others), last)
    return (f"/ {first}", *rest)


def behaviour_lines(state: State, entry: tuple[Effect, ...]) -> tuple[str, ...]:
    """Return entry effects, activity, exit effects, deferred events and internal transitions."""
    lines = []
    if entry:
        lines.append(f"entry {' '.join(effects_label(entry))}")
    if state.activity is not None:
        lines.append(f"do / {activity_text(with_names(state.activity), state.activity.function)}")
    if state.exit:
        lines.append(f"exit {' '.join(effects_label(state.exit))}")
    lines += (f"{trigger.event} / defer" for trigger in state.deferred)
    for _, each in internal_transitions(state):
        lines.append(" ".join(transition_label(each, state)))
    return tuple(lines)


def internal_transitions(state: State) -> Iterator[tuple[str, Transition]]:
    """Yield the internal transitions, with their ids in traces."""
    for number, each in enumerate(state.transitions):
        if each.target is None:
            yield f"{state.id}->{number}", each


def param_line(param: Param) -> str:
    """Return a param with its type and default."""
    return f"param {param.name} : {type_name(param.type)}{default(with_names(param.default))}"


def variable_line(variable: Variable, within: str = "") -> str:
    """Return a variable with its type and initial value; `within` is before its name."""
    name = f"{within}{variable.local or variable.name}"
    return f"var {name} : {type_name(variable.type)}{default(with_names(variable.initial))}"


def value_lines(values: Iterable[tuple[str, Expression]]) -> tuple[str, ...]:
    """Return values that are set, one a line."""
    return tuple(f"{name} = {expression(with_names(value))}" for name, value in values)


def equipment_groups(member: Member) -> Iterator[tuple[str, ...]]:
    """Yield the body, the battery and the radio of a member, a value a line."""
    for kind, values in (
        ("body", member.body),
        ("battery", member.battery),
        ("radio", member.radio),
    ):
        if values:
            yield (kind, *value_lines(values))


def sight_line(sight: Sight) -> str:
    """Return what a component finds and how well."""
    return " ".join([f"senses {sight.kind}", ", ".join(value_lines(sight.values))]).rstrip()


def type_name(type_: Type) -> str:
    """Return a type without its package, to keep labels short; an enum by its name."""
    unit = unit_name(type_)
    return f"{_short(type_)} in {unit}" if unit is not None else _short(type_)


def _short(type_: Type) -> str:
    match type_:
        case Array(element=element):
            return _short(element) + str(type_).removeprefix(str(element))
        case Named(name=name) | Primitive(enum=Named(name=name)):
            return name
    return str(type_)


def _trigger(trigger: Trigger, owner: State) -> str:
    match trigger:
        case EventTrigger(event=event):
            return event
        case TimeTrigger(delay=time):
            return f"after {delay(with_names(time))}"
        case OutcomeTrigger(state=state, outcome=outcome):
            return _state_event(state, owner, outcome)
        case DoneTrigger(state=state, final=final):
            done = "done" if final is None else f"done.{final.removeprefix(f'{state}.')}"
            return _state_event(state, owner, done)


def _state_event(state: str, owner: State, what: str) -> str:
    """Return an event of a state, with the state's name unless it is the owner."""
    if state == owner.id:
        return what
    return f"{state.removeprefix(f'{owner.id}.')}.{what}"
