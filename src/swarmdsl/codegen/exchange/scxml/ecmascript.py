"""Expressions and initial values in ECMAScript, for portable documents."""

from __future__ import annotations

import json
import re
from collections.abc import Callable, Mapping, Sequence

from swarmdsl.codegen.exchange.scxml.arrays import (
    ARRAY_FUNCTIONS,
    NO_VALUE,
    construction_text,
    copied,
    item_name,
    query_text,
)
from swarmdsl.codegen.exchange.scxml.effects import effects_of
from swarmdsl.codegen.shared.default_values import default_value
from swarmdsl.codegen.shared.identity import uses_self
from swarmdsl.ir import (
    Address,
    Assignment,
    Call,
    Effect,
    EnvelopeField,
    Expression,
    Literal,
    Send,
    StateMachine,
    System,
    TimeTrigger,
    Trigger,
    Type,
)
from swarmdsl.ir.expression_printer import Dialect, ecmascript_literal, points, translate

SELF = "self"
"""Id of the `<data>` with the identity of the robot."""

NOW = "Date.now()"
"""The time, in milliseconds."""


def dialect(
    data: Mapping[str, str],
    system: System | None = None,
    states: Mapping[str, str] | None = None,
    entries: Mapping[str, str] | None = None,
) -> Dialect:
    """Return the dialect, in which variables and params have the ids of `data`.

    `system` describes the messages of which expressions make new ones, `states` gives the ids of
    states, `entries` the ids of the data with the times at which they were entered.
    """
    known, since = states or {}, entries or {}
    return Dialect(
        literal=ecmascript_literal,
        variable=data.__getitem__,
        param=data.__getitem__,
        event="_event.data",
        envelope=_envelope,
        identity=f"{SELF}.{{}}".format,
        operators={"and": "&&", "or": "||", "not": "!"},
        functions={
            "sqrt": _root,
            "min": "Math.min",
            "max": "Math.max",
            "abs": "Math.abs",
            "len": ".length",
            "float": "Number",
            "hypot": "Math.hypot",
            "clamp": _clamped,
            "atan2": lambda values: "Math.atan2({} + 0, {} + 0)".format(*values),
            "distance": _distance,
            **ARRAY_FUNCTIONS,
            **{name: _of_finite("a - a == 0", result) for name, result in _FINITE.items()},
            # A wave of NaN is NaN.
            **{
                name: _of_finite("Math.abs(a) != Infinity", f"Math.{name}(a)")
                for name in ("sin", "cos")
            },
        },
        item=lambda name: item_name(name, data.values()),
        query=lambda query, text: query_text(query, text, data.values()),
        construction=lambda made, text: construction_text(made, text, system),
        in_state=lambda state: f"In('{known[state]}')",
        elapsed=lambda state: f"({NOW} - {since[state]})",
        modulo=_modulo,
        quotient=_quotient,
        division=_division,
    )


def _envelope(fact: EnvelopeField) -> str:
    """Return who sent the event, empty if nobody of the swarm did, or when, 0 if nobody says."""
    if fact.field == "sender":
        return '(_event.origin || "")'
    return f"(_event.data && _event.data.{fact.field} || 0)"


def _quotient(left: str, right: str) -> str:
    if _is_number(right):
        return f"{left} / {right}"
    return f"(function (a, b) {{ return b != 0 ? a / b : {NO_VALUE}; }})({left}, {right})"


def _modulo(left: str, right: str) -> str:
    """Return the remainder with the sign of the divisor, unlike ECMAScript's `%`."""
    if _is_number(right):
        return f"(({left} % {right}) + {right}) % {right}"
    result = f"b != 0 ? ((a % b) + b) % b : {NO_VALUE}"
    return f"(function (a, b) {{ return {result}; }})({left}, {right})"


def _division(left: str, right: str) -> str:
    """Return the quotient of integers, rounded down."""
    if _is_number(right):
        return f"Math.floor({left} / {right})"
    result = f"b != 0 ? Math.floor(a / b) : {NO_VALUE}"
    return f"(function (a, b) {{ return {result}; }})({left}, {right})"


# `Math.round` takes halves up, and some engines compute it with an error of rounding.
_FINITE = {
    "int": "Math.trunc(a)",
    "floor": "Math.floor(a)",
    "ceil": "Math.ceil(a)",
    "round": "Math.floor(a) + (a - Math.floor(a) > 0.5 "
    "|| a - Math.floor(a) == 0.5 && Math.floor(a) % 2 != 0 ? 1 : 0)",
}


def _clamped(values: Sequence[str]) -> str:
    return f"(function (a, b, c) {{ return Math.min(Math.max(a, b), c); }})({', '.join(values)})"


def _distance(coordinates: Sequence[str]) -> str:
    first, second, names = points(coordinates)
    parts = ", ".join(f"a.{name} - b.{name}" for name in names)
    return f"(function (a, b) {{ return Math.hypot({parts}); }})({first}, {second})"


def _of_finite(test: str, result: str) -> Callable[[Sequence[str]], str]:
    """Return the printer of a function without a value for numbers that fail the test."""
    head = f"(function (a) {{ return {test} ? {result} : {NO_VALUE}; }})"
    return lambda values: f"{head}({values[0]})"


def _root(values: Sequence[str]) -> str:
    (value,) = values
    if _is_number(value):
        return f"Math.sqrt({value})"
    return f"(function (a) {{ return a >= 0 ? Math.sqrt(a) : {NO_VALUE}; }})({value})"


def _is_number(text: str) -> bool:
    """Return True for a number literal; checks report a model where it is not above 0."""
    return re.fullmatch(r"[0-9.]+(e[-+]?[0-9]+)?", text) is not None


def stored(expression: Expression, words: Dialect) -> str:
    """Return a value to assign or send; messages and arrays are copied, as in ROS."""
    if isinstance(expression, Call) and expression.function in ("append", "replace"):
        at = 1 if expression.function == "append" else 2
        values = [
            stored(part, words) if number == at else translate(part, words)
            for number, part in enumerate(expression.arguments)
        ]
        return ARRAY_FUNCTIONS[expression.function](values)
    return copied(expression, translate(expression, words))


def address(to: Address, words: Dialect) -> str:
    """Return an address as an expression: the id of a robot, or a role."""
    if to.id is not None:
        return translate(to.id, words)
    if to.index is None:
        return json.dumps(to.role)
    if isinstance(to.index, Literal):
        return json.dumps(f"{to.role}[{to.index.value}]")
    return f'{json.dumps(f"{to.role}[")} + ({translate(to.index, words)}) + "]"'


def needs_data(machine: StateMachine) -> bool:
    """Return True if SCXML's null data model does not suffice for the machine."""
    if machine.variables or machine.params or uses_self(machine):
        return True
    if any(map(_is_computed_effect, effects_of(machine))):
        return True
    return any(
        transition.guard is not None or any(map(_is_computed, transition.triggers))
        for state in machine.walk()
        for transition in state.transitions
    )


def _is_computed_effect(effect: Effect) -> bool:
    match effect:
        case Assignment():
            return True
        case Send(arguments=arguments, to=to, delay=delay):
            return bool(arguments) or to is not None or _is_not_literal(delay)
    return False


def _is_not_literal(delay: Expression | None) -> bool:
    return delay is not None and not isinstance(delay, Literal)


def _is_computed(trigger: Trigger) -> bool:
    return isinstance(trigger, TimeTrigger) and _is_not_literal(trigger.delay)


def initial_value(type_: Type, system: System) -> str:
    """Return ROS's default for the type of a variable without initial value."""
    return _written(default_value(type_, system))


def robot_alone() -> str:
    """Return the identity of a robot that nobody has named; the host may replace it."""
    return _written({"id": "", "role": "", "index": 0, "count": 1})


def _written(data: object) -> str:
    value = json.dumps(data)
    # An engine that evaluates the string as a program would read the brace as a block.
    return f"({value})" if value.startswith("{") else value
