"""Imports of a generated module, and the names of the imported types."""

from __future__ import annotations

from collections.abc import Iterable

from swarmdsl.codegen import dataclass
from swarmdsl.codegen.python import WIDTH, Constants
from swarmdsl.ir import Named

# Names that generated modules use for other things.
_TAKEN = (
    "AT_ONCE",
    "ActionState",
    "Concurrence",
    "Event",
    "Final",
    "History",
    "Machine",
    "On",
    "ServiceState",
    "State",
    "StateMachine",
    "bounded",
    "build",
    "callbacks",
    "concurrence",
    "elapsed",
    "envelope",
    "copy",
    "event",
    "events",
    "goal",
    "initial_userdata",
    "is_active",
    "machine",
    "math",
    "message",
    "request",
    "require",
    "response",
    "result",
    "rospy",
    "smach",
    "userdata",
)
_TAKEN_MODULE = "this module"
_STANDARD = ("copy", "math")


@dataclass(frozen=True)
class RosTypes:
    """The generated package, and the interface names that are ambiguous in it.

    Such an interface is qualified with its module.
    """

    package: str
    ambiguous: frozenset[str]


def ros_types(package: str, taken: Iterable[str], used: Iterable[tuple[Named, str]]) -> RosTypes:
    """Find ambiguous names among types that are used as `msg`, `srv` or `action`."""
    owners = {name: {_TAKEN_MODULE} for name in (*_TAKEN, *taken)}
    for type_, kind in used:
        module = f"{type_.package}.{'srv' if kind == 'srv' else 'msg'}"
        suffixes = {"srv": ("", "Request"), "action": ("Action", "Goal")}.get(kind, ("",))
        for suffix in suffixes:
            owners.setdefault(type_.name + suffix, set()).add(module)
    return RosTypes(package, frozenset(name for name, known in owners.items() if len(known) > 1))


class Imports:
    """Collects the imports of a module."""

    def __init__(self, types: RosTypes) -> None:
        self.types = types
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

    def interface(self, type_: Named, kind: str, suffix: str = "") -> str:
        """Import a type of `pkg.msg` or `pkg.srv`; return its name in the module."""
        module, name = f"{type_.package}.{kind}", type_.name + suffix
        if name not in self.types.ambiguous:
            return self.name(module, name)
        self.module(module)
        return f"{module}.{name}"

    def lines(self) -> list[str]:
        """Return the import statements (standard library, ROS, this package), then constants."""
        groups: dict[int, list[tuple[bool, str, str]]] = {}
        for module in self._modules:
            statement = (False, module, f"import {module}")
            groups.setdefault(self._group(module), []).append(statement)
        for module, names in self._names.items():
            line = _from(module, sorted(names, key=_by_kind))
            groups.setdefault(self._group(module), []).append((True, module, line))
        lines: list[str] = []
        for key in sorted(groups):
            lines += [""] if lines else []
            lines += [line for _, _, line in sorted(groups[key])]
        values = self.constants.lines()
        return [*lines, "", *values] if values else lines

    def _group(self, module: str) -> int:
        if module in _STANDARD:
            return 0
        return 2 if module.partition(".")[0] == self.types.package else 1


def _by_kind(name: str) -> tuple[int, str]:
    """Return a key that sorts constants first, then classes, then functions."""
    constant = name.isupper() and len(name) > 1
    return (0 if constant else 1 if name[0].isupper() else 2), name


def _from(module: str, names: list[str]) -> str:
    line = f"from {module} import {', '.join(names)}"
    if len(line) <= WIDTH:
        return line
    return "\n".join([f"from {module} import (", *(f"    {name}," for name in names), ")"])
