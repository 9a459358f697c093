"""What is shown about a name: how it is declared, what it is, and its documentation."""

from __future__ import annotations

from swarmdsl.load import File
from swarmdsl.scopes import bare, kind_of
from swarmdsl.source import Span
from swarmdsl.syntax import (
    ActionType,
    Documented,
    EnumType,
    MessageType,
    Node,
    ServiceType,
    StructType,
)
from swarmdsl.workspace import Workspace
from swarmdsl.workspace.occurrences import occurrence_at

# Of these all of it is shown, as long as it is short.
_WHOLE = (StructType, EnumType, MessageType, ServiceType, ActionType)
_MOST_LINES = 20


def hover(workspace: Workspace, file: File, offset: int) -> tuple[Span, str] | None:
    """The name at an offset, and what to show of it as Markdown; None where nothing is known."""
    found = occurrence_at(workspace, file, offset)
    return (found.span, described(found.node)) if found is not None else None


def described(node: Node) -> str:
    """How something is declared, what it is, and its documentation, as Markdown."""
    parts = [f"```swarm\n{declaration(node)}\n```", bare(kind_of(node))]
    if isinstance(node, Documented) and node.doc:
        parts.append(node.doc)
    return "\n\n".join(parts)


def declaration(node: Node) -> str:
    """The text of a declaration, without what is inside it where that is a block of its own."""
    text = node.span.text
    if isinstance(node, _WHOLE) and text.count("\n") < _MOST_LINES:
        return text
    first = text.partition("\n")[0].rstrip()
    return first.removesuffix("{").rstrip()
