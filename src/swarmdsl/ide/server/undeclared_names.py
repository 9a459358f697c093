"""Names that the model uses and nothing declares, to complete a declaration."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from swarmdsl.ide.server.completion_entry import BEST, Completion
from swarmdsl.ide.server.speculative_parse import PLACEHOLDER
from swarmdsl.project.loader import Project
from swarmdsl.syntax.ast import (
    Choice,
    Event,
    FinalState,
    Function,
    Member,
    Parallel,
    State,
    StateMachine,
    TopLevel,
    nodes_of,
    references,
)

_DECLARATIONS = (Event, Function, Member, StateMachine)


def undeclared_names(owner: TopLevel, project: Project) -> list[Completion] | None:
    """Return the names that the placeholder can declare; None if it declares nothing."""
    vertices: list[State | Parallel | Choice | FinalState] = [
        *nodes_of(owner, State),
        *nodes_of(owner, Parallel),
        *nodes_of(owner, Choice),
        *nodes_of(owner, FinalState),
    ]
    if any(each.name == PLACEHOLDER for each in vertices):
        names = _unresolved("Vertex", [owner])
        return [Completion(name, "target without a state", rank=BEST) for name in names]
    if isinstance(owner, _DECLARATIONS) and owner.name == PLACEHOLDER:
        kind = type(owner).__name__
        owners = [each for _, each in project.declarations()]
        return [
            Completion(name, "not declared yet", rank=BEST) for name in _unresolved(kind, owners)
        ]
    return None


def _unresolved(kind: str, owners: Sequence[TopLevel]) -> Iterator[str]:
    """Yield names of references that mean nothing, each once."""
    found = (
        ref.name
        for owner in owners
        for _, ref in references(owner)
        if ref.kind == kind and ref.target is None and "." not in ref.name
    )
    yield from dict.fromkeys(name for name in found if PLACEHOLDER not in name)
