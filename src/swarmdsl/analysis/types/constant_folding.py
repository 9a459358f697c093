"""Constant folding: values of expressions that are known at compile time."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from typing import Any

from swarmdsl.analysis.types.enum_values import numbers
from swarmdsl.analysis.types.unit_rules import (
    has_dimension,
    in_seconds,
    literal_type,
    result_unit,
    takes_seconds,
)
from swarmdsl.base.graphs import leaves_first
from swarmdsl.ir.operations import OPERATIONS, SECOND
from swarmdsl.syntax.ast import (
    Call,
    Constant,
    EnumType,
    ExpressionTree,
    FieldUse,
    InState,
    NameUse,
    OperatorUse,
    Value,
    walk,
)
from swarmdsl.syntax.parser.literals import nanoseconds
from swarmdsl.syntax.types import DURATION, FLOAT, Type, unit_of, with_unit
from swarmdsl.syntax.units import DURATIONS, UNITS, in_unit_of_ros

Folded = bool | int | float | str

_ALWAYS_DEFINED = frozenset(("and", "or", "not", "==", "!=", "<", "<=", ">", ">="))
# Values of 64 bits: an `int64` or a `uint64`, and a duration in nanoseconds.
_WHOLE, _LENGTHS = range(-(2**63), 2**64), range(-(2**63), 2**63)

MOST_CHARACTERS = 1 << 16
"""The longest string that an expression with constants makes."""
_MOST_TOGETHER = 1 << 24


class _UndefinedError(Exception):
    """An operation on known operands has no result that any target can hold."""


class Folding:
    """Values of expressions, each computed once: the trees no longer change."""

    def __init__(self) -> None:
        self._known: dict[ExpressionTree, Folded | Exception | None] = {}
        self._constants: dict[Constant, Folded | None] = {}
        self._numbers: dict[EnumType, Mapping[str, int]] = {}
        # Characters of all strings that were made: a model could double a string in each line.
        self._characters = 0

    def value(self, tree: ExpressionTree) -> Folded | None:
        """Return the value of an expression, durations in nanoseconds; None if it is unknown.

        One operand can decide `and` and `or`. An expression without a value (a division by zero)
        is None too: `undefined` returns the reason.
        """
        try:
            return self._fold(tree)
        except (_UndefinedError, TypeError):
            return None

    def numbers(self, enum: EnumType) -> Mapping[str, int]:
        """Return the number of each value of an enum."""
        found = self._numbers.get(enum)
        if found is None:
            found = self._numbers[enum] = numbers(enum)
        return found

    def constant(self, constant: Constant) -> Folded | None:
        """Return the value of a constant, which may depend on other constants."""
        if constant not in self._constants:
            for each in leaves_first([constant], self._needed):
                tree = each.value.tree
                value = self.value(tree) if tree is not None else None
                if (
                    isinstance(value, int)
                    and has_dimension(unit_of(each.type.type))
                    and tree is not None
                    and self._measure(tree) == DURATION
                ):
                    value = value / SECOND
                self._constants[each] = value
        return self._constants[constant]

    def _needed(self, constant: Constant) -> list[Constant]:
        """Constants in the value of a constant that are not computed yet."""
        tree = constant.value.tree
        return [
            node.target
            for node in (walk(tree) if tree is not None else ())
            if isinstance(node, NameUse)
            and isinstance(node.target, Constant)
            and node.target not in self._constants
        ]

    def undefined(self, tree: Call | OperatorUse, *, duration: bool = False) -> str | None:
        """Return the reason why an operation has no result for any values of its operands.

        Return None if it has one, and for an operand without a value. `duration` is True if the
        result is a duration.
        """
        word = str(tree.function if isinstance(tree, Call) else tree.operator)
        if word in _ALWAYS_DEFINED or word not in OPERATIONS:
            return None
        operands = tree.arguments if isinstance(tree, Call) else tree.operands
        values = [self.value(operand) for operand in operands]
        if word in ("/", "%", "div") and values and _is_zero(values[-1]):
            return "the divisor is 0"
        if None in values:
            return None
        try:
            negation = (word, len(values)) == ("-", 1)
            converted = self._converted(word, operands, values)
            result = _negative(values[0]) if negation else _apply(word, converted)
            if result is not None:
                self._check_room(result)
        except _UndefinedError as error:
            return str(error)
        except TypeError:
            return None
        if duration and isinstance(result, (int, float)) and round(result) not in _LENGTHS:
            return "it would be longer than 292 years"
        return None

    def _fold(self, tree: ExpressionTree) -> Folded | None:
        """Return the value like `value`; raise an error for an operation without a result."""
        match tree:
            case NameUse():
                return self.constant(tree.target) if isinstance(tree.target, Constant) else None
            case Value(unit=""):
                return tree.value
            case FieldUse(base=base):
                enum = base.target if isinstance(base, NameUse) else None
                return self.numbers(enum).get(tree.name) if isinstance(enum, EnumType) else None
        if tree not in self._known:
            try:
                self._known[tree] = self._computed(tree)
            except (_UndefinedError, TypeError) as error:
                self._known[tree] = error
        found = self._known[tree]
        if isinstance(found, Exception):
            raise found
        return found

    def _computed(self, tree: ExpressionTree) -> Folded | None:
        match tree:
            case OperatorUse(operator=word, operands=(operand,)):
                known = self._fold(operand)
                if word == "not":
                    return None if known is None else not known
                return _negative(known)
            case OperatorUse(operator=word, operands=operands):
                if word in ("and", "or"):
                    return self._logic(word == "or", operands)
                return self._applied(word, operands)
            case Call(function=function, arguments=arguments):
                return self._applied(function, arguments) if function in OPERATIONS else None
            case InState(known=known):
                return known
            case Value(unit=unit) if unit in DURATIONS:
                return nanoseconds(tree.span.text, unit)
            case Value(unit=unit):
                return in_unit_of_ros(tree.span.text.removesuffix(unit).rstrip(), UNITS[unit])
        return None  # arrays and messages are not constant

    def _converted(
        self, word: str, operands: Sequence[ExpressionTree], values: list[Any]
    ) -> list[Any]:
        """Return the values of operands, durations in seconds where the operation takes them so."""
        types = [self._measure(operand) for operand in operands]
        if not takes_seconds(word, types):
            return values
        return [
            value / SECOND if type_ == DURATION else value
            for value, type_ in zip(values, types, strict=True)
        ]

    def _measure(self, tree: ExpressionTree) -> Type | None:
        """Return the type of a constant that is a number or a duration, without checks."""
        match tree:
            case Value(unit=unit, value=int() | float() as value) if not isinstance(value, bool):
                return literal_type(value, unit) if unit else FLOAT
            case NameUse(target=Constant() as constant):
                return constant.type.type
            case (
                OperatorUse(operator=word, operands=operands)
                | Call(function=word, arguments=operands)
            ):
                types = in_seconds(word, [self._measure(each) for each in operands])
                is_number = word in ("seconds", *_ALWAYS_DEFINED) or (
                    word == "/" and types[-1] == DURATION
                )
                if DURATION in types and not is_number:
                    return DURATION
                return with_unit(FLOAT, result_unit(word, types))
        return None

    def _applied(self, word: str, operands: tuple[ExpressionTree, ...]) -> Folded | None:
        values = [self._fold(operand) for operand in operands]
        if None in values:
            return None
        result = _apply(word, self._converted(word, operands, values))
        if isinstance(result, str):
            self._characters += len(result)
            self._check_room(result)
        return result

    def _check_room(self, result: Folded) -> None:
        if isinstance(result, str) and self._characters > _MOST_TOGETHER:
            raise _UndefinedError(f"all strings would be longer than {_MOST_TOGETHER} characters")

    def _logic(self, decisive: bool, operands: tuple[ExpressionTree, ...]) -> Folded | None:
        values = [self._fold(operand) for operand in operands]
        if any(value is decisive for value in values):
            return decisive
        return None if None in values else not decisive


def _apply(word: str, values: list[Any]) -> Folded:
    try:
        result = OPERATIONS[word](*values)
    except ZeroDivisionError:
        raise _UndefinedError("the divisor is 0") from None
    except OverflowError:
        raise _UndefinedError("it would be too large for a `float64`") from None
    except ValueError:
        raise _UndefinedError(f"{values[0]} has no square root") from None
    return _checked(result)


def _negative(value: Folded | None) -> Folded | None:
    return _checked(-value) if isinstance(value, (int, float)) else None


def _checked(result: Folded) -> Folded:
    """Return a result that fits in 64 bits; raise an error for any other."""
    if isinstance(result, float) and not math.isfinite(result):
        raise _UndefinedError("it would be too large for a `float64`")
    if isinstance(result, int) and result not in _WHOLE:
        raise _UndefinedError("it does not fit in 64 bits")
    if isinstance(result, str) and len(result) > MOST_CHARACTERS:
        raise _UndefinedError(f"it would be longer than {MOST_CHARACTERS} characters")
    return result


def _is_zero(value: Folded | None) -> bool:
    return isinstance(value, (int, float)) and not isinstance(value, bool) and value == 0
