"""Names of a package that are imported from its modules on first use (PEP 562)."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from importlib import import_module
from typing import Any


def lazy_exports(namespace: dict[str, Any], names: Mapping[str, str]) -> Callable[[str], Any]:
    """Return the `__getattr__` of a package whose globals are `namespace`.

    `names` gives for each module the names that are exported from it, separated by blanks.
    """
    modules = {name: module for module, exported in names.items() for name in exported.split()}

    def load(name: str) -> Any:
        if name not in modules:
            raise AttributeError(f"module {namespace['__name__']!r} has no attribute {name!r}")
        found = namespace[name] = getattr(import_module(modules[name]), name)
        return found

    return load
