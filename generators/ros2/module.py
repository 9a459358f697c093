"""The generated module of a state machine under construction."""

from __future__ import annotations

from collections.abc import Iterable

from swarmdsl.codegen import FreshNames, Span, dataclass, snake_case
from swarmdsl.codegen.python import Source, comments
from swarmdsl.ir import StateMachine, System

from .imports import Imports

STEP = "    "
BOTH = "machine, event"


@dataclass(frozen=True)
class Function:
    """A function of the module, with source text for its parts."""

    name: str
    parameters: str
    comments: tuple[str, ...]
    body: tuple[str, ...]


class Module:
    """The module of a state machine; `callbacks` are the user's, with their parameters."""

    def __init__(self, machine: StateMachine, system: System, imports: Imports) -> None:
        self.system = system
        self.imports = imports
        self.types = {variable.name: variable.type for variable in machine.variables}
        self.functions: list[Function] = []
        self.callbacks: list[tuple[str, str, Span | None]] = []
        self._names = FreshNames()

    def new_event(self, name: str) -> str:
        """Return the expression of a new event of the engine."""
        self.imports.own("engine", "Event")
        return f"Event({name!r})"

    def function(
        self, what: str, state: str, parameters: str, lines: Iterable[str], origin: Span | None
    ) -> Source:
        """Add a function for a state; return its name."""
        name = self._names.new(f"{what}_{snake_case(state.replace('.', '_'))}")
        self.functions.append(Function(name, parameters, comments(origin), tuple(lines)))
        return Source(name)
