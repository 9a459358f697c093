"""Documentation of items that are only values in the IR."""

from __future__ import annotations

from collections.abc import Iterable

from swarmdsl import ir
from swarmdsl.syntax.ast import (
    BehaviorUse,
    Defer,
    Documented,
    Entry,
    EnvironmentUse,
    Exit,
    FitnessUse,
    Initial,
    Node,
    Objective,
    PartValue,
    Setting,
    Size,
    World,
)

_ATTRIBUTES: dict[type[Node], str] = {
    BehaviorUse: "behavior",
    Defer: "defer",
    Entry: "entry",
    EnvironmentUse: "environment",
    Exit: "exit",
    FitnessUse: "fitness",
    Initial: "initial",
    Objective: "value",
    Size: "size",
    World: "world",
}


def lower_docs(items: Iterable[Node]) -> ir.Docs:
    """Return the documentation of such items; nodes of the IR have their own."""
    found: dict[str, list[str]] = {}
    for item in items:
        match item:
            case PartValue() | Setting():
                found.setdefault(str(item.name), []).append(item.doc)
            case Documented() if type(item) in _ATTRIBUTES:
                # Effects on entry and deferred events may be on several lines.
                found.setdefault(_ATTRIBUTES[type(item)], []).append(item.doc)
    joined = {name: "\n".join(filter(None, docs)) for name, docs in sorted(found.items())}
    return tuple((name, doc) for name, doc in joined.items() if doc)
