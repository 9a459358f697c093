"""Hints for expressions with wrong types.

Only a model with mistakes imports this module.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Sequence

from swarmdsl.analysis.resolve.interfaces import Interfaces
from swarmdsl.analysis.types.fitting import is_number, is_text, range_of
from swarmdsl.analysis.types.unit_rules import has_dimension
from swarmdsl.base.diagnostics.advice import Advice, write
from swarmdsl.syntax.ast import (
    Call,
    EnumType,
    ExpressionTree,
    FieldUse,
    NameUse,
    OperatorUse,
    Value,
)
from swarmdsl.syntax.types import BOOL, DURATION, FLOAT, Array, Named, Type, unit_of

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


def mismatch_hint(
    tree: ExpressionTree,
    found: Type | None,
    expected: Type | None,
    interfaces: Interfaces,
    infer: Callable[[ExpressionTree], Type | None],
) -> str | None:
    """Hint for an expression of a type that does not fit the expected one."""
    text = tree.span.text
    enum = interfaces.get(expected) if isinstance(expected, Named) else None
    if isinstance(enum, EnumType) and enum.values and is_number(found):
        value = f"{enum.name}.{enum.values[0].name}"
        return Advice(f"name one of its values: `{value}`", "propose", value)
    if range_of(expected) and found == FLOAT:
        if not isinstance(tree, Value):
            return _whole_number_hint(tree, infer)
        if tree.unit:
            return "its number in the unit of ROS has a fraction: declare it `float64`"
    if expected == DURATION:
        return _duration_hint(tree, found)
    if found == DURATION and is_number(expected):
        return Advice(f"`seconds({text})` is a number in `s`", "propose", f"seconds({text})")
    return _bool_hint(tree, found) if expected == BOOL else None


def _duration_hint(tree: ExpressionTree, found: Type | None) -> str | None:
    """Hint for a number in place of a duration."""
    text = tree.span.text
    if isinstance(tree, Value) and tree.unit == "m":
        return f"`m` is metres: write `{tree.value} min`"
    if has_dimension(unit_of(found)):
        product = f"1 s * ({text} / 1 s)"
        return Advice(f"a duration in seconds: `{product}`", "propose", product)
    if isinstance(tree, Value) and is_number(found):
        return Advice(f"give it a unit: `{text} s`", "add unit", f"{text} s")
    return None


def _whole_number_hint(tree: ExpressionTree, infer: Callable[[ExpressionTree], Type | None]) -> str:
    """Hint for a number with a fraction in place of an integer."""
    text = tree.span.text
    if isinstance(tree, OperatorUse) and tree.operator == "/":
        left, right = tree.operands
        if all(range_of(infer(each)) is not None for each in (left, right)):
            return f"`/` keeps the fraction: write `div({left.span.text}, {right.span.text})`"
    rounded = f"round({text})"
    said = f"write `{rounded}`, or `int(...)` to cut the fraction off"
    return Advice(said, "propose", rounded)


def _bool_hint(tree: ExpressionTree, found: Type | None) -> str | None:
    """Hint for a number or a string in place of a Boolean."""
    text = tree.span.text
    if isinstance(tree, Value):
        word = "true" if tree.value else "false"
        return write(word) if is_number(found) else None
    if "\n" in text:
        return None
    if is_number(found):
        return Advice(f"compare it: `{text} != 0`", "propose", f"{text} != 0")
    return (
        Advice(f'compare it: `{text} != ""`', "propose", f'{text} != ""')
        if is_text(found)
        else None
    )
