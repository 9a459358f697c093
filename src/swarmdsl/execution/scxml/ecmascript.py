"""ECMAScript subset for conditions and values of ordinary documents.

Operators, members, strings, lists, objects, integer functions of `Math` and the like, `In`,
`_event` and the other system variables, and copies with `JSON`. Nothing is evaluated as code: an
expression is compiled to Python functions.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from functools import lru_cache
from typing import Any

from swarmdsl.execution.engine import Event, ExecutionError, InstanceLike
from swarmdsl.execution.scxml.grammar import Unreadable, parse, unquoted
from swarmdsl.execution.scxml.operations import (
    APPLYING,
    FUNCTIONS,
    METHODS,
    OPERATIONS,
    SIGNS,
    apply,
    takes,
)
from swarmdsl.execution.scxml.session import EVENT_FIELDS, SYSTEM_VARIABLES, event_fields
from swarmdsl.execution.scxml.values import code_units, contains, copied, number, text, truth, whole

Names = Mapping[str, Any]
Value = Callable[[InstanceLike, Event, Names], Any]
"""Compiled expression; `names` are the parameters of enclosing functions."""

_CONSTANTS: Mapping[str, Any] = {
    "true": True,
    "false": False,
    "null": None,
    "undefined": None,
    "NaN": math.nan,
    "Infinity": math.inf,
}
_GLOBALS = {
    *("Array", "Boolean", "Date", "Error", "Function", "JSON", "Map", "Math", "Number", "Object"),
    *("Promise", "RegExp", "Set", "String", "Symbol", "console", "eval", "globalThis"),
    *("isFinite", "isNaN", "parseFloat", "parseInt", "this"),
}
"""Names that ECMAScript defines but this subset does not: an error when reading."""

_MILLISECOND = 1_000_000


@lru_cache(maxsize=1000)
def read(written: str) -> Value:
    """Compile an expression. Raises Unreadable.

    The function raises ExecutionError where ECMAScript throws.
    """
    return compiled(parse(written))


@lru_cache(maxsize=1000)
def location(written: str) -> Callable[[InstanceLike, Event, Any], None]:
    """Compile an assignment to a declared variable or a member. Raises Unreadable."""
    return assignment(parse(written), written)


def assignment(
    tree: Any, written: str, declares: bool = False
) -> Callable[[InstanceLike, Event, Any], None]:
    """Return the assignment to an expression; one that `declares` also makes variables.

    Raises Unreadable.
    """
    root = tree
    while root.data in ("member", "item"):
        root = root.children[0]
    if root.data == "name" and root.children[0] in SYSTEM_VARIABLES:
        return _unassignable(str(root.children[0]))
    if tree.data == "name":
        name = str(tree.children[0])

        def assign(instance: InstanceLike, event: Event, value: Any) -> None:
            if name not in instance.data and not declares:
                raise ExecutionError(f"there is no variable `{name}`")
            instance.data[name] = value

        return assign
    if tree.data not in ("member", "item"):
        raise Unreadable(f"`{written}` cannot be assigned to")
    base = compiled(tree.children[0])
    key = _key(tree)

    def assign_member(instance: InstanceLike, event: Event, value: Any) -> None:
        held, name = base(instance, event, {}), key(instance, event, {})
        if isinstance(held, dict):
            held[text(name)] = value
        elif isinstance(held, list) and isinstance(name, int) and 0 <= name < len(held):
            held[name] = value
        else:
            raise ExecutionError(f"`{written}` cannot be assigned to")

    return assign_member


def _unassignable(name: str) -> Callable[[InstanceLike, Event, Any], None]:
    """Return the assignment to a system variable, which always fails (5.10)."""

    def fail(instance: InstanceLike, event: Event, value: Any) -> None:
        raise ExecutionError(f"`{name}` cannot be assigned to")

    return fail


def compiled(tree: Any) -> Value:
    """Compile the tree of an expression. Raises Unreadable."""
    children = tree.children
    match tree.data:
        case "number":
            number = _number(str(children[0]))
            return lambda instance, event, names: number
        case "text":
            literal = unquoted(children[0])
            return lambda instance, event, names: literal
        case "name":
            return _name(str(children[0]))
        case "list":
            values = [compiled(child) for child in children]
            return lambda instance, event, names: [v(instance, event, names) for v in values]
        case "object":
            pairs = [(unquoted(pair.children[0]), compiled(pair.children[1])) for pair in children]
            return lambda instance, event, names: {
                key: value(instance, event, names) for key, value in pairs
            }
        case "member" | "item":
            return _member(tree)
        case "call":
            return _call(tree)
        case "sign":
            sign, operand = SIGNS[str(children[0])], compiled(children[1])
            if children[0] == "typeof" and children[1].data == "name":
                operand = _or_undefined(operand)
            return lambda instance, event, names: sign(operand(instance, event, names))
        case "before" | "after":
            return _step(tree)
        case "membership":
            needle, held = compiled(children[0]), compiled(children[1])
            return lambda instance, event, names: contains(
                held(instance, event, names), needle(instance, event, names)
            )
        case "operation" | "bitwise":
            operation = OPERATIONS[str(children[1])]
            left, right = compiled(children[0]), compiled(children[2])
            return lambda instance, event, names: operation(
                left(instance, event, names), right(instance, event, names)
            )
        case "both" | "either" as word:
            first, second = compiled(children[0]), compiled(children[1])
            decisive = word == "either"

            def logical(instance: InstanceLike, event: Event, names: Names) -> Any:
                value = first(instance, event, names)
                return value if truth(value) is decisive else second(instance, event, names)

            return logical
        case "choice":
            test, yes, no = map(compiled, children)
            return lambda instance, event, names: (
                yes if truth(test(instance, event, names)) else no
            )(instance, event, names)
    raise Unreadable("a function is called where it stands, or not at all")


def _name(name: str) -> Value:
    if name in _CONSTANTS:
        constant = _CONSTANTS[name]
        return lambda instance, event, names: constant
    if name in SYSTEM_VARIABLES:
        system = SYSTEM_VARIABLES[name]
        return lambda instance, event, names: system(instance, event)
    if name in _GLOBALS:
        raise Unreadable(f"`{name}` is not supported")

    def value(instance: InstanceLike, event: Event, names: Names) -> Any:
        for known in (names, instance.data):
            if name in known:
                return known[name]
        raise ExecutionError(f"`{name}` is not defined")

    return value


def _step(tree: Any) -> Value:
    """Return `++` or `--` before or after a variable or member."""
    sign, operand = tree.children if tree.data == "before" else reversed(tree.children)
    amount = 1 if sign == "++" else -1
    if operand.data not in ("name", "member", "item"):
        raise Unreadable(f"`{sign}` needs a variable")
    value, store = compiled(operand), assignment(operand, str(sign))

    def step(instance: InstanceLike, event: Event, names: Names) -> Any:
        old = number(value(instance, event, names))
        new = whole(old + amount)
        store(instance, event, new)
        return new if tree.data == "before" else old

    return step


def _or_undefined(name: Value) -> Value:
    def value(instance: InstanceLike, event: Event, names: Names) -> Any:
        try:
            return name(instance, event, names)
        except ExecutionError:
            return None

    return value


def _member(tree: Any) -> Value:
    if _is_name(tree.children[0], "_event") and tree.data == "member":
        return _event_field(str(tree.children[1]))
    base, key = compiled(tree.children[0]), _key(tree)

    def value(instance: InstanceLike, event: Event, names: Names) -> Any:
        held, name = base(instance, event, names), key(instance, event, names)
        if held is None:
            raise ExecutionError(f"undefined has no `{text(name)}`")
        if name == "length" and isinstance(held, (str, list)):
            return len(held) if isinstance(held, list) else code_units(held)
        if isinstance(held, dict):
            return held.get(text(name))
        if isinstance(held, (str, list)) and type(name) is int and 0 <= name < len(held):
            return held[name]
        return None

    return value


def _event_field(part: str) -> Value:
    if part not in EVENT_FIELDS:
        raise Unreadable(f"`_event.{part}` is not supported")
    if part not in ("data", "name"):
        return lambda instance, event, names: event_fields(instance, event)[part]

    def value(instance: InstanceLike, event: Event, names: Names) -> Any:
        if not event.name:
            raise ExecutionError("`_event` is not defined")
        return event.data if part == "data" else event.name

    return value


def _key(tree: Any) -> Value:
    if tree.data == "item":
        return compiled(tree.children[1])
    name = str(tree.children[1])
    return lambda instance, event, names: name


def _call(tree: Any) -> Value:
    callee, *given = tree.children
    if _is_name(callee, "In") and len(given) == 1:
        # The null data model has no quotes around the id (B.1.2).
        id_ = str(given[0].children[0]) if given[0].data == "name" else None
        state = compiled(given[0])
        return lambda instance, event, names: _is_active(
            instance,
            id_ if id_ is not None and id_ not in instance.data else state(instance, event, names),
        )
    if _is_member(callee, "Date", "now") and not given:
        return lambda instance, event, names: instance.time // _MILLISECOND
    if _is_member(callee, "JSON", "parse") and len(given) == 1 and given[0].data == "call":
        inner, *of = given[0].children
        if _is_member(inner, "JSON", "stringify") and len(of) == 1:
            value = compiled(of[0])
            return lambda instance, event, names: copied(value(instance, event, names))
    if callee.data == "member" and [each.data for each in given] == ["function"]:
        return _call_with_function(callee, given[0])
    arguments = [compiled(each) for each in given]
    if callee.data == "function":
        return _call_function(callee, arguments)
    if callee.data == "member":
        owner, name = callee.children[0], str(callee.children[1])
        known = f"{owner.children[0]}.{name}" if owner.data == "name" else ""
        function = FUNCTIONS.get(known)
        if function is None and name in METHODS:
            known, function = name, METHODS[name]
            arguments.insert(0, compiled(owner))
        if function is not None and not takes(known, len(given)):
            raise Unreadable(f"`{known}` is called with another number of values")
        if function is not None:
            return lambda instance, event, names: function(
                *[argument(instance, event, names) for argument in arguments]
            )
    if _is_name(callee, "Number") and len(arguments) == 1:
        (operand,) = arguments
        return lambda instance, event, names: FUNCTIONS["Number"](operand(instance, event, names))
    raise Unreadable("only functions of `Math`, `Number` and `In` can be called")


def _call_with_function(callee: Any, function: Any) -> Value:
    """Return the call of a method of a list with a function that it applies to items."""
    name = str(callee.children[1])
    *parameters, result = function.children
    if len(parameters) != APPLYING.get(name):
        raise Unreadable(f"`{name}` is not supported with this function")
    array, body = compiled(callee.children[0]), compiled(result)
    words = [str(each) for each in parameters]

    def value(instance: InstanceLike, event: Event, names: Names) -> Any:
        def applied(*items: Any) -> Any:
            return body(instance, event, {**names, **dict(zip(words, items, strict=True))})

        return apply(name, array(instance, event, names), applied)

    return value


def _call_function(function: Any, arguments: list[Value]) -> Value:
    *parameters, result = function.children
    if len(parameters) != len(arguments):
        raise Unreadable("the function is called with another number of values")
    body = compiled(result)
    words = [str(each) for each in parameters]

    def value(instance: InstanceLike, event: Event, names: Names) -> Any:
        given = {w: a(instance, event, names) for w, a in zip(words, arguments, strict=True)}
        return body(instance, event, {**names, **given})

    return value


def _is_active(instance: InstanceLike, state: Any) -> bool:
    return isinstance(state, str) and state in instance.machine.numbers and instance.active(state)


def _is_name(tree: Any, name: str) -> bool:
    return bool(tree.data == "name" and tree.children[0] == name)


def _is_member(tree: Any, name: str, member: str) -> bool:
    return bool(
        tree.data == "member" and _is_name(tree.children[0], name) and tree.children[1] == member
    )


def _number(token: str) -> float | int:
    return whole(int(token, 16) if token[1:2] in ("x", "X") else float(token))
