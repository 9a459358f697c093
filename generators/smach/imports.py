"""The imports of one generated module, and how it calls the types it imports."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass

from swarmdsl.ir import Named

from .python import WIDTH

# Names that generated modules use for something else.
_TAKEN = ("Concurrence", "Decision", "Event", "GoalStatus", "Monitor", "StateMachine", "Timer")
_TAKEN_MODULE = "this module"
_STANDARD = ("copy", "math", "sys", "threading")


@dataclass(frozen=True)
class RosTypes:
    """The interfaces a package uses, and which of them it defines itself.

    Where two of them have one name, both are called by their modules.
    """

    package: str
    own: frozenset[Named]
    ambiguous: frozenset[str]

    def ros_package(self, type_: Named) -> str:
        """The ROS package that defines it."""
        return self.package if type_ in self.own else type_.package


def ros_types(package: str, own: Iterable[Named], used: Iterable[tuple[Named, str]]) -> RosTypes:
    """Find the ambiguous names; a type is used as `msg`, `srv` or `action`."""
    types = RosTypes(package, frozenset(own), frozenset())
    owners = {name: {_TAKEN_MODULE} for name in _TAKEN}
    for type_, kind in used:
        module = f"{types.ros_package(type_)}.{'srv' if kind == 'srv' else 'msg'}"
        suffixes = {"srv": ("", "Request"), "action": ("Action", "Goal")}.get(kind, ("",))
        for suffix in suffixes:
            owners.setdefault(type_.name + suffix, set()).add(module)
    ambiguous = frozenset(name for name, modules in owners.items() if len(modules) > 1)
    return RosTypes(package, types.own, ambiguous)


class Imports:
    """Gathers what one module needs."""

    def __init__(self, types: RosTypes) -> None:
        self.types = types
        self._modules: set[str] = set()
        self._names: dict[str, set[str]] = {}

    def module(self, name: str) -> None:
        """Need a module by its own name."""
        self._modules.add(name)

    def name(self, module: str, name: str) -> str:
        """Need a name of a module; return it."""
        self._names.setdefault(module, set()).add(name)
        return name

    def interface(self, type_: Named, kind: str, suffix: str = "") -> str:
        """Need a type of `pkg.msg` or `pkg.srv`; return how to write it."""
        module, name = f"{self.types.ros_package(type_)}.{kind}", type_.name + suffix
        if name not in self.types.ambiguous:
            return self.name(module, name)
        self.module(module)
        return f"{module}.{name}"

    def lines(self) -> list[str]:
        """The import statements: standard library, ROS, this package; blank lines between."""
        groups: dict[int, list[tuple[bool, str, str]]] = {}
        for module in self._modules:
            statement = (False, module, f"import {module}")
            groups.setdefault(self._group(module), []).append(statement)
        for module, names in self._names.items():
            line = _from(module, sorted(names, key=lambda n: (n[0].islower(), n)))
            groups.setdefault(self._group(module), []).append((True, module, line))
        lines: list[str] = []
        for key in sorted(groups):
            lines += [""] if lines else []
            lines += [line for _, _, line in sorted(groups[key])]
        return lines

    def _group(self, module: str) -> int:
        if module in _STANDARD:
            return 0
        return 2 if module.partition(".")[0] == self.types.package else 1


def _from(module: str, names: list[str]) -> str:
    line = f"from {module} import {', '.join(names)}"
    if len(line) <= WIDTH:
        return line
    return "\n".join([f"from {module} import (", *(f"    {name}," for name in names), ")"])
