"""Accesses to variables (reads and writes) in the parts of a state machine, in order."""

from __future__ import annotations

from collections.abc import Iterator
from typing import get_args

from swarmdsl.analysis.types import stored_name
from swarmdsl.base.records import dataclass
from swarmdsl.base.source import Span
from swarmdsl.syntax.ast import (
    Activity,
    Append,
    Assignment,
    Cancel,
    Effect,
    Entry,
    Exit,
    Expression,
    NameUse,
    OutcomeTrigger,
    Parallel,
    ResultMapping,
    Send,
    State,
    StateMachine,
    Store,
    TimeTrigger,
    Transition,
    Trigger,
    Value,
    Variable,
    Vertex,
    nodes_of,
    walk,
)


@dataclass(frozen=True, slots=True)
class Read:
    """Read of a variable; `test` is True in a guard."""

    variable: Variable
    span: Span
    test: bool = False


@dataclass(frozen=True, slots=True)
class Write:
    """Write of a variable or a field of it."""

    variable: Variable


Access = Read | Write


def storing_nodes(machine: StateMachine) -> list[Store | ResultMapping]:
    """Return the nodes that store a value in a variable."""
    kinds: tuple[type[Store | ResultMapping], ...] = (*get_args(Store), ResultMapping)
    return [node for kind in kinds for node in nodes_of(machine, kind)]


def accesses_on_activation(vertex: Vertex) -> list[Access]:
    """Return the reads when a state becomes active: of its activity, params and delays."""
    if not isinstance(vertex, (State, Parallel)):
        return []
    arguments = list(vertex.bindings) if isinstance(vertex, State) else []
    values: list[Expression] = []
    for item in vertex.items:
        match item:
            case Activity():
                arguments += item.arguments
            case Transition():
                values += [each.delay for each in item.triggers if isinstance(each, TimeTrigger)]
    values += [argument.value for argument in arguments]
    return [read for value in values for read in reads(value)]


def result_accesses(trigger: Trigger | None, state: State | Parallel) -> list[Access]:
    """Return the writes of an ended activity, which precede the guards of its transitions."""
    if not isinstance(trigger, OutcomeTrigger) or trigger.outcome != "succeeded":
        return []
    return [
        Write(variable)
        for item in state.items
        if isinstance(item, Activity)
        for result in item.results
        for variable in _variables(stored_name(result.target.tree))
    ]


def action_accesses(kind: type[Entry] | type[Exit], state: State | Parallel) -> list[Access]:
    """Return the accesses of the entry or exit actions of a state."""
    return [
        access
        for item in state.items
        if isinstance(item, kind)
        for access in effect_accesses(item.effects)
    ]


def effect_accesses(effects: list[Effect]) -> list[Access]:
    """Return the accesses of effects.

    An assignment from the own value (`n = n + 1`) is no read: `n` starts as zero.
    """
    found: list[Access] = []
    for effect in effects:
        match effect:
            case Send(arguments=arguments, to=to, delay=delay):
                found += reads(delay)
                found += [read for argument in arguments for read in reads(argument.value)]
                if to is not None:
                    found += reads(to.id)
            case Cancel():
                pass
            case _:
                value = effect.value if isinstance(effect, Assignment | Append) else None
                name = stored_name(effect.target.tree)
                stored = _variables(name)
                # The name of the array itself is in the target, and the number of an item.
                found += [
                    read
                    for part in (value, effect.target)
                    for read in reads(part)
                    if read.variable not in stored
                ]
                found += [Write(variable) for variable in stored]
    return found


def reads(value: Expression | None, *, test: bool = False) -> Iterator[Read]:
    """Yield the reads of an expression."""
    if value is None or isinstance(value.tree, Value):
        return
    for use in walk(value):
        if isinstance(use, NameUse) and isinstance(use.target, Variable):
            yield Read(use.target, use.span, test)


def _variables(name: NameUse | None) -> list[Variable]:
    """Return the variable of a name that a store changes, if it is one."""
    return [name.target] if name is not None and isinstance(name.target, Variable) else []
