"""Expressions and first values in ECMAScript, the data model of portable documents."""

from __future__ import annotations

import json
import re
from collections.abc import Mapping, Sequence

from swarmdsl.codegen.exchange.scxml.effects import effects_of
from swarmdsl.codegen.shared.default_values import default_value
from swarmdsl.ir import (
    Assignment,
    EventData,
    Expression,
    FieldAccess,
    Literal,
    ParamRef,
    Primitive,
    StateMachine,
    System,
    TimeTrigger,
    Trigger,
    Type,
    VariableRef,
)
from swarmdsl.ir.expression_printer import Dialect, ecmascript_literal, translate


def dialect(data: Mapping[str, str]) -> Dialect:
    """How expressions are written where variables and params have the `<data>` ids of `data`."""
    return Dialect(
        literal=ecmascript_literal,
        variable=data.__getitem__,
        param=data.__getitem__,
        event="_event.data",
        operators={"and": "&&", "or": "||", "not": "!"},
        functions={
            "sqrt": _root,
            "min": "Math.min",
            "max": "Math.max",
            "abs": "Math.abs",
            "len": ".length",
        },
        modulo=_modulo,
        quotient=_quotient,
    )


# What ECMAScript has `Infinity` or `NaN` for has no value in the language: it is an error.
_NO_VALUE = "null.value"


def _quotient(left: str, right: str) -> str:
    if _is_number(right):
        return f"{left} / {right}"
    return f"(function (a, b) {{ return b != 0 ? a / b : {_NO_VALUE}; }})({left}, {right})"


def _modulo(left: str, right: str) -> str:
    """The remainder with the sign of the divisor; that of `%` has the sign of the dividend."""
    if _is_number(right):
        return f"(({left} % {right}) + {right}) % {right}"
    result = f"b != 0 ? ((a % b) + b) % b : {_NO_VALUE}"
    return f"(function (a, b) {{ return {result}; }})({left}, {right})"


def _root(values: Sequence[str]) -> str:
    (value,) = values
    if _is_number(value):
        return f"Math.sqrt({value})"
    return f"(function (a) {{ return a >= 0 ? Math.sqrt(a) : {_NO_VALUE}; }})({value})"


def _is_number(text: str) -> bool:
    """Whether it is a literal above 0: a model in which one is 0 or less there is an error."""
    return re.fullmatch(r"[0-9.]+(e[-+]?[0-9]+)?", text) is not None


def stored(expression: Expression, words: Dialect) -> str:
    """A value that is assigned or sent: of a message or an array, a copy, as ROS has it."""
    text = translate(expression, words)
    kept = isinstance(expression, (VariableRef, ParamRef, EventData, FieldAccess))
    if kept and not isinstance(expression.type, Primitive):
        return f"JSON.parse(JSON.stringify({text}))"
    return text


def needs_data(machine: StateMachine) -> bool:
    """Whether the machine is more than SCXML's null data model can say."""
    if machine.variables or machine.params:
        return True
    if any(isinstance(effect, Assignment) or effect.arguments for effect in effects_of(machine)):
        return True
    return any(
        transition.guard is not None or any(map(_is_computed, transition.triggers))
        for state in machine.walk()
        for transition in state.transitions
    )


def _is_computed(trigger: Trigger) -> bool:
    return isinstance(trigger, TimeTrigger) and not isinstance(trigger.delay, Literal)


def first_value(type_: Type, system: System) -> str:
    """The value of a variable to which the model gives none: ROS's default for its type."""
    value = json.dumps(default_value(type_, system))
    # An engine that evaluates the text as a program would take the brace for a block.
    return f"({value})" if value.startswith("{") else value
