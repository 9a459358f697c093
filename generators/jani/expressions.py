"""Expressions of JANI, as the objects that stand for them in JSON."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from functools import reduce
from typing import Any

from swarmdsl.execution.verify.composition import Combined, Reading

_AND, _OR = "∧", "\N{LOGICAL OR}"

Expression = Any
"""Name, number, truth value, or object with an operator."""


def binary(operator: str, left: Expression, right: Expression) -> Expression:
    """Return an expression of two operands."""
    return {"op": operator, "left": left, "right": right}


def negated(operand: Expression) -> Expression:
    """Return the opposite of a condition."""
    return {"op": "¬", "exp": operand}


def all_of(conditions: Iterable[Expression]) -> Expression:
    """Return the condition that all of some conditions hold."""
    return _joined(_AND, list(conditions), nothing=True)


def either(condition: Expression, yes: Expression, no: Expression) -> Expression:
    """Return the value of one expression or of another one."""
    return {"op": "ite", "if": condition, "then": yes, "else": no}


def total(numbers: Sequence[Expression]) -> Expression:
    """Return the sum of numbers."""
    return _joined("+", numbers, nothing=0)


def increased(name: str, difference: int) -> Expression:
    """Return a variable with a number added to it."""
    return binary("+" if difference > 0 else "-", name, abs(difference))


def claim(reading: Reading) -> Expression:
    """Return a claim as a condition on numbers of robots.

    `count_1` is the number of robots for which term 1 holds, and `my_count_1` is 1 if it holds for
    the robot of the property.
    """
    if isinstance(reading, Combined):
        parts = [claim(each) for each in reading.parts]
        if reading.operator == "not":
            return negated(parts[0])
        return _joined(_AND if reading.operator == "and" else _OR, parts, nothing=True)
    number: Expression = f"count_{reading.term}"
    if reading.whose == "me":
        number = f"my_{number}"
    elif reading.whose == "others":
        number = binary("-", number, f"my_{number}")
    if reading.least == reading.most:
        return binary("=", number, reading.least)
    limits = [binary("≤", reading.least, number)] if reading.least > 0 else []
    if reading.most is not None:
        limits.append(binary("≤", number, reading.most))
    return all_of(limits)


def _joined(operator: str, parts: Sequence[Expression], *, nothing: Expression) -> Expression:
    return reduce(lambda left, right: binary(operator, left, right), parts) if parts else nothing
