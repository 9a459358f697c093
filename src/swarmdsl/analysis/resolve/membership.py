"""Events that a model has without declaring them: robots that join and that are lost.

Each name means the model's own declaration if there is one.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from functools import cache

from swarmdsl.analysis.resolve.type_names import written_type
from swarmdsl.base.diagnostics.collector import Diagnostics
from swarmdsl.base.source import Source
from swarmdsl.project.loader import File
from swarmdsl.syntax.ast import (
    NEIGHBORS,
    Call,
    Declaration,
    Event,
    Node,
    TopLevel,
    nodes_of,
    references,
)
from swarmdsl.syntax.parse import parse
from swarmdsl.syntax.types import MEMBER

MEMBER_EVENTS = ("member_joined", "member_lost")
"""Names of the events that heartbeats raise."""

_TEXT = f"""package swarmdsl
/// A robot of the swarm is there again.
event member_joined : {MEMBER}
/// A robot of the swarm has not been heard for as long as its swarm says.
event member_lost : {MEMBER}
"""


@cache
def member_events() -> tuple[File, dict[str, Declaration]]:
    """Return the file with the events that heartbeats raise, and the events by name."""
    source = Source("swarmdsl", _TEXT)
    parsed = parse(source, Diagnostics())
    found: dict[str, Declaration] = {}
    for event in parsed.model.declarations:
        assert isinstance(event, Event)
        event.type.type = written_type(event.type)
        found[str(event.name)] = event
    return File(source, parsed, library=True), found


def is_member_event(node: Node | None) -> bool:
    """Return True for an event that heartbeats raise."""
    return isinstance(node, Event) and node.name in MEMBER_EVENTS and node.type.type == MEMBER


def used_member_events(owners: Iterable[Declaration]) -> Iterator[tuple[File, Declaration]]:
    """Yield the events of heartbeats that declarations name."""
    # Of a copied project, the events are copies too.
    refs = (ref for owner in owners for _, ref in references(owner) if ref.name in MEMBER_EVENTS)
    used = {
        ref.name: ref.target
        for ref in refs
        if isinstance(ref.target, Event) and is_member_event(ref.target)
    }
    if used:
        file, _ = member_events()
        yield from ((file, used[name]) for name in MEMBER_EVENTS if name in used)


def neighbor_calls(owner: TopLevel) -> list[Call]:
    """Return the uses of `neighbors within` in a declaration."""
    return [call for call in nodes_of(owner, Call) if call.function == NEIGHBORS]


def presence_calls(owner: TopLevel) -> list[Call]:
    """Return the uses of `present` in a declaration."""
    return [call for call in nodes_of(owner, Call) if call.function == "present"]
