"""Modules under their old names, for one release."""

from __future__ import annotations

import warnings
from collections.abc import Callable, Mapping
from importlib import import_module
from typing import Any


def moved(
    old: str, home: str, new: str, renamed: Mapping[str, str] | None = None
) -> Callable[[str], Any]:
    """Return the `__getattr__` of module `old`, which warns and returns the names of `home`.

    `new` is the module that the warning recommends. `renamed` gives the new names of those that
    changed.
    """

    def load(name: str) -> Any:
        if name.startswith("__"):
            raise AttributeError(f"module {old!r} has no attribute {name!r}")
        found = getattr(import_module(home), (renamed or {}).get(name, name))
        message = f"`{old}` is deprecated, import from `{new}`"
        warnings.warn(message, DeprecationWarning, stacklevel=2)
        return found

    return load
