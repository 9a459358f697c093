"""Lazy definition of the protocol types.

attrs generates and compiles methods for more than 500 classes of `lsprotocol`. That takes longer,
and more memory, than the rest of the start of the server up to its first answer. A session uses a
quarter of them.
"""

from __future__ import annotations

import threading
from importlib.util import find_spec
from types import MethodType
from typing import Any

import attrs

# Messages are read in a separate thread.
_LOCK = threading.RLock()
_define = attrs.define
_unfinished: set[type] = set()
_types_by_name: dict[str, Any] = {}


def load() -> None:
    """Import `lsprotocol` with lazy types, unless it is imported already.

    With a version of it that does not resolve names in annotations, the types are complete at once.
    """
    if find_spec("lsprotocol._hooks") is None:
        return
    attrs.define = _define_lazily  # type: ignore[assignment]  # it has overloads
    try:
        from lsprotocol import types
    finally:
        attrs.define = _define
    from lsprotocol import _hooks

    # Names in annotations are resolved when a type is completed, not for all types at once.
    _hooks._resolved_forward_references = bool(_unfinished)
    _types_by_name.update(types.ALL_TYPES_MAP)


def unfinished() -> frozenset[type]:
    """Return the types that have not been used yet."""
    return frozenset(_unfinished)


def _define_lazily(cls: type | None = None, **options: Any) -> Any:
    """Return a replacement of `attrs.define` that postpones its work."""
    if cls is None or options:
        return _define(cls, **options)
    _unfinished.add(cls)
    for name in ("__init__", "__attrs_attrs__"):
        setattr(cls, name, _LazyAttribute(cls, name))
    return cls


class _LazyAttribute:
    """Descriptor in place of a class attribute until attrs has created it."""

    def __init__(self, cls: type, name: str) -> None:
        self._cls = cls
        self._name = name

    def __get__(self, instance: object, owner: type) -> Any:
        with _LOCK:
            if self._cls in _unfinished:
                # slots=True would create another class, but this one is referenced already.
                _define(self._cls, init=True, slots=False)
                attrs.resolve_types(self._cls, _types_by_name, {})
                _unfinished.discard(self._cls)
        part = vars(self._cls)[self._name]
        return part if instance is None else MethodType(part, instance)
