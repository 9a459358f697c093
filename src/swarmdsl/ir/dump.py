"""IR as indented text, for people: the result of the front end."""

from __future__ import annotations

import json
from collections.abc import Iterator
from dataclasses import MISSING, fields, is_dataclass
from enum import Enum
from functools import cache
from typing import Any, get_args

from swarmdsl.base.records import replace
from swarmdsl.ir.architecture import Multiplicity, PortRef
from swarmdsl.ir.expression_printer import MODEL_FUNCTIONS, Dialect, envelope_name, translate
from swarmdsl.ir.expressions import Expression, Literal
from swarmdsl.ir.system import System
from swarmdsl.syntax.types import DURATION, Array, Named, Primitive, written

_WIDTH = 100
_EXPRESSIONS = get_args(Expression)
_WRITTEN = (Primitive, Named, Array, Multiplicity, PortRef)
_PLAIN = (str, bool, int, float, Enum, *_WRITTEN, *_EXPRESSIONS)


def dump(system: System) -> str:
    """Return the whole system, without fields that are empty or have their default."""
    return "".join(f"{line}\n" for line in _node(system))


def _node(node: Any) -> Iterator[str]:
    """Yield a node on one line if it fits, else with a line for each field."""
    values = dict(_values(node))
    line = " ".join([type(node).__name__, *(f"{name}={v}" for name, v in values.items())])
    if all(isinstance(value, str) for value in values.values()) and len(line) <= _WIDTH:
        yield line
        return
    head = "id" if "id" in values else "name"
    yield " ".join([type(node).__name__, *([values.pop(head)] if head in values else [])])
    for name, value in values.items():
        if isinstance(value, str):
            yield f"  {name}: {value}"
        else:
            yield f"  {name}:"
            for item in value:
                for line in _item(item):
                    yield f"    {line}"


def _values(node: Any) -> Iterator[tuple[str, Any]]:
    """Yield the fields to show: plain ones as strings, others as sequences of nodes."""
    kind: Any = type(node)
    for name, default in _shown_fields(kind):
        value = getattr(node, name)
        if value in ((), None, "") or value == default:
            continue
        if isinstance(value, _PLAIN):
            yield name, _plain(value)
        elif is_dataclass(value):
            yield name, (value,)
        elif all(isinstance(item, _PLAIN) for item in value):
            yield name, " ".join(map(_plain, value))
        else:
            yield name, value


@cache
def _shown_fields(cls: Any) -> tuple[tuple[str, Any], ...]:
    """Return the fields of a class of nodes that may be shown, with their defaults."""
    return tuple(
        (field.name, None if field.default is MISSING else field.default)
        for field in fields(cls)
        if field.compare or field.metadata.get("derived")
    )


def _item(item: Any) -> Iterator[str]:
    if isinstance(item, tuple):
        name, value = item
        yield f"{name} = {_plain(value)}"
    else:
        yield from _node(item)


def _plain(value: Any) -> str:
    if isinstance(value, _EXPRESSIONS):
        return translate(value, _DIALECT)
    if isinstance(value, Enum):
        return str(value.value)
    if isinstance(value, bool):
        return str(value).lower()
    text = written(value) if isinstance(value, (Primitive, Array)) else str(value)
    return json.dumps(text, ensure_ascii=False) if _needs_quotes(text) else text


def _needs_quotes(text: str) -> bool:
    return not text.isprintable() or any(character in text for character in ' "\\')


def _literal(literal: Literal) -> str:
    if literal.name:
        return f"{literal.name} ({_literal(replace(literal, name=''))})"
    if literal.type == DURATION:
        return f"{literal.milliseconds:g} ms"
    return json.dumps(literal.value, ensure_ascii=False)


def _name(name: str) -> str:
    return name


# Expressions as in the model.
_DIALECT = Dialect(
    _literal, _name, _name, "event", envelope_name, "self.{}".format, {}, MODEL_FUNCTIONS
)
