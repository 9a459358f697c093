"""Arrays, queries of them and new messages in expression trees of ECMAScript.

They are found as `codegen/exchange/scxml/arrays.py` writes them.
"""

from __future__ import annotations

from collections.abc import Mapping
from functools import cache
from typing import Any

from lark import Tree

from swarmdsl.base.records import dataclass
from swarmdsl.codegen.exchange.scxml.arrays import ARRAY_FUNCTIONS
from swarmdsl.execution.scxml.grammar import parse

_PARAMETERS = {"item": ("a", "b"), "remove": ("a", "b")}
_MORE = ("a", "b", "c")


@dataclass(frozen=True)
class QueryPattern:
    """Query of an array; `item` and `key_item` are the names in its condition and its key."""

    function: str
    array: Any
    item: str
    condition: Any = None
    key_item: str = ""
    key: Any = None


def array_function(tree: Any) -> str | None:
    """Return `item`, `append`, `remove` or `replace` for its call; None for another tree."""
    if tree.data != "call" or tree.children[0].data != "function":
        return None
    return _functions().get(tree.children[0])


def contained(tree: Any) -> tuple[Any, Any] | None:
    """Return the array and the value of `array.indexOf(value) >= 0`; None for another tree."""
    match tree:
        case Tree(
            data="operation",
            children=[
                Tree(data="call", children=[Tree(data="member", children=[array, name]), value]),
                sign,
                Tree(data="number", children=[zero]),
            ],
        ) if (str(name), str(sign), str(zero)) == ("indexOf", ">=", "0"):
            return array, value
    return None


def query_of(tree: Any) -> QueryPattern | None:
    """Return the query that a tree stands for; None if it is none."""
    match tree:
        case Tree(data="member", children=[inner, name]) if str(name) == "length":
            found = _applied(inner, "filter")
            if found is None:
                return None
            array, (item, condition) = found
            return QueryPattern("count", array, item, condition)
        case Tree(data="call", children=[Tree(data="member", children=[_, name]), _]):
            word = {"some": "any", "every": "all"}.get(str(name))
            found = _applied(tree, str(name)) if word is not None else None
            if word is not None and found is not None:
                array, (item, condition) = found
                return QueryPattern(word, array, item, condition)
            return _extreme(tree) if str(name) == "reduce" else None
    return None


def assigned_fields(tree: Any) -> list[Any] | None:
    """Return the pairs of the new message that `Object.assign` makes; None for another tree."""
    match tree:
        case Tree(
            data="call",
            children=[
                Tree(data="member", children=[Tree(data="name", children=[owner]), name]),
                Tree(data="object"),
                Tree(data="object", children=pairs),
            ],
        ) if (str(owner), str(name)) == ("Object", "assign"):
            return list(pairs)
    return None


def _applied(tree: Any, method: str) -> tuple[Any, list[Any]] | None:
    """Return the list and the parts of the function that a method of it applies."""
    match tree:
        case Tree(
            data="call",
            children=[
                Tree(data="member", children=[array, name]),
                Tree(data="function", children=parts),
            ],
        ) if str(name) == method:
            return array, [str(part) if not isinstance(part, Tree) else part for part in parts]
    return None


def _extreme(tree: Any) -> QueryPattern | None:
    """Return the query of the least or greatest item."""
    found = _applied(tree, "reduce")
    if found is None or len(found[1]) != 3:
        return None
    array, (first, second, choice) = found
    if choice.data != "choice" or choice.children[1:] != [_name(second), _name(first)]:
        return None
    test = choice.children[0]
    if test.data != "operation" or str(test.children[1]) not in ("<", ">"):
        return None
    word = "min" if str(test.children[1]) == "<" else "max"
    right, _, left = test.children
    filtered = _applied(array, "filter")
    item, condition = first, None
    if filtered is not None and len(filtered[1]) == 2:
        array, (item, condition) = filtered
    if (right, left) == (_name(second), _name(first)):
        return QueryPattern(word, array, item, condition)
    if right.data != "call" or left.data != "call" or right.children[0] != left.children[0]:
        return None
    if (right.children[1:], left.children[1:]) != ([_name(second)], [_name(first)]):
        return None
    function = right.children[0]
    if function.data != "function" or len(function.children) != 2:
        return None
    key_item = str(function.children[0])
    item = item if condition is not None else key_item
    return QueryPattern(word, array, item, condition, key_item, function.children[1])


def _name(text: str) -> Any:
    return parse(text)


@cache
def _functions() -> Mapping[Any, str]:
    words = ("item", "append", "remove", "replace")
    return {
        parse(ARRAY_FUNCTIONS[word](_PARAMETERS.get(word, _MORE))).children[0]: word
        for word in words
    }
