"""Patterns and types in expression trees of ECMAScript."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from functools import cache
from typing import Any

from lark import Tree

from swarmdsl.codegen.exchange.scxml.ecmascript import dialect
from swarmdsl.execution.scxml.grammar import parse
from swarmdsl.ir import Literal, Primitive, Type
from swarmdsl.syntax.types import BOOL, DURATION, FLOAT, FLOATS, INT, STRING

OPERATORS = {"===": "==", "!==": "!="}
COMPARISONS = ("==", "!=", "<", "<=", ">", ">=")
FLOAT_TYPES = tuple(map(Primitive, FLOATS))


class TypeInference:
    """Infers types of expressions that do not depend on the expected type.

    `data` maps variables and params to types, `field` gives the type of a field, and `event` is the
    type of the current message.
    """

    def __init__(
        self,
        data: Mapping[str, Type],
        field: Callable[[Type | None, str], Type | None],
        event: Type | None,
    ) -> None:
        self.data = data
        self.field = field
        self.event = event

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
        match tree.data:
            case "number":
                return number(str(children[0]), None).type
            case "text":
                return STRING
            case "name":
                name = str(children[0])
                return BOOL if name in ("true", "false") else self.data.get(name)
            case "member":
                if is_event(tree):
                    return self.event
                return self.field(self.of(children[0]), str(children[1]))
            case "sign":
                return BOOL if children[0] == "!" else self.of(children[1])
            case "both" | "either":
                return BOOL
            case "operation":
                left, operator, right = children
                left, right = remainder(tree) or (left, right)
                if OPERATORS.get(operator, operator) in COMPARISONS:
                    return BOOL
                return self.of_operation(operator, self.of(left), self.of(right))
            case "call":
                callee, *arguments = children
                operator_ = operator_of(callee, arguments)
                if operator_ in ("/", "%"):
                    return self.of_operation(operator_, *map(self.of, arguments))
                if copied_value(tree) is not None:
                    return self.of(copied_value(tree))
                return self.common(*arguments) if operator_ is None else FLOAT
        return None

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
    if text[1:2] in ("x", "X"):
        value: int | float = int(text, 16)
    else:
        value = int(text) if text.isdigit() else float(text)
    if expected == DURATION:
        return Literal(round(value * 1_000_000), DURATION)
    return Literal(value, FLOAT if isinstance(value, float) else INT)


def is_number(tree: Any) -> bool:
    """Return True for a number with optional signs."""
    if tree.data == "sign":
        return is_number(tree.children[1])
    return bool(tree.data == "number")


def is_name(tree: Any, name: str) -> bool:
    """Return True for the given name."""
    return bool(tree.data == "name" and tree.children[0] == name)


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


def operator_of(callee: Any, arguments: list[Any]) -> str | None:
    """Operator, or `sqrt`, that a function of the portable profile stands for.

    The profile wraps these in functions that return no value where the operation is undefined.
    """
    operator = _wrapped().get(callee) if callee.data == "function" else None
    return operator if operator and len(arguments) == (1 if operator == "sqrt" else 2) else None


@cache
def _wrapped() -> Mapping[Any, str]:
    words = dialect({})
    root = words.functions["sqrt"]
    assert not isinstance(root, str)
    texts = {"/": words.quotient("a", "b"), "%": words.modulo("a", "b"), "sqrt": root(["a"])}
    return {parse(text).children[0]: operator for operator, text in texts.items()}
