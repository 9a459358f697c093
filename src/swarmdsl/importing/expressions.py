"""Convert expressions of ECMAScript.

Types determine the meaning: a number is a duration in milliseconds where a duration is expected.
"""

from __future__ import annotations

from collections import ChainMap
from collections.abc import Callable, Mapping
from typing import Any, cast

from lark import Tree

from swarmdsl.base.numerals import fits_64_bits
from swarmdsl.execution.scxml.grammar import Unreadable, parse, unquoted
from swarmdsl.importing.array_patterns import (
    QueryPattern,
    array_function,
    assigned_fields,
    contained,
    query_of,
)
from swarmdsl.importing.expression_patterns import (
    COMPARISONS,
    FUNCTIONS_OF_MATH,
    OPERATORS,
    POINTS,
    RESULTS,
    WHOLE_TYPES,
    TypeInference,
    copied_value,
    function_of,
    is_elapsed,
    is_event,
    is_name,
    number,
    number_value,
    quotient_of,
    remainder,
    without_zero,
)
from swarmdsl.importing.names import is_plain
from swarmdsl.ir import (
    Array,
    Binary,
    Call,
    Construction,
    EnvelopeField,
    EventData,
    Expression,
    FieldAccess,
    ItemRef,
    Literal,
    Named,
    ParamRef,
    Primitive,
    Query,
    SelfField,
    Type,
    Unary,
    VariableRef,
)
from swarmdsl.syntax.parser.literals import forbidden_character
from swarmdsl.syntax.types import BOOL, DURATION, FLOAT, INT, SELF_FIELDS, STRING

_RESERVED = {"null", "undefined", "NaN", "Infinity", "_event", "_name", "_sessionid"}

# Longest duration in milliseconds: 64 bits of nanoseconds.
_MAX_MILLISECONDS = 2**63 // 1_000_000

_SHOWN = 80
_TEXTS = ("string", "wstring")


class UnsupportedError(Exception):
    """The language has no equivalent; `reason` is a clause that explains why."""

    def __init__(self, reason: str) -> None:
        super().__init__(reason)
        self.reason = reason


class Expressions:
    """Converts the expressions of one document.

    `refer` resolves a name for an expected type, `inside` gives the condition that a state is
    active, and `field` the type of a field, None if it is unknown. `identity` is the name of the
    data that is `self` in a model, empty if there is none; `envelopes` says whether events have a
    sender and a time beside their message. `elapsed` gives the time in a state from the name of the
    data with the time of its entry; None for other data.
    """

    def __init__(
        self,
        types: Mapping[str, Type],
        refer: Callable[[str, Type], VariableRef | ParamRef],
        field: Callable[[Type | None, str], Type | None],
        inside: Callable[[str], Expression],
        identity: str = "",
        envelopes: bool = False,
        elapsed: Callable[[str], Expression | None] = lambda name: None,
    ) -> None:
        self.types = types
        self.refer = refer
        self.field = field
        self.inside = inside
        self.identity = identity
        self.envelopes = envelopes
        self.elapsed = elapsed

    def read(self, text: str, expected: Type | None, event: Type | None = None) -> Expression:
        """Convert an expression; `event` is the current message. Raises UnsupportedError."""
        try:
            return _ExpressionReader(self, event).expression(parse(text), expected)
        except Unreadable as error:
            reason = str(error)
        except UnsupportedError as error:
            reason = error.reason
        shown = text if len(text) <= _SHOWN else f"{text[:_SHOWN]}..."
        raise UnsupportedError(f"`{shown}` is not supported: {reason}")

    def type(self, text: str) -> Type | None:
        """Type of an expression; None if it depends on the expected type."""
        try:
            return TypeInference(self.types, self.field, None, self.identity).of(parse(text))
        except Unreadable:
            return None


def path(text: str) -> tuple[str, ...]:
    """Variable and field names of a location. Raises UnsupportedError."""
    names = text.strip().split(".")
    if not all(name.isidentifier() and name.isascii() for name in names):
        raise UnsupportedError(f"`{text}` is not a variable or field")
    return tuple(names)


def constant(text: str, expected: Type | None, identity: str = "") -> Expression:
    """Convert a constant expression, which may read `self`. Raises UnsupportedError."""

    def refer(name: str, expected: Type) -> VariableRef:
        raise UnsupportedError(f"`{name}` is not a constant")

    def inside(state: str) -> Expression:
        raise UnsupportedError("it depends on the active states")

    return Expressions({}, refer, lambda type_, field: None, inside, identity).read(text, expected)


class _ExpressionReader:
    """Converts one expression."""

    def __init__(
        self, known: Expressions, event: Type | None, items: Mapping[str, ItemRef] | None = None
    ) -> None:
        self.known = known
        self.event = event
        self.items = items or {}
        # Names in queries hide those of the document, which become known one by one.
        named: Mapping[str, Type] = ChainMap(
            {name: item.type for name, item in self.items.items()},
            cast("dict[str, Type]", known.types),
        )
        self.types = TypeInference(named, known.field, event, known.identity, known.envelopes)

    def expression(self, tree: Any, expected: Type | None) -> Expression:
        children = tree.children
        query = query_of(tree)
        if query is not None:
            return self._query(query)
        match tree.data:
            case "list" if not children and isinstance(expected, Array):
                return Call("empty", (), expected)
            case "number":
                text = str(children[0])
                if not fits_64_bits(number_value(text)):
                    raise UnsupportedError("no type of a model has so large a number")
                if expected == DURATION and number_value(text) > _MAX_MILLISECONDS:
                    raise UnsupportedError("ROS has no duration of this length")
                return number(text, expected)
            case "text":
                text = unquoted(children[0])
                if forbidden := forbidden_character(text):
                    raise UnsupportedError(f"a string of a model cannot contain {forbidden}")
                return Literal(text, STRING)
            case "name":
                return self._name(str(children[0]), expected)
            case "member":
                return self._member(tree)
            case "sign":
                return self._sign(str(children[0]), children[1], expected)
            case "either" if self.types.is_sender(tree):
                return EnvelopeField("sender", STRING)
            case "either" if self.types.is_time(tree):
                return EnvelopeField("sent", DURATION)
            case "both" | "either" as word:
                left, right = (self.expression(each, BOOL) for each in children)
                return Binary("and" if word == "both" else "or", left, right, BOOL)
            case "operation":
                return self._operation(tree, expected)
            case "call":
                return self._call(tree, expected)
        raise UnsupportedError("it has no equivalent in a model")

    def _name(self, name: str, expected: Type | None) -> Expression:
        if name in ("true", "false"):
            return Literal(name == "true", BOOL)
        if name in self.items:
            return self.items[name]
        if name in _RESERVED:
            raise UnsupportedError(f"`{name}` is not a value")
        return self.known.refer(name, expected or BOOL)

    def _member(self, tree: Any) -> Expression:
        base, name = tree.children[0], str(tree.children[1])
        if is_event(tree):
            if self.event is None:
                raise UnsupportedError("the type of the event is unknown")
            return EventData(self.event)
        if self.types.is_time_of_event(tree):
            return EnvelopeField("sent", DURATION)
        if self.known.identity and is_name(base, self.known.identity):
            if name not in SELF_FIELDS:
                raise UnsupportedError(f"`self` has no `{name}`")
            return SelfField(name, SELF_FIELDS[name])
        if base.data == "name" and str(base.children[0]) in (*_RESERVED, "Math"):
            raise UnsupportedError(f"`{base.children[0]}.{name}` is not a value")
        unknown = base.data == "name" and str(base.children[0]) not in self.types.data
        if unknown and name != "length":
            raise UnsupportedError(f"`{base.children[0]}` is not declared")
        owner = self.expression(base, STRING if name == "length" else None)
        type_ = getattr(owner, "type", None)
        kind = type_.name if isinstance(type_, Primitive) else ""
        if name == "length" and (kind in _TEXTS or isinstance(type_, Array)):
            return Call("len", (owner,), INT)
        # Time and duration have fields in ROS.
        if isinstance(type_, Array) or (kind and kind not in ("time", "duration")):
            raise UnsupportedError(f"`{type_}` has no `{name}`")
        return FieldAccess(owner, name, self.known.field(type_, name))

    def _sign(self, sign: str, operand: Any, expected: Type | None) -> Expression:
        if sign == "!":
            return Unary("not", self.expression(operand, BOOL), BOOL)
        if sign == "typeof":
            raise UnsupportedError("`typeof` is not supported")
        value = self.expression(operand, expected if expected != BOOL else INT)
        if sign == "+":
            return value
        if isinstance(value, Literal) and not isinstance(value.value, (bool, str)):
            return Literal(-value.value, value.type)
        return Unary("-", value, value.type)

    def _operation(self, tree: Any, expected: Type | None) -> Expression:
        left, sign, right = tree.children
        held = contained(tree)
        if held is not None:
            array = self._array(held[0])
            return Call("contains", (array, self.expression(held[1], _element(array))), BOOL)
        if is_elapsed(tree):
            time = self.known.elapsed(str(right.children[0]))
            if time is not None:
                return time
        rest = remainder(tree)
        if rest is not None:
            return self._arithmetic("%", *rest, expected)
        operator = OPERATORS.get(str(sign), str(sign))
        if operator == "%":
            raise UnsupportedError("`%` of a negative number differs in a model")
        if operator not in COMPARISONS:
            return self._arithmetic(operator, left, right, expected)
        hint = self.types.common(left, right) or INT
        return Binary(operator, self.expression(left, hint), self.expression(right, hint), BOOL)

    def _arithmetic(
        self, operator: str, left: Any, right: Any, expected: Type | None
    ) -> Expression:
        open_ = expected in (None, BOOL)
        is_number = not open_ and expected != DURATION
        plain = INT if open_ else expected
        first, second = self.types.of(left), self.types.of(right)
        if operator in ("+", "-"):
            hint = self.types.common(left, right) if open_ else expected
            values = [self.expression(each, hint or plain) for each in (left, right)]
        elif expected == DURATION or (
            # A product with a duration is no number, but a quotient of durations can be a factor.
            DURATION in (first, second) and not (operator == "*" and is_number)
        ):
            # One operand is a duration, the other a number; if both look like numbers, the first.
            is_second = first != DURATION and (
                second == DURATION
                or (
                    left.data != "number"
                    and operator == "*"
                    and not (_is_too_long(right) or _is_root(right))
                )
            )
            both = operator == "/" and (second == DURATION or is_number)
            values = [
                self.expression(left, DURATION if both or not is_second else INT),
                self.expression(right, DURATION if is_second or both else INT),
            ]
        else:
            values = [self.expression(each, plain) for each in (left, right)]
        known = self.types.of_operation(operator, first, second)
        return Binary(operator, values[0], values[1], known or getattr(values[0], "type", None))

    def _call(self, tree: Any, expected: Type | None) -> Expression:
        callee, *arguments = tree.children
        changed = array_function(tree)
        if changed is not None:
            return self._array_function(changed, arguments)
        fields = assigned_fields(tree)
        if fields is not None and isinstance(expected, Named):
            return self._construction(fields, expected)
        word = function_of(callee, arguments)
        if word in ("/", "%"):
            return self._arithmetic(word, arguments[0], arguments[1], expected)
        if word is not None:
            return self._function(word, tree, expected)
        if is_name(callee, "In") and [e.data in ("text", "name") for e in arguments] == [True]:
            # The null data model omits quotes around the id (SCXML B.1.2).
            return self.known.inside(unquoted(arguments[0].children[0]))
        if callee.data == "member" and is_name(callee.children[0], "Math"):
            name = str(callee.children[1])
            if name in FUNCTIONS_OF_MATH:
                raise UnsupportedError(f"`Math.{name}` has other arguments")
            raise UnsupportedError(f"a model has no `Math.{name}`")
        inner = copied_value(tree)
        if inner is not None:
            return self.expression(inner, expected)
        raise UnsupportedError("only some functions of `Math` are supported")

    def _array(self, tree: Any) -> Expression:
        """Convert an array, whose type must be known."""
        array = self.expression(tree, None)
        if not isinstance(array.type, Array):
            raise UnsupportedError("the type of an array is unknown")
        return array

    def _array_function(self, word: str, arguments: list[Any]) -> Expression:
        """Convert an item of an array, or an array with a change."""
        array = self._array(arguments[0])
        element = _element(array)
        expected = {
            "item": (INT,),
            "remove": (INT,),
            "append": (element, INT),
            "replace": (INT, element),
        }[word]
        given = zip(arguments[1:], expected, strict=True)
        values = (array, *(self.expression(tree, type_) for tree, type_ in given))
        return Call(word, values, element if word == "item" else array.type)

    def _query(self, query: QueryPattern) -> Expression:
        array = self._array(query.array)
        element = _element(array)
        name = query.item if is_plain(query.item) else f"{query.item}_"
        item = ItemRef(name, element)

        def part(tree: Any, named: str, expected: Type | None) -> Expression | None:
            if tree is None:
                return None
            items = {**self.items, named: item}
            return _ExpressionReader(self.known, self.event, items).expression(tree, expected)

        return Query(
            query.function,
            name,
            array,
            part(query.condition, query.item, BOOL),
            part(query.key, query.key_item, None),
            {"count": INT, "any": BOOL, "all": BOOL}.get(query.function, element),
        )

    def _construction(self, fields: list[Any], type_: Named) -> Expression:
        values = []
        for pair in fields:
            name = unquoted(pair.children[0])
            value = self.expression(pair.children[1], self.known.field(type_, name))
            values.append((name, value))
        return Construction(type_, tuple(values))

    def _function(self, word: str, tree: Any, expected: Type | None) -> Expression:
        """Convert a call of a built-in function."""
        callee, *arguments = tree.children
        plain = callee.data == "member"
        if word in ("min", "max", "abs", "clamp"):
            open_ = expected in (None, BOOL)
            hint = (self.types.common(*arguments) or INT) if open_ else expected
            return Call(word, tuple(self.expression(e, hint) for e in arguments), hint)
        if word in POINTS:
            parts = [Tree("member", [e, name]) for e in arguments for name in POINTS[word]]
            return Call("distance", tuple(self.expression(e, FLOAT) for e in parts), FLOAT)
        if DURATION in map(self.types.of, arguments):
            raise UnsupportedError(f"`{word}` takes numbers, and no duration")
        quotient = quotient_of(arguments[0])
        whole = quotient is not None and all(self.types.of(e) in WHOLE_TYPES for e in quotient)
        if plain and word == "floor" and quotient is not None and whole:
            word, arguments = "div", list(quotient)
        if word == "atan2":
            arguments = list(map(without_zero, arguments))
        hint = INT if word in ("div", "float") else FLOAT
        values = [self.expression(argument, hint) for argument in arguments]
        if plain and word == "round":  # it takes halves up
            half = Binary("+", values[0], Literal(0.5, FLOAT), FLOAT)
            return Call("floor", (half,), INT)
        return Call(word, tuple(values), RESULTS[word])


def _element(array: Expression) -> Type:
    assert isinstance(array.type, Array)
    return array.type.element


def _is_root(tree: Any) -> bool:
    """Return True for a square root, which is never a duration."""
    if tree.data != "call":
        return False
    callee, *arguments = tree.children
    if callee.data == "member" and is_name(callee.children[0], "Math"):
        return str(callee.children[1]) == "sqrt"
    return function_of(callee, arguments) == "sqrt"


def _is_too_long(tree: Any) -> bool:
    """Return True for a number of milliseconds beyond the range of durations."""
    while tree.data == "sign" and str(tree.children[0]) in "+-":
        tree = tree.children[1]
    if tree.data != "number":
        return False
    return number_value(str(tree.children[0])) > _MAX_MILLISECONDS
