"""Expressions in the language of a target.

One printer serves all targets: a `Dialect` defines operators, names and literals.
Parentheses follow the target's own precedence, and are added wherever comparisons or signs
meet, so that the output never depends on fine points of the target's grammar.
"""

from __future__ import annotations

import builtins
import json
import keyword
from collections.abc import Callable, Mapping, Sequence

from swarmdsl.base.records import dataclass
from swarmdsl.ir import (
    Binary,
    Call,
    Construction,
    Elapsed,
    EnvelopeField,
    EventData,
    Expression,
    FieldAccess,
    InState,
    ItemRef,
    Literal,
    ParamRef,
    Query,
    SelfField,
    Unary,
    VariableRef,
)
from swarmdsl.syntax.types import DURATION

_PRECEDENCE = {
    "or": 1,
    "and": 2,
    "not": 3,
    **dict.fromkeys(("==", "!=", "<", "<=", ">", ">="), 4),
    **dict.fromkeys(("+", "-"), 5),
    **dict.fromkeys(("*", "/", "%"), 6),
    "negative": 7,
}
_PRIMARY = 8


Printer = Callable[[Expression], str]


def model_query(query: Query, text: Printer) -> str:
    """Return a query as in the model."""
    clauses = "".join(
        f" {word} {text(part)}"
        for word, part in (("where", query.condition), ("by", query.key))
        if part is not None
    )
    return f"{query.function}({query.item} in {text(query.array)}{clauses})"


def model_construction(made: Construction, text: Printer) -> str:
    """Return a new message as in the model."""
    values = ", ".join(f"{name} = {text(value)}" for name, value in made.values)
    return f"{made.type.name}({values})"


MODEL_FUNCTIONS: Mapping[str, Callable[[Sequence[str]], str]] = {
    "item": lambda values: "{}[{}]".format(*values),
    "neighbors": lambda values: f"neighbors within {values[0]}",
    "present": lambda values: f"present({values[0][1:-1] if values else ''})",
}
"""Built-in functions that the model does not write as calls."""


@dataclass(frozen=True)
class Dialect:
    """Notation of expressions in one target.

    `operators` renames those that the target spells otherwise; `literal`, `variable` and
    `param` print a leaf; `event` is the message of the triggering event, `envelope` prints a
    fact about that event, `identity` a field of `self`; `functions` renames the built-in
    functions, to `.name` if the target has a property instead, or prints a call from its
    arguments. `item` prints the name of an item in a query, `query` and `construction` print these
    with a printer of their parts, `in_state` the test of a state from its id, `elapsed` the time in
    it. `modulo` prints `%`, whose result has the sign of the divisor in the language; `quotient`
    prints `/`, the division of real numbers; `division` prints `div`, the division of integers, if
    the target has an operator for it. `seconds` prints a call of that function; without it, it is
    the division that it means.
    """

    literal: Callable[[Literal], str]
    variable: Callable[[str], str]
    param: Callable[[str], str]
    event: str
    envelope: Callable[[EnvelopeField], str]
    identity: Callable[[str], str]
    operators: Mapping[str, str]
    functions: Mapping[str, str | Callable[[Sequence[str]], str]]
    item: Callable[[str], str] = str
    query: Callable[[Query, Printer], str] = model_query
    in_state: Callable[[str], str] = "in({})".format
    elapsed: Callable[[str], str] = "elapsed({})".format
    construction: Callable[[Construction, Printer], str] = model_construction
    modulo: Callable[[str, str], str] = "{} % {}".format
    quotient: Callable[[str, str], str] = "{} / {}".format
    division: Callable[[str, str], str] | None = None
    seconds: Callable[[str], str] | None = None


def envelope_name(fact: EnvelopeField) -> str:
    """Return a fact about the event as in the model."""
    return f"event.{fact.field}"


def translate(expression: Expression, dialect: Dialect) -> str:
    """Return the expression in the notation of the target."""
    return _print(expression, dialect)[0]


def _print(expression: Expression, dialect: Dialect) -> tuple[str, int]:
    """Return the string and its binding strength."""
    match expression:
        case Literal():
            text = dialect.literal(expression)
            return text, _PRECEDENCE["negative"] if text.startswith("-") else _PRIMARY
        case VariableRef(name=name):
            return dialect.variable(name), _PRIMARY
        case ParamRef(name=name):
            return dialect.param(name), _PRIMARY
        case EventData():
            return dialect.event, _PRIMARY
        case EnvelopeField():
            return dialect.envelope(expression), _PRIMARY
        case SelfField(field=field):
            return dialect.identity(field), _PRIMARY
        case FieldAccess(base=base, field=field):
            return f"{_operand(base, _PRIMARY, dialect)}.{field}", _PRIMARY
        case ItemRef(name=name):
            return dialect.item(name), _PRIMARY
        case Query():
            return dialect.query(expression, lambda part: translate(part, dialect)), _PRIMARY
        case InState(state=state):
            return dialect.in_state(state), _PRIMARY
        case Elapsed(state=state):
            return dialect.elapsed(state), _PRIMARY
        case Construction():
            return dialect.construction(expression, lambda part: translate(part, dialect)), _PRIMARY
        case Call(function="div", arguments=(left, right)) if dialect.division is not None:
            level = _PRECEDENCE["/"]
            first, second = _operand(left, level, dialect), _operand(right, level + 1, dialect)
            return dialect.division(first, second), level
        case Call(function=function, arguments=arguments):
            written = dialect.functions.get(function, function)
            if isinstance(written, str) and written.startswith("."):
                return f"{_operand(arguments[0], _PRIMARY, dialect)}{written}", _PRIMARY
            # Only the distance in `neighbors within distance` has no parentheses of its own.
            least = _PRIMARY if function == "neighbors" else 0
            values = [_operand(argument, least, dialect) for argument in arguments]
            if not isinstance(written, str):
                return written(values), _PRIMARY
            return f"{written}({', '.join(values)})", _PRIMARY
        case Unary(operator="not", operand=Call(function=function, arguments=arguments)) if (
            callable(negated := dialect.functions.get(f"not {function}"))
        ):
            return negated([_operand(each, 0, dialect) for each in arguments]), _PRIMARY
        case Unary(operator="not", operand=operand):
            level = _PRECEDENCE["not"]
            word = dialect.operators.get("not", "not ")
            # `!` binds tighter than a comparison, `not ` looser: parentheses suit both.
            return f"{word}{_operand(operand, _PRIMARY, dialect)}", level
        case Unary(operand=operand):
            return f"-{_operand(operand, _PRIMARY, dialect)}", _PRECEDENCE["negative"]
        case Binary(left=left, conversion="implied") if dialect.seconds is not None:
            return _print(left, dialect)
        case Binary(left=left, conversion="seconds") if dialect.seconds is not None:
            return dialect.seconds(translate(left, dialect)), _PRIMARY
        case Binary(operator=operator, left=left, right=right):
            level = _PRECEDENCE[operator]
            comparison = level == _PRECEDENCE["=="]
            first = _operand(left, level + 1 if comparison else level, dialect)
            second = _operand(right, level + 1, dialect)
            if operator == "%":
                return dialect.modulo(first, second), level
            if operator == "/":
                return dialect.quotient(first, second), level
            return f"{first} {dialect.operators.get(operator, operator)} {second}", level


def _operand(expression: Expression, least: int, dialect: Dialect) -> str:
    text, level = _print(expression, dialect)
    return text if level >= least else f"({text})"


def points(coordinates: Sequence[str]) -> tuple[str, str, Sequence[str]]:
    """Return the two points of a distance, and the names of their coordinates."""
    count = len(coordinates) // 2
    first, second = (coordinates[at].removesuffix(".x") for at in (0, count))
    return first, second, "xyz"[:count]


def differences(coordinates: Sequence[str]) -> str:
    """Return the differences of the coordinates of two points, separated by commas."""
    count = len(coordinates) // 2
    pairs = zip(coordinates[:count], coordinates[count:], strict=True)
    return ", ".join(f"{first} - {second}" for first, second in pairs)


_OF_MATH: Mapping[str, str | Callable[[Sequence[str]], str]] = {
    **{name: f"math.{name}" for name in ("sqrt", "floor", "ceil", "hypot", "sin", "cos")},
    "atan2": lambda values: "math.atan2({} + 0.0, {} + 0.0)".format(*values),
    "distance": lambda values: f"math.hypot({differences(values)})",
}
"""Built-in functions that are in Python's module `math`, or are made of its functions."""

PYTHON_ARRAY_FUNCTIONS: Mapping[str, str] = {
    "item": "item",
    "append": "appended",
    "remove": "removed",
    "replace": "replaced",
}
"""Functions of the engine for arrays, by their names in the IR."""

PYTHON_FUNCTIONS: Mapping[str, str | Callable[[Sequence[str]], str]] = {
    **_OF_MATH,
    **PYTHON_ARRAY_FUNCTIONS,
    "clamp": lambda values: "min(max({}, {}), {})".format(*values),
    "contains": lambda values: "({1} in {0})".format(*values),
    "not contains": lambda values: "({1} not in {0})".format(*values),
    "empty": lambda values: "[]",
}
"""Built-in functions that Python spells otherwise."""

PYTHON_DIVISION = "{} // {}".format


def uses_math(expression: Expression) -> bool:
    """Return True for a built-in function that is in Python's module `math`."""
    if not isinstance(expression, Call):
        return False
    return expression.function in _OF_MATH


# What generated functions call something else.
_PYTHON_NAMES = {
    *PYTHON_ARRAY_FUNCTIONS.values(),
    *("bounded", "copy", "data", "deepcopy", "envelope", "event", "filled", "get", "machine"),
    *("elapsed", "is_active", "math", "plain", "put", "rospy", "userdata"),
}


def python_item(name: str) -> str:
    """Return the name of an item of a query in Python, which must not hide another name."""
    hides = keyword.iskeyword(name) or hasattr(builtins, name) or name in _PYTHON_NAMES
    return f"{name}_" if hides or name.isupper() else name


def python_query(query: Query, text: Printer) -> str:
    """Return a query in Python."""
    name, array = python_item(query.item), text(query.array)
    condition = text(query.condition) if query.condition is not None else ""
    if query.function == "count":
        return f"sum(1 for {name} in {array} if {condition})"
    if query.function in ("any", "all"):
        return f"{query.function}({condition} for {name} in {array})"
    items = f"({name} for {name} in {array} if {condition})" if condition else array
    if query.key is None:
        return f"{query.function}({items})"
    return f"{query.function}({items}, key=lambda {name}: {text(query.key)})"


def python_literal(literal: Literal) -> str:
    """Return a Python literal; durations in seconds, as in rospy and rclpy."""
    if literal.type == DURATION:
        return repr(literal.milliseconds / 1000)
    return repr(literal.value)


def ecmascript_literal(literal: Literal) -> str:
    """Return an ECMAScript literal; durations in milliseconds, as SCXML delays."""
    if literal.type == DURATION:
        length = literal.milliseconds
        return json.dumps(int(length) if length.is_integer() else length)
    return json.dumps(literal.value)
