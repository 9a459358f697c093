"""States that a selection in an editor covers."""

from __future__ import annotations

from collections.abc import Iterator

from swarmdsl.analysis.resolve.states import vertices
from swarmdsl.base.records import dataclass
from swarmdsl.base.source import Span
from swarmdsl.driver.workspace.references import owner_at
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
    def shallow_history(self) -> History | None:
        """A history that restores one of the states directly inside their container."""
        found = (each for each in vertices(self.container) if isinstance(each, History))
        return next((each for each in found if not each.deep), None)


def selected_states(file: File, span: Span) -> Selection | None:
    """Return the states that a span covers or touches at their names; None if there are none."""
    machine = owner_at(file, span.start)
    if not isinstance(machine, StateMachine):
        return None
    around: tuple[Container, ...] = (machine,)
    while True:
        inner = next(
            (each for each in _inside(around[0]) if _covers(each.span.absolute, span)), None
        )
        if inner is None:
            found = [each for each in vertices(around[0]) if _overlap(each.span.absolute, span)]
            break
        if span.start <= inner.name.span.absolute.end or not isinstance(
            inner, (State, Parallel, Region)
        ):
            found = [] if isinstance(inner, Region) else [inner]
            break
        around = (inner, *around)
    return Selection(machine, around, tuple(found)) if found else None


def references_to(machine: StateMachine, state: Node) -> Iterator[tuple[Node, Ref[Vertex]]]:
    """Yield the references to a state in its machine, each with its node."""
    return ((node, ref) for node, ref in references(machine) if ref.target is state)


def _inside(container: Container) -> Iterator[Vertex | Region]:
    kinds = (*Vertex.__args__, Region)
    return (each for each in children(container) if isinstance(each, kinds))


def _covers(outer: Span, inner: Span) -> bool:
    return outer.start <= inner.start and inner.end <= outer.end


def _overlap(one: Span, other: Span) -> bool:
    return one.start < other.end and other.start < one.end
