"""ECMAScript subset for conditions and values of ordinary documents.

Operators, members, strings, lists, objects, integer functions of `Math` and the like, `In`,
`_event`, and copies with `JSON`. Nothing is evaluated as code: an expression is compiled to Python
functions.
"""

from __future__ import annotations

import math
import re
from collections.abc import Callable, Mapping
from copy import deepcopy
from functools import cache, lru_cache
from typing import Any

from lark import Lark, Token, Tree
from lark.exceptions import UnexpectedInput, UnexpectedToken

from swarmdsl.execution.engine import Event, ExecutionError, InstanceLike
from swarmdsl.execution.scxml.values import FUNCTIONS, OPERATIONS, SIGNS, text, truth, whole

Names = Mapping[str, Any]
Value = Callable[[InstanceLike, Event, Names], Any]
"""Compiled expression; `names` are the parameters of enclosing functions."""

_GRAMMAR = r"""
?start: conditional
?conditional: either | either "?" conditional ":" conditional -> choice
?either: both | either "||" both -> either
?both: equality | both "&&" equality -> both
?equality: relation | equality EQUALITY relation -> operation
?relation: sum | relation RELATION sum -> operation
?sum: product | sum (PLUS | MINUS) product -> operation
?product: sign | product (STAR | SLASH | PERCENT) sign -> operation
?sign: postfix | (NOT | PLUS | MINUS | TYPEOF) sign -> sign
?postfix: primary | postfix "." NAME -> member | postfix "[" conditional "]" -> item
    | postfix "(" [conditional ("," conditional)*] ")" -> call
?primary: NUMBER -> number | TEXT -> text | NAME -> name | "(" conditional ")"
    | "[" [conditional ("," conditional)*] "]" -> list
    | "{" [pair ("," pair)*] "}" -> object
    | "function" "(" [NAME ("," NAME)*] ")" "{" "return" conditional ";"? "}" -> function
pair: (NAME | TEXT) ":" conditional
EQUALITY: "===" | "!==" | "==" | "!="
RELATION: "<=" | ">=" | "<" | ">"
NOT: "!"
TYPEOF: "typeof"
PLUS: "+"
MINUS: "-"
STAR: "*"
SLASH: "/"
PERCENT: "%"
NUMBER: /0[xX][0-9a-fA-F]+|(?:\d+(?:\.\d*)?|\.\d+)(?:[eE][+-]?\d+)?/
TEXT: /"(?:[^"\\\n]|\\.)*"|'(?:[^'\\\n]|\\.)*'/
NAME: /[A-Za-z_$][A-Za-z0-9_$]*/
%ignore /\s+/
"""
_CONSTANTS: Mapping[str, Any] = {
    "true": True,
    "false": False,
    "null": None,
    "undefined": None,
    "NaN": math.nan,
    "Infinity": math.inf,
}
_ESCAPE = re.compile(r"\\(?:u([0-9a-fA-F]{4})|x([0-9a-fA-F]{2})|(.))")
_ESCAPED = {"n": "\n", "t": "\t", "r": "\r", "b": "\b", "f": "\f", "v": "\v", "0": "\0"}
_DEEPEST = 150


class Unreadable(Exception):  # noqa: N818 - what is wrong is the text, which is reported
    """The string is not a supported expression; the message is the reason."""


@lru_cache(maxsize=1000)
def read(written: str) -> Value:
    """Compile an expression. Raises Unreadable.

    The function raises ExecutionError where ECMAScript throws.
    """
    return _function(parse(written))


@lru_cache(maxsize=1000)
def location(written: str) -> Callable[[InstanceLike, Event, Any], None]:
    """Compile an assignment to a variable or member. Raises Unreadable."""
    tree = parse(written)
    if tree.data == "name":
        name = str(tree.children[0])

        def assign(instance: InstanceLike, event: Event, value: Any) -> None:
            if name not in instance.data:
                raise ExecutionError(f"there is no variable `{name}`")
            instance.data[name] = value

        return assign
    if tree.data not in ("member", "item"):
        raise Unreadable(f"`{written}` cannot be assigned to")
    base = _function(tree.children[0])
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


@cache
def _parser() -> Lark:
    return Lark(_GRAMMAR, parser="lalr", maybe_placeholders=False)


def parse(written: str) -> Tree[Token]:
    """Parse an expression. Raises Unreadable."""
    try:
        tree = _parser().parse(written)
    except UnexpectedInput as error:
        if isinstance(error, UnexpectedToken) and error.token.type == "$END":
            raise Unreadable("it ends early") from None
        start = error.pos_in_stream or 0
        word = written[start : start + 40].split()[0]
        raise Unreadable(f"`{word}` cannot stand here") from None
    depth, level = 0, [tree]
    while level:
        depth += 1
        level = [child for each in level for child in each.children if isinstance(child, Tree)]
    if depth > _DEEPEST:
        raise Unreadable("it is nested too deeply")
    return tree


def _function(tree: Any) -> Value:
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
            values = [_function(child) for child in children]
            return lambda instance, event, names: [v(instance, event, names) for v in values]
        case "object":
            pairs = [(unquoted(pair.children[0]), _function(pair.children[1])) for pair in children]
            return lambda instance, event, names: {
                key: value(instance, event, names) for key, value in pairs
            }
        case "member" | "item":
            return _member(tree)
        case "call":
            return _call(tree)
        case "sign":
            sign, operand = SIGNS[str(children[0])], _function(children[1])
            if children[0] == "typeof" and children[1].data == "name":
                operand = _or_undefined(operand)
            return lambda instance, event, names: sign(operand(instance, event, names))
        case "operation":
            operation = OPERATIONS[str(children[1])]
            left, right = _function(children[0]), _function(children[2])
            return lambda instance, event, names: operation(
                left(instance, event, names), right(instance, event, names)
            )
        case "both" | "either" as word:
            first, second = _function(children[0]), _function(children[1])
            decisive = word == "either"

            def logical(instance: InstanceLike, event: Event, names: Names) -> Any:
                value = first(instance, event, names)
                return value if truth(value) is decisive else second(instance, event, names)

            return logical
        case "choice":
            test, yes, no = map(_function, children)
            return lambda instance, event, names: (
                yes if truth(test(instance, event, names)) else no
            )(instance, event, names)
    raise Unreadable("a function is called where it stands, or not at all")


def _name(name: str) -> Value:
    if name in _CONSTANTS:
        constant = _CONSTANTS[name]
        return lambda instance, event, names: constant
    if name in ("_name", "_sessionid"):
        return lambda instance, event, names: instance.machine.name

    def value(instance: InstanceLike, event: Event, names: Names) -> Any:
        for known in (names, instance.data):
            if name in known:
                return known[name]
        raise ExecutionError(f"`{name}` is not defined")

    return value


def _or_undefined(name: Value) -> Value:
    def value(instance: InstanceLike, event: Event, names: Names) -> Any:
        try:
            return name(instance, event, names)
        except ExecutionError:
            return None

    return value


def _member(tree: Any) -> Value:
    if _is_name(tree.children[0], "_event") and tree.data == "member":
        part = str(tree.children[1])
        if part == "data":
            return lambda instance, event, names: event.data
        if part == "name":
            return lambda instance, event, names: event.name
        raise Unreadable(f"`_event.{part}` is not known, only its `name` and `data`")
    base, key = _function(tree.children[0]), _key(tree)

    def value(instance: InstanceLike, event: Event, names: Names) -> Any:
        held, name = base(instance, event, names), key(instance, event, names)
        if held is None:
            raise ExecutionError(f"undefined has no `{text(name)}`")
        if name == "length" and isinstance(held, (str, list)):
            return len(held)
        if isinstance(held, dict):
            return held.get(text(name))
        if isinstance(held, (str, list)) and type(name) is int and 0 <= name < len(held):
            return held[name]
        return None

    return value


def _key(tree: Any) -> Value:
    if tree.data == "item":
        return _function(tree.children[1])
    name = str(tree.children[1])
    return lambda instance, event, names: name


def _call(tree: Any) -> Value:
    callee, *given = tree.children
    if _is_name(callee, "In") and len(given) == 1:
        # The null data model has no quotes around the id (B.1.2).
        id_ = str(given[0].children[0]) if given[0].data == "name" else None
        state = _function(given[0])
        return lambda instance, event, names: _is_active(
            instance,
            id_ if id_ is not None and id_ not in instance.data else state(instance, event, names),
        )
    if _is_member(callee, "JSON", "parse") and len(given) == 1 and given[0].data == "call":
        inner, *copied = given[0].children
        if _is_member(inner, "JSON", "stringify") and len(copied) == 1:
            value = _function(copied[0])
            return lambda instance, event, names: deepcopy(value(instance, event, names))
    arguments = [_function(each) for each in given]
    if callee.data == "function":
        return _call_function(callee, arguments)
    if callee.data == "member" and callee.children[0].data == "name":
        function = FUNCTIONS.get(f"{callee.children[0].children[0]}.{callee.children[1]}")
        if function is not None:
            return lambda instance, event, names: function(
                *[argument(instance, event, names) for argument in arguments]
            )
    raise Unreadable("only functions of `Math`, and `In`, can be called")


def _call_function(function: Any, arguments: list[Value]) -> Value:
    *parameters, result = function.children
    if len(parameters) != len(arguments):
        raise Unreadable("the function is called with another number of values")
    body = _function(result)
    words = [str(each) for each in parameters]

    def value(instance: InstanceLike, event: Event, names: Names) -> Any:
        given = {w: a(instance, event, names) for w, a in zip(words, arguments, strict=True)}
        return body(instance, event, {**names, **given})

    return value


def _is_active(instance: InstanceLike, state: Any) -> bool:
    return state in instance.machine.numbers and instance.active(state)


def _is_name(tree: Any, name: str) -> bool:
    return bool(tree.data == "name" and tree.children[0] == name)


def _is_member(tree: Any, name: str, member: str) -> bool:
    return bool(
        tree.data == "member" and _is_name(tree.children[0], name) and tree.children[1] == member
    )


def _number(token: str) -> float | int:
    return whole(int(token, 16) if token[1:2] in ("x", "X") else float(token))


def unquoted(token: str) -> str:
    """Return the string value of a literal, or the name itself."""
    if token[0] not in "\"'":
        return str(token)

    def plain(found: re.Match[str]) -> str:
        code = found[1] or found[2]
        return chr(int(code, 16)) if code else _ESCAPED.get(found[3], found[3])

    made = _ESCAPE.sub(plain, token[1:-1])
    # A character above U+FFFF is escaped as a surrogate pair.
    return made.encode("utf-16", "surrogatepass").decode("utf-16", "replace")
