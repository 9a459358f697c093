"""Imports of a generated module."""

from __future__ import annotations

import sys
from collections.abc import Iterable, Mapping

from swarmdsl.codegen.python import Constants
from swarmdsl.ir import Named

from .names import type_name

WIDTH = 99
# Names that modules of state machines use for other things.
_TAKEN = ("BEHAVIOR", "CHART", "CONDITIONS", "FUNCTIONS", "PARAMETERS", "STATES", "TOPICS")


class Imports:
    """Collects the imports of a module; interfaces are qualified with their modules."""

    def __init__(self, messages_of_actions: Mapping[Named, str]) -> None:
        self.messages_of_actions = messages_of_actions
        self._modules: set[str] = set()
        self._names: dict[str, set[str]] = {}
        self.constants = Constants(_TAKEN)

    def module(self, name: str) -> None:
        """Import a module by its own name."""
        self._modules.add(name)

    def name(self, module: str, name: str) -> str:
        """Import a name from a module; return the name."""
        self._names.setdefault(module, set()).add(name)
        return name

    def own(self, module: str, name: str) -> str:
        """Import a name from another module of the package; return the name."""
        return self.name(f".{module}", name)

    def interface(self, type_: Named, kind: str) -> str:
        """Import an interface, a `msg`, `srv` or `action`; return its qualified name."""
        if type_ in self.messages_of_actions:
            self.module(f"{type_.package}.action")
            return self.messages_of_actions[type_]
        self.module(f"{type_.package}.{kind}")
        return f"{type_.package}.{kind}.{type_name(type_.name)}"

    def lines(self) -> list[str]:
        """Return the import statements in the order that the linters of ROS require.

        Blank lines separate the standard library, ROS and the package; constants come last.
        """
        groups: dict[int, list[tuple[str, str]]] = {}
        for module in self._modules:
            groups.setdefault(_group(module), []).append((module.lower(), f"import {module}"))
        for module, names in self._names.items():
            line = _from(module, sorted(names, key=str.lower))
            groups.setdefault(_group(module), []).append((module.lower(), line))
        lines: list[str] = []
        for key in sorted(groups):
            lines += [""] if lines else []
            lines += [line for _, line in sorted(groups[key])]
        values = self.constants.lines()
        return [*lines, "", *values] if values else lines


def _group(module: str) -> int:
    if module.startswith("."):
        return 2
    return 0 if module.partition(".")[0] in sys.stdlib_module_names else 1


def _from(module: str, names: Iterable[str]) -> str:
    line = f"from {module} import {', '.join(names)}"
    if len(line) <= WIDTH:
        return line
    return "\n".join([f"from {module} import (", *(f"    {name}," for name in names), ")"])
