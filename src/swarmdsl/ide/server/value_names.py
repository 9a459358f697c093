"""Completion of values: names and fields of the expected type before others."""

from __future__ import annotations

from collections.abc import Iterable, Iterator

from swarmdsl.analysis.types import BUILT_INS
from swarmdsl.ide.server.completion_entry import (
    BEST,
    FUNCTION,
    KEYWORD,
    LIKELY,
    POSSIBLE,
    UNLIKELY,
    Completion,
    entry_of,
)
from swarmdsl.ide.server.expected_value import EXACT, MISFIT, ExpectedValue
from swarmdsl.syntax.ast import (
    NEIGHBORS,
    Constant,
    EnumType,
    EnumValue,
    Field,
    Node,
    TypeRef,
    Variable,
    name_of,
)
from swarmdsl.syntax.types import BOOL, Named, Type

# By the fit of a value.
_RANKS = (BEST, LIKELY, POSSIBLE, UNLIKELY)
# Built-in functions whose results change.
_CHANGING = ("present", NEIGHBORS, "elapsed")
# Keywords that begin a value, and whether it changes while the machine runs.
_VALUE_WORDS = {
    "true": False,
    "false": False,
    "not": False,
    "in": True,
    "event": True,
    "self": True,
    "neighbors": True,
}


def value_entries(nodes: Iterable[Node], expected: ExpectedValue) -> Iterator[Completion]:
    """Yield the values among nodes, those of the expected type first, and fields of them."""
    for node in nodes:
        if not _is_legal(node, expected):
            continue
        type_ = _type_of(node)
        fit = expected.fit(type_)
        if isinstance(node, EnumType):
            if fit == EXACT:
                for value in node.values:
                    yield entry_of(value, word=f"{node.name}.{value.name}", rank=BEST)
            fit = min(fit + 1, MISFIT)
        yield entry_of(node, rank=_RANKS[fit])
        if not isinstance(node, EnumType):
            yield from _fields(str(name_of(node)), type_, expected)
    if expected.typing.has_event and not (expected.is_constant or expected.is_stored):
        yield from _fields("event", expected.typing.event, expected)


def function_entries(expected: ExpectedValue) -> Iterator[Completion]:
    """Yield the built-in functions, unless a variable must be named."""
    for name, function in BUILT_INS.items() if not expected.is_stored else ():
        if expected.is_constant and name in _CHANGING:
            continue
        fields = ", ".join(f"${{{n}:{each}}}" for n, each in enumerate(function.parameters, 1))
        text = f"{name} {fields}" if name == NEIGHBORS else f"{name}({fields})"
        fit = expected.fit(function.result)
        rank = UNLIKELY if fit == MISFIT else FUNCTION
        yield Completion(name, function.signature(name), text=text, rank=rank)


def word_rank(word: str, expected: ExpectedValue) -> int | None:
    """Return the rank of a keyword that begins a value; None if it is not legal here."""
    if word not in _VALUE_WORDS:
        return KEYWORD
    if expected.is_stored or (expected.is_constant and _VALUE_WORDS[word]):
        return None
    if word == "event":
        if not (expected.typing.has_event or expected.typing.of_swarm):
            return None
        is_whole = expected.type is not None and expected.typing.event == expected.type
        return BEST if is_whole else KEYWORD
    if word in ("true", "false", "not", "in"):
        if expected.type not in (None, BOOL):
            return None
        is_value = expected.type == BOOL and not expected.is_condition
        return LIKELY if is_value and word in ("true", "false") else KEYWORD
    return KEYWORD


def _is_legal(node: Node, expected: ExpectedValue) -> bool:
    if isinstance(node, (EnumValue, Field)):
        return True
    if expected.is_stored:
        return isinstance(node, Variable)
    if isinstance(node, (Constant, Variable)) and node.name == expected.declared:
        return False
    return not expected.is_constant or isinstance(node, (Constant, EnumType))


def _type_of(node: Node) -> Type | None:
    type_ = getattr(node, "type", None)
    return type_.type if isinstance(type_, TypeRef) else type_


def _fields(base: str, type_: Type | None, expected: ExpectedValue) -> Iterator[Completion]:
    """Yield the fields of a message that have the expected type."""
    if expected.type is None or not isinstance(type_, Named):
        return
    for field in expected.typing.interfaces.fields(type_) or ():
        if isinstance(field, Field) and expected.fit(field.type.type) == EXACT:
            yield entry_of(field, word=f"{base}.{field.name}", rank=BEST)
