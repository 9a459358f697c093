"""Digest of a model, by which robots recognize others that run the same one."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import MISSING, fields, is_dataclass
from enum import Enum
from hashlib import sha256
from typing import Any

from swarmdsl.ir import System

_LENGTH = 12
_DOCUMENTATION = ("doc", "docs")


def model_digest(system: System) -> str:
    """Return 12 hexadecimal digits that change with the meaning of the model.

    Places, layout, comments and documentation do not count.
    """
    made = sha256()
    for piece in _pieces(system):
        made.update(piece.encode("utf-8", "surrogatepass"))
        made.update(b"\0")
    return made.hexdigest()[:_LENGTH]


def _pieces(value: Any) -> Iterator[str]:
    """Yield a node field by field; each sequence has its length, so no two trees look alike.

    Fields with their defaults are left out: a later version with more fields has the same digest.
    """
    if isinstance(value, Enum):
        yield f"{type(value).__name__}.{value.name}"
    elif is_dataclass(value):
        yield f"{type(value).__name__} {{"
        for field in fields(value):
            held = getattr(value, field.name)
            if field.compare and field.name not in _DOCUMENTATION and held != _default(field):
                yield field.name
                yield from _pieces(held)
        yield "}"
    elif isinstance(value, (tuple, list)):
        yield f"[{len(value)}"
        for each in value:
            yield from _pieces(each)
    else:
        yield f"{type(value).__name__} {value!r}"


def _default(field: Any) -> Any:
    return field.default_factory() if field.default_factory is not MISSING else field.default


__all__ = ["model_digest"]
