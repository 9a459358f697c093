"""Strategies for expressions with inferred types."""

from __future__ import annotations

from collections.abc import Sequence

from hypothesis import strategies as st

from swarmdsl.codegen.shared.constants import (
    UndefinedValueError,
    UnknownValueError,
    constant,
    evaluate,
)
from swarmdsl.ir import Binary, Call, EventData, Expression, FieldAccess, Literal, Named, Unary
from swarmdsl.syntax.parser.literals import forbidden_character
from swarmdsl.syntax.types import (
    BOOL,
    DURATION,
    FLOAT,
    FLOATS,
    INT,
    INTEGERS,
    STRING,
    Array,
    Primitive,
    Type,
    with_unit,
)
from swarmdsl.syntax.units import RADIAN

INTEGER_TYPES = tuple(Primitive(name) for name in INTEGERS)
FLOAT_TYPES = tuple(Primitive(name) for name in FLOATS)

# What is at hand: names of variables and params, fields of the event.
Leaves = Sequence[Expression]

characters = st.characters(codec="utf-8").filter(lambda each: forbidden_character(each) is None)
texts = st.text(characters, max_size=6) | (
    st.sampled_from(
        ['"', "\\", "\n", "\t", "\r\n", "//", "/*", "\\n", "{", '\\"', "\\u2028", "\u2028"]
    )
)
wholes = st.integers(-100, 100) | st.integers(0, 2**63 - 1)
floats = {
    width: st.floats(allow_nan=False, allow_infinity=False, width=width) for width in (32, 64)
}
lengths = st.integers(0, 2**56) | st.sampled_from([1, 999, 1_000, 60_000_000_000, 2**53 + 1])

_RADIAN = Literal(1, with_unit(INT, RADIAN))


def literals(type_: Type) -> st.SearchStrategy[Expression]:
    """Return literals that are valid for a type."""
    if type_ == BOOL:
        return st.booleans().map(lambda value: Literal(value, BOOL))
    if type_ == STRING:
        return texts.map(lambda value: Literal(value, STRING))
    if type_ == DURATION:
        return lengths.map(lambda value: Literal(value, DURATION))
    if type_ in FLOAT_TYPES:
        return floats[32 if type_ == Primitive("float32") else 64].map(
            lambda value: Literal(value, FLOAT)
        ) | st.integers(-100, 100).map(lambda value: Literal(value, INT))
    return st.integers(0, 100).map(lambda value: Literal(value, INT))


def expressions(draw: st.DrawFn, type_: Type, leaves: Leaves, depth: int = 2) -> Expression | None:
    """Return expressions that are valid for a type; None if there is none."""
    made = _expression(draw, type_, leaves, depth)
    return made if made is None or _fits_in(made, type_) else draw(literals(type_))


def _fits_in(expression: Expression, type_: Type) -> bool:
    """Return True if the value of an expression, if known, is in range of a type."""
    try:
        value = evaluate(expression, {})
    except UnknownValueError:
        return True
    except UndefinedValueError:
        return False
    if type_ == DURATION:
        return abs(value) < 2**63 / 1e9
    if type_ == Primitive("float32"):
        return abs(value) < 1e38
    return type_ not in INTEGER_TYPES or type_ == INT or 0 <= value < 128


def _expression(draw: st.DrawFn, type_: Type, leaves: Leaves, depth: int) -> Expression | None:
    known = [leaf for leaf in leaves if _fits(leaf.type, type_)]
    if type_ not in (BOOL, STRING, DURATION, *INTEGER_TYPES, *FLOAT_TYPES):
        known = [leaf for leaf in leaves if leaf.type == type_]
        return draw(st.sampled_from(known)) if known else None
    if depth == 0 or draw(st.integers(0, 2)) == 0:
        if known and draw(st.booleans()):
            return draw(st.sampled_from(known))
        return draw(literals(type_))
    if type_ == BOOL:
        return _truth(draw, leaves, depth - 1)
    if type_ == STRING:
        return Binary("+", *_two(draw, STRING, leaves, depth), STRING)
    if type_ == DURATION:
        return _duration(draw, leaves, depth - 1)
    return _number(draw, type_, leaves, depth - 1)


def delay(draw: st.DrawFn, leaves: Leaves) -> Expression:
    """Return durations that are not negative."""
    known = [leaf for leaf in leaves if leaf.type == DURATION]
    time = draw(st.sampled_from(known)) if known and draw(st.booleans()) else None
    short = Literal(draw(st.integers(0, 10**15)), DURATION)
    time = time or short
    match draw(st.sampled_from(["", "+", "*", "/", "max", "/ +"])):
        case "+":
            return Binary("+", time, short, DURATION)
        case "*":
            return Binary("*", Literal(1.5, FLOAT), time, DURATION)
        case "/":
            return Binary("/", time, Literal(3, INT), DURATION)
        case "max":
            return Call("max", (time, short), DURATION)
        case "/ +":
            quarter = Binary("/", time, Literal(4, INT), DURATION)
            return Binary("+", short, quarter, DURATION)
    return time


def _two(draw: st.DrawFn, type_: Type, leaves: Leaves, depth: int) -> tuple[Expression, Expression]:
    left = expressions(draw, type_, leaves, depth - 1)
    right = expressions(draw, type_, leaves, depth - 1)
    assert left is not None
    assert right is not None
    return left, right


def _truth(draw: st.DrawFn, leaves: Leaves, depth: int) -> Expression:
    operator = draw(st.sampled_from(["and", "or", "not", "==", "!=", "<", "<=", ">", ">="]))
    if operator in ("and", "or"):
        return Binary(operator, *_two(draw, BOOL, leaves, depth + 1), BOOL)
    if operator == "not":
        operand = expressions(draw, BOOL, leaves, depth)
        assert operand is not None
        return Unary("not", operand, BOOL)
    kinds = [INT, FLOAT, DURATION] + ([STRING, BOOL] if operator in ("==", "!=") else [])
    return Binary(operator, *_two(draw, draw(st.sampled_from(kinds)), leaves, depth + 1), BOOL)


def _duration(draw: st.DrawFn, leaves: Leaves, depth: int) -> Expression:
    match draw(st.sampled_from(["+", "-", "*", "/", "min", "abs"])):
        case "*":
            number = expressions(draw, FLOAT, leaves, depth)
            length = expressions(draw, DURATION, leaves, depth)
            assert number is not None
            assert length is not None
            # No constant is longer than ROS can say: 2**31 s.
            small = Call(
                "max",
                (Call("min", (number, Literal(2.0, FLOAT)), FLOAT), Literal(0.0, FLOAT)),
                FLOAT,
            )
            return Binary("*", *draw(st.permutations([small, length])), DURATION)
        case "/":
            length = expressions(draw, DURATION, leaves, depth)
            assert length is not None
            return Binary("/", length, Literal(2, INT), DURATION)
        case "min":
            return Call("min", _two(draw, DURATION, leaves, depth + 1), DURATION)
        case "abs":
            length = expressions(draw, DURATION, leaves, depth)
            assert length is not None
            return Call("abs", (length,), DURATION)
        case operator:
            return Binary(operator, *_two(draw, DURATION, leaves, depth + 1), DURATION)


def _number(draw: st.DrawFn, type_: Type, leaves: Leaves, depth: int) -> Expression:
    """Return numbers; integers unless the type is real."""
    operators = ["+", "-", "*", "%", "negative", "abs", "max", "len", "clamp", "rounded"]
    operators += ["/", "sqrt", "per", "wave", "hypot"] if type_ in FLOAT_TYPES else ["div"]
    operator = draw(st.sampled_from(operators))
    match operator:
        case "len":
            lists = [leaf for leaf in leaves if leaf.type == STRING or isinstance(leaf.type, Array)]
            text = draw(st.sampled_from(lists)) if lists else Literal("", STRING)
            return Call("len", (text,), INT)
        case "per":
            length, unit = _two(draw, DURATION, leaves, depth + 1)
            if constant(unit, {}) == 0:
                unit = Literal(1, DURATION)
            return Binary("/", length, unit, FLOAT)
        case "clamp":
            values = [expressions(draw, type_, leaves, depth) for _ in range(3)]
            known = [value for value in values if value is not None]
            return Call("clamp", tuple(known), _widest(*known))
        case "rounded":
            words = ["int", "round", "floor", "ceil"]
            if type_ in FLOAT_TYPES:
                words.append("float")
            word = draw(st.sampled_from(words))
            number = expressions(draw, FLOAT if depth else INT, leaves, 0)
            assert number is not None
            return Call(word, (number,), FLOAT if word == "float" else INT)
        case "wave":
            number = expressions(draw, FLOAT, leaves, depth)
            assert number is not None
            angle = Binary("*", number, _RADIAN, with_unit(number.type, RADIAN))
            return Call(draw(st.sampled_from(["sin", "cos"])), (angle,), FLOAT)
        case "hypot":
            word = draw(st.sampled_from(["hypot", "atan2"]))
            call = Call(word, _two(draw, FLOAT, leaves, depth + 1), FLOAT)
            return call if word == "hypot" else Binary("/", call, _RADIAN, FLOAT)
        case "div":
            left, divisor = expressions(draw, type_, leaves, depth), draw(st.integers(1, 9))
            assert left is not None
            return Call("div", (left, Literal(divisor, INT)), INT)
        case "negative" | "abs" | "sqrt":
            operand = expressions(draw, type_, leaves, depth)
            assert operand is not None
            if operator == "sqrt":
                return Call("sqrt", (operand,), FLOAT)
            if operator == "abs":
                return Call("abs", (operand,), _widest(operand))
            if isinstance(operand, Literal):  # a negative number is one, too
                return operand
            return Unary("-", operand, operand.type)
        case "%" | "/":
            left = expressions(draw, type_, leaves, depth)
            assert left is not None
            right = Literal(draw(st.integers(1, 9)), INT)
            return Binary(operator, left, right, FLOAT if operator == "/" else _widest(left))
    pair = _two(draw, type_, leaves, depth + 1)
    if operator == "max":
        return Call("max", pair, _widest(*pair))
    return Binary(operator, *pair, _widest(*pair))


def _widest(*operands: Expression) -> Type:
    return FLOAT if any(each.type in FLOAT_TYPES for each in operands) else INT


def _fits(found: Type | None, wanted: Type) -> bool:
    if wanted in FLOAT_TYPES:
        return found in FLOAT_TYPES or found in INTEGER_TYPES
    if wanted in INTEGER_TYPES:
        return found in INTEGER_TYPES
    return found == wanted


def event_leaves(message: Named, fields: Sequence[tuple[str, Type]]) -> list[Expression]:
    """Return the fields of the triggering event's message."""
    data = EventData(message)
    return [data, *(FieldAccess(data, name, type_) for name, type_ in fields)]
