"""Hints for expressions with wrong types.

Only a model with mistakes imports this module.
"""

from __future__ import annotations

import re
from collections.abc import Sequence

from swarmdsl.analysis.resolve.interfaces import Interfaces
from swarmdsl.base.diagnostics.advice import write
from swarmdsl.syntax.ast import (
    Call,
    EnumType,
    ExpressionTree,
    FieldUse,
    NameUse,
    OperatorUse,
    Value,
)
from swarmdsl.syntax.types import Array, Named

_LENGTHS = ("len", "length", "size", "count")
_ROLE = re.compile(r'"?([A-Za-z_]\w*)"?(?:\[.*\])?"?')


def query_hint(word: str, said: str, array: str | None) -> str:
    """Hint for a query that does not name the items of an array: `any(offers.price > 3)`."""
    picks = word in ("min", "max")
    if array is None:
        return f"name the items of an array: `{word}(o in array where ...)`"
    of_item = re.sub(rf"\b{re.escape(array)}\b", "o", said)
    if of_item == "o":
        query = f"{word}(o in {array})"
        return write(query) if picks else f"write `{query[:-1]} where ...)`"
    return write(f"{word}(o in {array} {'by' if picks else 'where'} {of_item})")


def role_hint(arguments: Sequence[ExpressionTree]) -> str:
    """Hint for an argument of `present` that is no role."""
    role = _ROLE.fullmatch(arguments[0].span.text)
    return f"it counts the robots of a role: `present({role[1] if role else 'scout'})`"


def field_of_array_hint(array: Array, name: str, text: str, interfaces: Interfaces) -> str | None:
    """Hint for a length as a field of an array, or a field of its items; `text` is the array."""
    if name in _LENGTHS:
        return write(f"len({text})")
    item = array.element
    fields = interfaces.fields(item) if isinstance(item, Named) else None
    if any(each.name == name for each in fields or ()):
        return f"it is a field of each item, such as `{text}[0].{name}`"
    return None


def number_of_robot_hint(tree: Call | OperatorUse) -> str | None:
    """Hint for a comparison of the id of a robot with a number."""
    for use in tree.operands if isinstance(tree, OperatorUse) else ():
        match use:
            case FieldUse(base=NameUse(name="self"), name="id"):
                return "the number of a robot is `self.index`; its id is a string"
    return None


def enum_value_hint(tree: Call | OperatorUse, enums: Sequence[EnumType | None]) -> str | None:
    """Hint for a comparison of the value of an enum with a string or a number."""
    enum = next((each for each in enums if each is not None and each.values), None)
    if enum is None:
        return None
    names = [str(each.name) for each in enum.values]
    for literal in tree.operands if isinstance(tree, OperatorUse) else ():
        if isinstance(literal, Value):
            if literal.value in names:
                return write(f"{enum.name}.{literal.value}")
            return f"compare it with a value of the enum, such as `{enum.name}.{names[0]}`"
    return None
