"""The types of the protocol, each finished when it is first used.

`lsprotocol` has more than 500 classes for which attrs writes and compiles methods: that takes
longer, and more memory, than all else from the start of the server to its first answer. A session
uses a quarter of them.
"""

from __future__ import annotations

import threading
from importlib.util import find_spec
from types import MethodType
from typing import Any

import attrs

# What a client sends is read by a thread of its own.
_LOCK = threading.RLock()
_define = attrs.define
_unfinished: set[type] = set()
_known: dict[str, Any] = {}


def load() -> None:
    """Import `lsprotocol`, unless that has been done: then all its types are finished.

    So they are where another version of it has nothing that looks up names in annotations.
    """
    if find_spec("lsprotocol._hooks") is None:
        return
    attrs.define = _defer  # type: ignore[assignment]
    try:
        from lsprotocol import types
    finally:
        attrs.define = _define
    from lsprotocol import _hooks

    # Names in annotations are looked up when a type is finished, not for all types at once.
    _hooks._resolved_forward_references = bool(_unfinished)
    _known.update(types.ALL_TYPES_MAP)


def unfinished() -> frozenset[type]:
    """The types that nobody has used."""
    return frozenset(_unfinished)


def _defer(cls: type | None = None, **options: Any) -> Any:
    """Take a class as `attrs.define` does, and do later what that does."""
    if cls is None or options:
        return _define(cls, **options)
    _unfinished.add(cls)
    for name in ("__init__", "__attrs_attrs__"):
        setattr(cls, name, _Part(cls, name))
    return cls


class _Part:
    """Stands for a part of a class until attrs has made it."""

    def __init__(self, cls: type, name: str) -> None:
        self._cls = cls
        self._name = name

    def __get__(self, instance: object, owner: type) -> Any:
        with _LOCK:
            if self._cls in _unfinished:
                # Slots would need another class, and others know this one.
                _define(self._cls, init=True, slots=False)
                attrs.resolve_types(self._cls, _known, {})
                _unfinished.discard(self._cls)
        part = vars(self._cls)[self._name]
        return part if instance is None else MethodType(part, instance)
