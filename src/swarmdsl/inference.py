"""Types of expressions.

A type that cannot be known (a field of a message the model does not describe, a name that
was not resolved) is None and fits everywhere: one mistake is reported once.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, field

from swarmdsl.diagnostics import Diagnostics, listed
from swarmdsl.interfaces import Interfaces
from swarmdsl.ir.types import (
    BOOL,
    DURATION,
    FLOAT,
    FLOATS,
    INT,
    INTEGERS,
    STRING,
    Array,
    Named,
    Primitive,
    Type,
)
from swarmdsl.scopes import report_unresolved
from swarmdsl.source import Span
from swarmdsl.suggest import did_you_mean
from swarmdsl.syntax import (
    Call,
    Constant,
    EnumType,
    ExpressionTree,
    Field,
    FieldUse,
    FitnessInput,
    NameUse,
    OperatorUse,
    Param,
    Parameter,
    Value,
    Variable,
    Word,
)

_NUMBERS = {*INTEGERS, *FLOATS, "byte", "char"}
_FUNCTIONS = {"min": 2, "max": 2, "abs": 1, "sqrt": 1, "len": 1}


@dataclass(frozen=True)
class Typing:
    """Infers types; `interfaces` say which fields messages have.

    `event` is the type of the triggering event's message: absent where no event is at
    hand (`has_event` False), None where it is not known.
    """

    interfaces: Interfaces
    report: Diagnostics = field(default_factory=Diagnostics)
    has_event: bool = False
    event: Type | None = None

    def infer(self, tree: ExpressionTree) -> Type | None:
        """The type of an expression; what is wrong in it is reported."""
        match tree:
            case Value(value=value, unit=unit):
                return _value_type(value, unit)
            case NameUse(name="event"):
                if not self.has_event:
                    self.report.report(
                        "no-event-data",
                        tree.span,
                        help="use it in a guard or effect of a transition on one event",
                    )
                return self.event
            case NameUse(target=EnumType() as enum):
                self.report.report(
                    "bad-operand",
                    tree.span,
                    operator=enum.name,
                    operands="its own: name one of its values",
                    help=f"write `{enum.name}.{enum.values[0].name}`" if enum.values else None,
                )
                return None
            case NameUse(target=None):
                return None
            case NameUse(target=Variable() | Param() | Constant() | FitnessInput() as value):
                return value.type.type
            case FieldUse(base=NameUse(target=EnumType() as enum), name=name):
                return self._enum_value(enum, name)
            case FieldUse(base=base, name=name):
                return self.field(self.infer(base), name, name.span)
            case Call(arguments=operands) | OperatorUse(operands=operands):
                return self.result(tree, [self.infer(operand) for operand in operands])
        raise AssertionError(tree)

    def result(self, tree: Call | OperatorUse, types: list[Type | None]) -> Type | None:
        """The type of an operation on operands of these types."""
        if isinstance(tree, Call):
            return self._call(tree, types)
        if len(types) == 1:
            return self._unary(tree, types[0])
        left, right = types
        return self._binary(tree, left, right)

    def expect(self, tree: ExpressionTree | None, wanted: Type | None) -> None:
        """Report an expression whose value cannot be used as a `wanted`."""
        if tree is None:
            return
        found = self.infer(tree)
        number, possible = _whole_number(tree), _range(wanted)
        if number is not None and possible is not None and number not in possible:
            self.report.report(
                "type-mismatch",
                tree.span,
                expected=f"`{wanted}`",
                found=f"`{number}`",
                help=f"it is a number from {possible[0]} to {possible[-1]}",
            )
        elif not fits(found, wanted):
            help_ = None
            if wanted == DURATION and isinstance(tree, Value) and is_number(found):
                help_ = f"give it a unit: `{tree.span.text} s`"
            self.report.report(
                "type-mismatch", tree.span, expected=f"`{wanted}`", found=f"`{found}`", help=help_
            )

    def field(self, owner: Type | None, name: str, at: Span) -> Type | None:
        """The type of a field of a message."""
        if isinstance(owner, Named):
            fields = self.interfaces.fields(owner)
            if fields is None:
                return None
            found = next((known for known in fields if known.name == name), None)
            if found is not None:
                return found.type.type
            report_unknown_field(f"`{owner}`", name, at, fields, self.report)
        elif owner is not None:
            self.report.report("unknown-field", at, owner=f"a value of type `{owner}`", name=name)
        return None

    def _is_enum(self, type_: Named) -> bool:
        return isinstance(self.interfaces.get(type_), EnumType)

    def _enum_value(self, enum: EnumType, name: Word) -> Type | None:
        values = [str(value.name) for value in enum.values]
        if str(name) not in values:
            report_unresolved(
                f"value of enum `{enum.name}`", name, name.span, values, None, self.report
            )
            return None
        return enum.type

    def _call(self, call: Call, types: list[Type | None]) -> Type | None:
        count = _FUNCTIONS.get(call.function)
        if count is None:
            report_unresolved(
                "built-in function",
                call.function,
                call.function.span,
                _FUNCTIONS,
                None,
                self.report,
            )
            return None
        enough = len(types) >= count if call.function in ("min", "max") else len(types) == count
        if not enough:
            self.report.report(
                "bad-operand",
                call.span,
                operator=call.function,
                operands=f"{len(types)} value{'s' * (len(types) != 1)}: it takes {count}"
                + (" or more" if call.function in ("min", "max") else ""),
            )
            return None
        if call.function == "len":
            self._require(call, call.function, types, lambda t: is_text(t) or isinstance(t, Array))
            return INT
        if call.function == "sqrt":
            self._require(call, call.function, types, is_number)
            return FLOAT
        if _all_durations(types):
            return DURATION
        fine = self._require(call, call.function, types, is_number)
        return _widest(types) if fine else None

    def _unary(self, tree: OperatorUse, operand: Type | None) -> Type | None:
        if tree.operator == "not":
            self._require(tree, "not", [operand], lambda t: t == BOOL)
            return BOOL
        fine = self._require(tree, "-", [operand], lambda t: is_number(t) or t == DURATION)
        return operand if fine else None

    def _binary(self, tree: OperatorUse, left: Type | None, right: Type | None) -> Type | None:
        operator, types = str(tree.operator), [left, right]
        if operator in ("/", "%") and _whole_number(tree.operands[1]) == 0:
            self.report.report("bad-operand", tree.span, operator=operator, operands="0")
        if operator in ("and", "or"):
            self._require(tree, operator, types, lambda t: t == BOOL)
            return BOOL
        if operator in ("==", "!="):
            compared = any(isinstance(known, (Named, Array)) for known in types)
            enums = left == right and isinstance(left, Named) and self._is_enum(left)
            unfit = (compared and not enums) or not (fits(left, right) or fits(right, left))
            if None not in types and unfit:
                self._bad_operands(tree, operator, types)
            return BOOL
        if operator in ("<", "<=", ">", ">="):
            if not _all_durations(types):
                self._require(tree, operator, types, is_number)
            return BOOL
        if None in types:
            return None
        if operator in ("+", "-") and _all_durations(types):
            return DURATION
        if operator == "+" and is_text(left) and is_text(right):
            return STRING
        if operator in ("*", "/") and left == DURATION and is_number(right):
            return DURATION
        if operator == "*" and is_number(left) and right == DURATION:
            return DURATION
        if operator == "/" and _all_durations(types):
            return FLOAT
        if not self._require(tree, operator, types, is_number):
            return None
        return FLOAT if operator == "/" else _widest(types)

    def _require(
        self,
        tree: ExpressionTree,
        operator: str,
        types: list[Type | None],
        test: Callable[[Type], bool],
    ) -> bool:
        """Report operands that are not of the right type; return whether all are."""
        fine = all(known is None or test(known) for known in types)
        if not fine:
            self._bad_operands(tree, operator, types)
        return fine

    def _bad_operands(self, tree: ExpressionTree, operator: str, types: list[Type | None]) -> None:
        names = [str(known) for known in types if known is not None]
        self.report.report(
            "bad-operand", tree.span, operator=operator, operands=listed(names, "and")
        )


def report_unknown_field(
    owner: str, name: str, at: Span, fields: Sequence[Field | Parameter], report: Diagnostics
) -> None:
    """Report a field that a message does not have, with those it has."""
    names = [str(known.name) for known in fields]
    has = f"it has {listed(names, 'and')}" if names else "it has no fields"
    help_ = did_you_mean(name, names) or has
    report.report("unknown-field", at, owner=owner, name=name, help=help_)


def fits(found: Type | None, wanted: Type | None) -> bool:
    """Whether a value of one type can be used where the other is wanted."""
    if found is None or wanted is None or found == wanted:
        return True
    if isinstance(found, Array) and isinstance(wanted, Array):
        if wanted.size is None or (wanted.bounded and found.size is not None):
            enough = wanted.size is None or (found.size or 0) <= wanted.size
        else:
            enough = wanted.size == found.size and not found.bounded
        return enough and fits(found.element, wanted.element)
    if isinstance(found, Primitive) and isinstance(wanted, Primitive) and found.name == wanted.name:
        return True  # texts of different bounds
    if is_number(found) and is_number(wanted):
        return wanted in _FLOAT_TYPES or found not in _FLOAT_TYPES
    return False


def constant(tree: ExpressionTree) -> bool:
    """Whether the value is known without running anything, as far as its names mean something."""
    match tree:
        case NameUse(name="event"):
            return False
        case Value() | NameUse(target=Constant() | EnumType() | None):
            return True
        case FieldUse(base=base):
            return constant(base)
        case OperatorUse(operands=operands):
            return all(constant(operand) for operand in operands)
        case Call(arguments=arguments):
            return all(constant(argument) for argument in arguments)
    return False


def assignable(tree: ExpressionTree) -> bool:
    """Whether it names a variable or a field of one."""
    match tree:
        case NameUse(target=target):
            return isinstance(target, Variable) or (target is None and tree.name != "event")
        case FieldUse(base=base):
            return assignable(base)
    return False


def is_text(type_: Type | None) -> bool:
    """Whether it is a text, of whatever length."""
    return isinstance(type_, Primitive) and type_.name in ("string", "wstring")


def is_number(type_: Type | None) -> bool:
    """Whether it is an integer or floating-point type."""
    return isinstance(type_, Primitive) and type_.name in _NUMBERS


_FLOAT_TYPES = tuple(Primitive(name) for name in FLOATS)


def _whole_number(tree: ExpressionTree) -> int | None:
    """The value of an integer that is written out."""
    sign = 1
    if isinstance(tree, OperatorUse) and tree.operator == "-" and len(tree.operands) == 1:
        sign, tree = -1, tree.operands[0]
    if isinstance(tree, Value) and type(tree.value) is int and not tree.unit:
        return sign * tree.value
    return None


def _range(type_: Type | None) -> range | None:
    """The numbers that an integer type can hold; None for other types."""
    if not isinstance(type_, Primitive) or type_.name not in INTEGERS:
        return None
    bits = int(type_.name.lstrip("uint"))
    return (
        range(2**bits) if type_.name.startswith("u") else range(-(2 ** (bits - 1)), 2 ** (bits - 1))
    )


def _value_type(value: bool | int | float | str, unit: str) -> Type:
    if unit:
        return DURATION
    match value:
        case bool():
            return BOOL
        case int():
            return INT
        case float():
            return FLOAT
    return STRING


def _all_durations(types: list[Type | None]) -> bool:
    return all(known in (DURATION, None) for known in types) and DURATION in types


def _widest(types: list[Type | None]) -> Type | None:
    if None in types:
        return None
    return FLOAT if any(known in _FLOAT_TYPES for known in types) else INT
