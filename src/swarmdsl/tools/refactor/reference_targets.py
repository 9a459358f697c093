"""Targets of the names in a machine, by the paths of states: they stay when states move."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Mapping, Set

from swarmdsl.syntax.ast import (
    Branch,
    Choice,
    FinalState,
    History,
    Initial,
    InState,
    Node,
    Parallel,
    Region,
    State,
    StateMachine,
    Transition,
    children,
)

Path = tuple[str, ...]
_NAMING = (Branch, History, Initial, Transition)


def targets(machine: StateMachine, gone: str) -> Mapping[Path, Set[Path]]:
    """Return the states that are named in each state, by paths without the names of `gone`."""
    paths: dict[Node, Path] = {}
    named: dict[Path, list[Node | None]] = defaultdict(list)
    ahead: list[tuple[Node, Path]] = [(machine, ())]
    while ahead:
        node, path = ahead.pop()
        for child in children(node):
            inner = path
            if isinstance(child, (State, Parallel, Choice, History, FinalState, Region)):
                inner = (*path, str(child.name)) if str(child.name) != gone else path
                paths[child] = inner
            if isinstance(child, _NAMING) and child.target is not None:
                named[path].append(child.target.target)
            if isinstance(child, InState):
                named[path].append(child.state.target)
            ahead.append((child, inner))
    return {
        owner: {paths[node] for node in nodes if node is not None and node in paths}
        for owner, nodes in named.items()
    }
