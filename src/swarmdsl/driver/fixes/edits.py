"""Fixes whose changes a check has named, and those that move what is there."""

from __future__ import annotations

import re
from collections.abc import Iterator
from pathlib import Path

from swarmdsl.analysis.resolve.inheritance import all_items
from swarmdsl.analysis.resolve.states import vertices
from swarmdsl.base.diagnostics.collector import Fix
from swarmdsl.base.source import Span
from swarmdsl.driver.fixes.bodies import insert, insertion, removal
from swarmdsl.driver.fixes.problem import Problem, Rules, replacing
from swarmdsl.syntax.ast import (
    Choice,
    Connector,
    Member,
    Node,
    Optimization,
    Parallel,
    Part,
    Port,
    Region,
    Role,
    State,
    StateMachine,
    Swarm,
    Transition,
)

_ORDER = re.compile(r"(?<![-=<>])[<>]=?(?![<>])")
_INTERNAL = re.compile(r"internal\s+")


def _edit(problem: Problem, title: str, *parts: Span | str) -> Iterator[Fix]:
    """Replace spans, each by the text after it; not in a library."""
    edits = []
    for span, text in zip(parts[::2], parts[1::2], strict=True):
        assert isinstance(span, Span)
        assert isinstance(text, str)
        source, start, end = span.absolute
        file = problem.workspace.file(source.path) if isinstance(source.path, Path) else None
        if file is None or file.library:
            return
        edits.append((Span(file.source, start, end), text))
    yield Fix(title, tuple(edits))


def _into(problem: Problem, owner: Span) -> Iterator[Fix]:
    """Move the statement into what has a name."""
    node = problem.declared(owner)
    if node is not None:
        yield from _moved(problem.span, node, f"Move it to `{owner.text}`")


def _last(problem: Problem) -> Iterator[Fix]:
    """Move `else` behind the other branches of its choice."""
    choice = problem.around(Choice)
    for branch in choice.branches if choice is not None else ():
        if branch.otherwise and choice is not None:
            yield from _moved(branch.span, choice, "Move `else` to the end")
            return


def _moved(statement: Span, node: Node, title: str) -> Iterator[Fix]:
    """Yield the fix that moves a statement with its comments to the end of a body."""
    place, _ = removal(statement)
    lines = [each.strip() for each in place.text.strip(" \t\n;,").split("\n")]
    text = "\n".join(lines).replace(f"{statement.absolute.text};", statement.absolute.text)
    added = insertion(node, text)
    if added is not None and ("//" not in text or "\n" in added[1]):
        yield Fix(title, ((place, ""), added))


def _remove_all(_problem: Problem, *spans: Span) -> Iterator[Fix]:
    what = "the transition" if len(spans) == 1 else f"the {len(spans)} transitions"
    yield Fix(f"Remove {what}", tuple(map(removal, spans)))


def _port_of(problem: Problem, name: str) -> Iterator[Fix]:
    """Name a port of a part at the end of a connector: those of the right direction."""
    member, connector = problem.around(Member), problem.around(Connector)
    if member is None or connector is None:
        return
    is_source = problem.span.start < connector.source.span.absolute.end
    directions = ("out", "inout") if is_source else ("in", "inout")
    for part in all_items(member, Part):
        if part.name == name and part.component.target is not None:
            for port in all_items(part.component.target, Port):
                if port.direction in directions:
                    yield replacing(problem.span, f"{name}.{port.name}")
            return


def _state_inside(problem: Problem) -> Iterator[Fix]:
    """Name the first state of the container, where a state of another one is named."""
    container = problem.around(State, Region, StateMachine)
    if isinstance(container, (State, Region, StateMachine)):
        states = [each for each in vertices(container) if isinstance(each, (State, Parallel))]
        for state in states[:1]:
            yield replacing(problem.span, str(state.name))


def _equality(problem: Problem) -> Iterator[Fix]:
    """Compare values that have no order."""
    found = list(_ORDER.finditer(problem.span.text))
    if len(found) == 1:
        start = problem.span.start
        place = problem.part(start + found[0].start(), start + found[0].end())
        for operator in ("==", "!="):
            yield replacing(place, operator)


def _external(problem: Problem) -> Iterator[Fix]:
    """Make an internal transition one that leaves its state."""
    transition = problem.around(Transition)
    span = transition.span.absolute if transition is not None else None
    found = _INTERNAL.match(span.text) if span is not None else None
    if span is not None and found is not None:
        edit = (Span(span.source, span.start, span.start + found.end()), "")
        yield Fix("Remove `internal`", (edit,))


def _varied(problem: Problem, name: str) -> Iterator[Fix]:
    """Vary the number of robots of the first role."""
    optimization, swarm = problem.around(Optimization), problem.named(name, Swarm)
    roles = [each for each in swarm.items if isinstance(each, Role)] if swarm is not None else []
    if optimization is not None and roles:
        fix = insert(optimization, f"count of {roles[0].name} in 1 .. 5")
        if fix is not None:
            yield fix


RULES: Rules = {
    "compare": _equality,
    "edit": _edit,
    "make external": _external,
    "move behind": _last,
    "move into": _into,
    "name port": _port_of,
    "remove all": _remove_all,
    "state inside": _state_inside,
    "vary": _varied,
}
