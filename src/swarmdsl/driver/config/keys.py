"""Keys of TOML files: for their readers, and for the schemas that editors use."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from typing import Any, NamedTuple

Shape = Mapping[str, Any]
"""JSON Schema of a value."""


class Key(NamedTuple):
    """Key of a table: the shape of its value, and its documentation."""

    shape: Shape
    text: str


ANY: Shape = {}
TEXT: Shape = {"type": "string", "minLength": 1}


def list_of(shape: Shape) -> Shape:
    """Shape of a list."""
    return {"type": "array", "items": shape}


def one_or_several(shape: Shape) -> Shape:
    """Shape of a value, or of a list of such values."""
    return {"anyOf": [shape, list_of(shape)]}


def one_of(names: Iterable[str]) -> Shape:
    """Shape of a string that is one of some names."""
    return {"enum": list(names)}


def whole(least: int | None = None, most: int | None = None) -> Shape:
    """Shape of an integer in a range."""
    limits = {"minimum": least, "maximum": most}
    return {"type": "integer"} | {name: end for name, end in limits.items() if end is not None}


def table(keys: Mapping[str, Key], required: Iterable[str] = (), **more: Any) -> Shape:
    """Shape of a table with these keys and no others."""
    names = list(required)
    return {
        "type": "object",
        "properties": {name: {"description": key.text, **key.shape} for name, key in keys.items()},
        "additionalProperties": False,
        **({"required": names} if names else {}),
        **more,
    }


def table_of(shape: Shape) -> Shape:
    """Shape of a table with any keys, and values of one shape."""
    return {"type": "object", "additionalProperties": shape}
