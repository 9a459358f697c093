"""States that a selection in an editor covers."""

from __future__ import annotations

from collections.abc import Iterator

from swarmdsl.analysis.resolve.states import vertices
from swarmdsl.base.records import dataclass
from swarmdsl.base.source import Span
from swarmdsl.project.loader import File
from swarmdsl.syntax.ast import (
    Container,
    History,
    Node,
    Parallel,
    Ref,
    Region,
    State,
    StateMachine,
    Vertex,
    children,
    references,
)


@dataclass(frozen=True)
class Selection:
    """States beside each other; `around` are their container and those around it, nearest first."""

    machine: StateMachine
    around: tuple[Container, ...]
    states: tuple[Vertex, ...]

    @property
    def container(self) -> Container:
        """The container of the states."""
        return self.around[0]

    @property
    def composite(self) -> State | None:
        """The composite state that is selected alone; None for anything else."""
        state, *others = self.states
        if others or not isinstance(state, State) or not vertices(state):
            return None
        return state

    @property
    def subject(self) -> str:
        """Name of what is selected, for messages."""
        first, *others = self.states
        return f"`{first.name}`" if not others else f"`{first.name}` and the states with it"

    @property
    def shallow_history(self) -> History | None:
        """A history that restores one of the states directly inside their container."""
        found = (each for each in vertices(self.container) if isinstance(each, History))
        return next((each for each in found if not each.deep), None)


def selected_states(file: File, span: Span) -> Selection | None:
    """Return the states that a span covers or touches; None for none, or those of two machines.

    A place is at a state from the beginning of its line to the end of its name.
    """
    machines = [each for each in file.model.declarations if isinstance(each, StateMachine)]
    touched = [each for each in machines if _meet(each.span.absolute, span)]
    if len(touched) != 1:
        return None
    [machine] = touched
    around: tuple[Container, ...] = (machine,)
    while True:
        inner = next(
            (each for each in _inside(around[0]) if _covers(each.span.absolute, span)), None
        )
        if inner is None:
            found = [each for each in vertices(around[0]) if _meet(each.span.absolute, span)]
            break
        if span.start <= inner.name.span.absolute.end or not isinstance(
            inner, (State, Parallel, Region)
        ):
            found = [] if isinstance(inner, Region) else [inner]
            break
        around = (inner, *around)
    if not found and span.start < span.end and isinstance(around[0], (State, Parallel)):
        found, around = [around[0]], around[1:]  # what is selected is in it
    return Selection(machine, around, tuple(found)) if found else None


def references_to(machine: StateMachine, state: Node) -> Iterator[tuple[Node, Ref[Vertex]]]:
    """Yield the references to a state in its machine, each with its node."""
    return ((node, ref) for node, ref in references(machine) if ref.target is state)


def _inside(container: Container) -> Iterator[Vertex | Region]:
    kinds = (*Vertex.__args__, Region)
    return (each for each in children(container) if isinstance(each, kinds))


def _covers(outer: Span, inner: Span) -> bool:
    return outer.start <= inner.start and inner.end <= outer.end


def _meet(one: Span, other: Span) -> bool:
    """Return True if a selection touches what has a span; an empty one may be at its borders."""
    if other.start == other.end:
        return one.start <= other.start <= one.end
    return one.start < other.end and other.start < one.end
