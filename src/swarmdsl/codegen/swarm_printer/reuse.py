"""Recover reused machines, with the values of their params.

Lowering expands a reused machine; this is the inverse.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from typing import Any

from swarmdsl.base.naming import snake_case
from swarmdsl.base.records import dataclass, fields_of, is_dataclass, replace
from swarmdsl.ir import (
    Assignment,
    Binary,
    Call,
    DoneTrigger,
    Effect,
    Elapsed,
    Expression,
    FieldAccess,
    InState,
    Literal,
    OutcomeTrigger,
    Param,
    ParamRef,
    Primitive,
    ResultMapping,
    State,
    StateMachine,
    Transition,
    Type,
    Unary,
    Variable,
    VariableRef,
)
from swarmdsl.syntax.types import BOOL, DURATION, FLOAT, FLOATS, INT, INTEGERS, STRING

_IDS = {
    (State, "id"),
    (State, "initial"),
    (Transition, "target"),
    (OutcomeTrigger, "state"),
    (DoneTrigger, "state"),
    (DoneTrigger, "final"),
    (InState, "state"),
    (Elapsed, "state"),
}
_VARIABLES = {(VariableRef, "name"), (Assignment, "variable"), (ResultMapping, "variable")}
_OPERATIONS = (Unary, Binary, Call, FieldAccess)


@dataclass(frozen=True)
class Use:
    """Reuse of a machine by a state: bound params, and own effects on entry."""

    bindings: tuple[tuple[str, Expression], ...]
    entry: tuple[Effect, ...]


@dataclass(frozen=True)
class Reuse:
    """Source form of a machine: own variables, and reusing states by id."""

    variables: tuple[Variable, ...]
    uses: Mapping[str, Use]


def find_reuse(machine: StateMachine, machines: Mapping[str, StateMachine]) -> Reuse | None:
    """Return the source form; None if lowering cannot have made the machine."""
    states = list(_reusing(machine.states))
    if any(state.submachine not in machines for state in states):
        return None
    variables = own_variables(machine, machines)
    start = len(variables)
    uses: dict[str, Use] = {}
    if _any_entered_from_outside(states, machine):
        return None
    for state in states:
        template = machines[state.submachine or ""]
        end = start + len(template.variables)
        found = _use(state, template, machine.variables[start:end], machines)
        if found is None:
            return None
        uses[state.id] = found
        start = end
    taken = {param.name for param in machine.params}
    names = list(_names(machine, "", machines, taken)) if states else []
    if states and names != [variable.name for variable in machine.variables]:
        return None
    return Reuse(variables, uses)


def own_variables(
    machine: StateMachine, machines: Mapping[str, StateMachine]
) -> tuple[Variable, ...]:
    """Return the variables before those of reused machines."""
    reused = (machines[state.submachine or ""] for state in _reusing(machine.states))
    end = len(machine.variables) - sum(len(each.variables) for each in reused)
    return machine.variables[: max(end, 0)]


def _reusing(states: tuple[State, ...]) -> Iterator[State]:
    """Yield the states that reuse a machine, without those inside such a machine."""
    for state in states:
        if state.submachine is not None:
            yield state
        else:
            yield from _reusing(state.states)


def _any_entered_from_outside(states: Iterable[State], machine: StateMachine) -> bool:
    """Return True if a transition leads into one of some states from elsewhere."""
    around = {each.id: state.id for state in states for each in state.walk() if each is not state}
    return bool(around) and any(
        transition.target in around and around[transition.target] != around.get(each.id)
        for each in machine.walk()
        for transition in each.transitions
    )


def _names(
    machine: StateMachine, prefix: str, machines: Mapping[str, StateMachine], taken: set[str]
) -> Iterator[str]:
    """Return the lowered names of a machine's variables at state `prefix`."""
    for variable in own_variables(machine, machines):
        name = f"{snake_case(prefix)}_{variable.name}" if prefix else variable.name
        while name in taken:
            name += "_"
        taken.add(name)
        yield name
    for state in _reusing(machine.states):
        path = f"{prefix}.{state.id}" if prefix else state.id
        yield from _names(machines[state.submachine or ""], path, machines, taken)


def _use(
    state: State,
    template: StateMachine,
    variables: tuple[Variable, ...],
    machines: Mapping[str, StateMachine],
) -> Use | None:
    """Return the reuse whose expansion is `state`, or None."""
    if [_nameless(each) for each in template.variables] != [_nameless(each) for each in variables]:
        return None
    names = {
        theirs.name: ours.name for theirs, ours in zip(template.variables, variables, strict=True)
    }
    match_ = _Match(state.id, names, {})
    alike = match_.same(template.states, state.states)
    if not alike or state.initial != f"{state.id}.{template.initial}" or state.activity is not None:
        return None
    first_values = tuple(
        Assignment(names[each.name], (), each.initial)
        for each in own_variables(template, machines)
        if each.initial is not None
    )
    count = len(first_values)
    bindings = _bindings(template, match_.bound)
    if bindings is None or state.entry[:count] != first_values:
        return None
    return Use(bindings, state.entry[count:])


def _nameless(variable: Variable) -> Variable:
    return replace(variable, name="")


def _bindings(
    template: StateMachine, bound: Mapping[str, Expression]
) -> tuple[tuple[str, Expression], ...] | None:
    """Return the values of a machine's params that differ from the defaults."""
    bindings = []
    for param in template.params:
        value = bound.get(param.name)
        if value is None and param.default is None:
            value = _any_value(param)
            if value is None:
                return None
        if value is not None and value != param.default:
            bindings.append((param.name, value))
    return tuple(bindings)


def _any_value(param: Param) -> Literal | None:
    """Return a value for a param that is never read; None if its type has no literal."""
    values: dict[Type, Literal] = {
        BOOL: Literal(False, BOOL),
        STRING: Literal("", STRING),
        DURATION: Literal(0, DURATION),
        **{Primitive(name): Literal(0, INT) for name in INTEGERS},
        **{Primitive(name): Literal(0.0, FLOAT) for name in FLOATS},
    }
    return values.get(param.type)


@dataclass(frozen=True)
class _Match:
    """Comparison of a machine's states with those expanded below state `prefix`.

    `variables` gives the names of its variables there; `bound` collects the values of params.
    """

    prefix: str
    variables: Mapping[str, str]
    bound: dict[str, Expression]

    def same(self, template: Any, actual: Any) -> bool:
        match template:
            case ParamRef(name=name):
                return bool(self.bound.setdefault(name, actual) == actual)
            case Unary(operator="-", operand=operand) if isinstance(actual, Literal):
                if isinstance(actual.value, str):
                    return False
                return self.same(operand, replace(actual, value=-actual.value))
            case tuple():
                return (
                    isinstance(actual, tuple)
                    and len(template) == len(actual)
                    and all(map(self.same, template, actual))
                )
        if is_dataclass(type(template)):
            return type(template) is type(actual) and all(
                self._same_field(template, actual, name)
                for name, about in fields_of(type(template)).items()
                if about.get("compare", True)
            )
        return bool(template == actual)

    def _same_field(self, template: Any, actual: Any, name: str) -> bool:
        theirs, ours = getattr(template, name), getattr(actual, name)
        kind = (type(template), name)
        if theirs is not None and kind in _IDS:
            return bool(ours == f"{self.prefix}.{theirs}")
        if kind in _VARIABLES:
            return bool(ours == self.variables.get(theirs))
        if name == "type" and isinstance(template, _OPERATIONS):
            return True  # it follows from the operands
        return self.same(theirs, ours)
