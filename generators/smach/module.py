"""The generated module of a state machine under construction."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from functools import cached_property

from swarmdsl.codegen import Diagnostics, FreshNames, Span, dataclass, field, snake_case
from swarmdsl.codegen.shared import field_type
from swarmdsl.ir import StateMachine, System, Type

from .imports import Imports

TARGET = "smach"
PREEMPTED = "preempted"


@dataclass(frozen=True)
class Entry:
    """A state added to a container: the statement, and the comments above it."""

    label: str
    statement: str
    comments: tuple[str, ...]


@dataclass(frozen=True)
class Container:
    """A function that builds a StateMachine or a Concurrence, called `variable` in it."""

    function: str
    doc: str
    variable: str
    construction: str
    entries: tuple[Entry, ...]


@dataclass(frozen=True)
class Function:
    """A function of the module with the lines of its body."""

    name: str
    parameters: str
    body: tuple[str, ...]
    comments: tuple[str, ...] = ()


@dataclass
class Module:
    """The module of one state machine."""

    system: System
    machine: StateMachine
    imports: Imports
    report: Diagnostics
    events: dict[str, str]
    containers: list[Container] = field(default_factory=list)
    functions: list[Function] = field(default_factory=list)
    callbacks: list[tuple[str, str, Span | None]] = field(default_factory=list)
    sent: dict[str, None] = field(default_factory=dict)
    _names: FreshNames = field(default_factory=FreshNames)

    def held(self, variable: str, path: tuple[str, ...]) -> Type | None:
        """Return the type of a variable or of its field; None if it is unknown."""
        return field_type(self._types.get(variable), path, self.system)

    @cached_property
    def _types(self) -> Mapping[str, Type]:
        """Types of the variables."""
        return {each.name: each.type for each in self.machine.variables}

    def function_name(self, *words: str) -> str:
        """Return an unused name for a private function."""
        return self._names.new("_" + "_".join(filter(None, map(snake_case, words))))

    def add_function(
        self,
        words: Iterable[str],
        parameters: str,
        body: Iterable[str],
        comments: tuple[str, ...] = (),
    ) -> str:
        """Add a function and return its name."""
        name = self.function_name(*words)
        self.functions.append(Function(name, parameters, tuple(body), comments))
        return name

    def own(self, module: str, name: str) -> str:
        """Import a name from a module of the generated package; return the name."""
        return self.imports.name(f"{self.imports.types.package}.{module}", name)

    def reserve(self) -> int:
        """Reserve the index of a container before the containers inside it."""
        self.containers.append(Container("", "", "", "", ()))
        return len(self.containers) - 1

    def event(self, name: str) -> str:
        """Import an event; return its name in the module."""
        self.imports.name(self.imports.types.package, "events")
        return f"events.{self.events[name]}"

    def unsupported(self, construct: str, at: Span | None, hint: str | None = None) -> None:
        """Report a construct that the target does not support."""
        self.report.report(
            "unsupported-construct", at, target=TARGET, construct=construct, help=hint
        )
