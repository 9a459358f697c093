"""Patterns and types in expression trees of ECMAScript."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from functools import cache
from typing import Any

from lark import Tree

from swarmdsl.base.numerals import integer
from swarmdsl.codegen.exchange.scxml.ecmascript import dialect
from swarmdsl.execution.scxml.grammar import parse
from swarmdsl.importing.array_patterns import array_function, query_of
from swarmdsl.ir import Array, EnvelopeField, Literal, Primitive, Type
from swarmdsl.ir.expression_printer import translate
from swarmdsl.syntax.types import (
    BOOL,
    DURATION,
    FLOAT,
    FLOATS,
    INT,
    INTEGERS,
    SELF_FIELDS,
    STRING,
)

OPERATORS = {"===": "==", "!==": "!="}
COMPARISONS = ("==", "!=", "<", "<=", ">", ">=")
FLOAT_TYPES = tuple(map(Primitive, FLOATS))
WHOLE_TYPES = tuple(map(Primitive, INTEGERS))


class TypeInference:
    """Infers types of expressions that do not depend on the expected type.

    `data` maps variables and params to types, `field` gives the type of a field, `event` is the
    type of the current message, and `identity` the name of the data that is `self` in a model.
    `envelopes` says whether events have a sender and a time beside their message.
    """

    def __init__(
        self,
        data: Mapping[str, Type],
        field: Callable[[Type | None, str], Type | None],
        event: Type | None,
        identity: str,
        envelopes: bool = False,
    ) -> None:
        self.data = data
        self.field = field
        self.event = event
        self.identity = identity
        self.envelopes = envelopes

    def common(self, *trees: Any) -> Type | None:
        """Return the common type of operands; number literals count last."""
        found = [type_ for type_ in map(self.of, trees) if type_ is not None]
        sure = [
            t
            for t, tree in zip(map(self.of, trees), trees, strict=True)
            if t is not None and not is_number(tree)
        ]
        if DURATION in found:
            return DURATION
        floats = [type_ for type_ in found if type_ in FLOAT_TYPES]
        return next(iter(floats or sure or found), None)

    def of(self, tree: Any) -> Type | None:
        """Type of an operand; None if it depends on the expected type."""
        children = tree.children
        found = query_of(tree)
        if found is not None:
            array = self.of(found.array)
            element = array.element if isinstance(array, Array) else None
            return {"count": INT, "any": BOOL, "all": BOOL}.get(found.function, element)
        match tree.data:
            case "number":
                return FLOAT if isinstance(number_value(str(children[0])), float) else INT
            case "text":
                return STRING
            case "name":
                name = str(children[0])
                return BOOL if name in ("true", "false") else self.data.get(name)
            case "member":
                if is_event(tree):
                    return self.event
                if self.identity and is_name(children[0], self.identity):
                    return SELF_FIELDS.get(str(children[1]))
                if self.is_time_of_event(tree):
                    return DURATION
                return self.field(self.of(children[0]), str(children[1]))
            case "sign":
                return BOOL if children[0] == "!" else self.of(children[1])
            case "both" | "either":
                if self.is_time(tree):
                    return DURATION
                return STRING if self.is_sender(tree) else BOOL
            case "operation" if is_elapsed(tree):
                return DURATION
            case "operation":
                left, operator, right = children
                left, right = remainder(tree) or (left, right)
                if OPERATORS.get(operator, operator) in COMPARISONS:
                    return BOOL
                return self.of_operation(operator, self.of(left), self.of(right))
            case "call":
                callee, *arguments = children
                changed = array_function(tree)
                if changed is not None:
                    array = self.of(arguments[0])
                    element = array.element if isinstance(array, Array) else None
                    return element if changed == "item" else array
                word = function_of(callee, arguments)
                if word in ("/", "%"):
                    return self.of_operation(word, *map(self.of, arguments))
                if copied_value(tree) is not None:
                    return self.of(copied_value(tree))
                return RESULTS[word] if word in RESULTS else self.common(*arguments)
        return None

    def is_sender(self, tree: Any) -> bool:
        """Return True for the sender of the event, empty without one."""
        return self.envelopes and bool(tree == _sender())

    def is_time(self, tree: Any) -> bool:
        """Return True for the time at which the event was sent, 0 without one."""
        return self.envelopes and bool(tree == _time())

    def is_time_of_event(self, tree: Any) -> bool:
        """Return True for the time of the event, unless its message has a field of that name."""
        base, name = tree.children
        if not self.envelopes or name != "sent" or base.data != "member" or not is_event(base):
            return False
        return self.field(self.event, "sent") is None

    def of_operation(self, operator: str, left: Type | None, right: Type | None) -> Type | None:
        """Type of an arithmetic operation."""
        if operator == "/" and right == DURATION:
            return FLOAT
        if DURATION in (left, right):
            return DURATION
        if operator == "/":
            return FLOAT
        floats = [type_ for type_ in (left, right) if type_ in FLOAT_TYPES]
        return next(iter(floats), left if left is not None else right)


def number(text: str, expected: Type | None) -> Literal:
    """Literal of a number; an expected duration is in milliseconds."""
    value = number_value(text)
    if expected == DURATION:
        return Literal(round(value * 1_000_000), DURATION)
    return Literal(value, FLOAT if isinstance(value, float) else INT)


def number_value(text: str) -> int | float:
    """Return the value of a number."""
    if text[1:2] in ("x", "X"):
        return int(text, 16)
    return integer(text) if text.isdigit() else float(text)


def is_number(tree: Any) -> bool:
    """Return True for a number with optional signs."""
    if tree.data == "sign":
        return is_number(tree.children[1])
    return bool(tree.data == "number")


def is_name(tree: Any, name: str) -> bool:
    """Return True for the given name."""
    return bool(tree.data == "name" and tree.children[0] == name)


def is_elapsed(tree: Any) -> bool:
    """Return True for the time since one that data have: `Date.now() - since`."""
    left, operator, right = tree.children
    if operator != "-" or left.data != "call" or right.data != "name":
        return False
    callee = left.children[0]
    is_now = callee.data == "member" and str(callee.children[1]) == "now"
    return is_now and len(left.children) == 1 and is_name(callee.children[0], "Date")


def is_event(tree: Any) -> bool:
    """Return True for `_event.data`."""
    return is_name(tree.children[0], "_event") and tree.children[1] == "data"


def copied_value(tree: Any) -> Any:
    """Operand of `JSON.parse(JSON.stringify(...))`; None for other expressions."""
    callee, *arguments = tree.children
    if callee.data != "member" or not is_name(callee.children[0], "JSON") or len(arguments) != 1:
        return None
    if callee.children[1] == "stringify":
        return arguments[0]
    inner = arguments[0]
    return copied_value(inner) if inner.data == "call" else None


def remainder(tree: Any) -> tuple[Any, Any] | None:
    """Operands of `((a % b) + b) % b`, which has the sign of `b`; None otherwise."""
    match tree:
        case Tree(
            data="operation",
            children=[
                Tree(
                    data="operation",
                    children=[Tree(data="operation", children=[left, "%", inner]), "+", again],
                ),
                "%",
                right,
            ],
        ) if inner == right and again == right:
            return left, right
    return None


def function_of(callee: Any, arguments: list[Any]) -> str | None:
    """Operator or built-in function that a call stands for, None if there is none.

    The portable profile wraps operations in functions that return no value where the operation is
    undefined.
    """
    word = None
    if callee.data == "function":
        word = _wrapped().get(callee)
    elif is_name(callee, "Number"):
        word = "float"
    elif callee.data == "member" and is_name(callee.children[0], "Math"):
        name = str(callee.children[1])
        word = {"trunc": "int"}.get(name, name) if name in FUNCTIONS_OF_MATH else None
    least = _ARGUMENTS.get(word or "")
    if least is None:
        return None
    more = word in ("min", "max", "hypot")
    return word if len(arguments) == least or (more and len(arguments) > least) else None


def without_zero(tree: Any) -> Any:
    """Operand of a sum with 0, which makes a negative zero positive; else the tree itself."""
    if tree.data == "operation" and tree.children[1] == "+":
        left, _, right = tree.children
        if right.data == "number" and str(right.children[0]) == "0":
            return left
    return tree


def quotient_of(tree: Any) -> tuple[Any, Any] | None:
    """Operands of a division; None for other expressions."""
    if tree.data == "operation" and tree.children[1] == "/":
        return tree.children[0], tree.children[2]
    if tree.data != "call" or function_of(tree.children[0], tree.children[1:]) != "/":
        return None
    return tree.children[1], tree.children[2]


POINTS = {"distance in a plane": ("x", "y"), "distance in space": ("x", "y", "z")}
"""Coordinates that a function for a distance takes."""

FUNCTIONS_OF_MATH = (
    *("abs", "atan2", "ceil", "cos", "floor", "hypot", "max", "min"),
    *("round", "sin", "sqrt", "trunc"),
)
RESULTS = {
    **dict.fromkeys((*POINTS, "sqrt", "hypot", "sin", "cos", "atan2", "float"), FLOAT),
    **dict.fromkeys(("int", "round", "floor", "ceil", "div"), INT),
}
"""Types of the results that do not depend on the arguments."""
_WRAPPED_OF_ONE = ("sqrt", "int", "round", "floor", "ceil", "sin", "cos")
_ARGUMENTS = {
    **dict.fromkeys(POINTS, 2),
    "clamp": 3,
    **dict.fromkeys((*_WRAPPED_OF_ONE, "abs", "float"), 1),
    **dict.fromkeys(("/", "%", "div", "min", "max", "hypot", "atan2"), 2),
}
"""Number of arguments of each, the least one where it can have more."""


@cache
def _sender() -> Any:
    return parse(translate(EnvelopeField("sender", STRING), dialect({})))


@cache
def _time() -> Any:
    return parse(translate(EnvelopeField("sent", DURATION), dialect({})))


@cache
def _wrapped() -> Mapping[Any, str]:
    words = dialect({})
    assert words.division is not None
    texts = {
        "/": words.quotient("a", "b"),
        "%": words.modulo("a", "b"),
        "div": words.division("a", "b"),
    }
    given = {"clamp": ["a", "b", "c"], **{word: ["a"] for word in _WRAPPED_OF_ONE}}
    for word, names in POINTS.items():
        given[word] = [f"{point}.{name}" for point in "ab" for name in names]
    for word, values in given.items():
        write = words.functions[word if word in words.functions else "distance"]
        assert not isinstance(write, str)
        texts[word] = write(values)
    return {parse(text).children[0]: word for word, text in texts.items()}
