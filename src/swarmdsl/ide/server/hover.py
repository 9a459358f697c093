"""What is shown about a name: how it is declared, what it is, and its documentation."""

from __future__ import annotations

from collections.abc import Iterator

from swarmdsl.analysis.node_kinds import kind_name
from swarmdsl.base.source import Span
from swarmdsl.driver.workspace import Workspace
from swarmdsl.driver.workspace.references import occurrence_at
from swarmdsl.ide.server.support import support
from swarmdsl.project.loader import File
from swarmdsl.syntax.ast import (
    ActionType,
    Documented,
    EnumType,
    MessageType,
    Multiplicity,
    Node,
    Parallel,
    Role,
    ServiceType,
    State,
    StateMachine,
    StructType,
    TypeRef,
    nodes_of,
)

# Of these all of it is shown, as long as it is short.
_WHOLE = (StructType, EnumType, MessageType, ServiceType, ActionType)
_MOST_LINES = 20


def hover(workspace: Workspace, file: File, offset: int) -> tuple[Span, str] | None:
    """The name at an offset, and what to show of it as Markdown; None where nothing is known."""
    found = occurrence_at(workspace, file, offset)
    if found is None:
        return None
    targets = "\n".join(f"- {line}" for line in support(found.node, workspace.settings))
    text = described(found.node)
    return found.span, f"{text}\n\nIn targets:\n{targets}" if targets else text


def described(node: Node) -> str:
    """How something is declared, what it is, and its documentation, as Markdown."""
    parts = [f"```swarm\n{declaration(node)}\n```", ", ".join([kind_name(node), *_more(node)])]
    if isinstance(node, Documented) and node.doc:
        parts.append(node.doc)
    return "\n\n".join(parts)


def _more(node: Node) -> Iterator[str]:
    """What follows from how something is declared."""
    match node:
        case Role(multiplicity=None):
            yield "one member"
        case Role(multiplicity=Multiplicity(lower=lower, upper=upper)):
            yield _multiplicity(lower, upper)
        case StateMachine():
            states = [*nodes_of(node, State), *nodes_of(node, Parallel)]
            yield f"{len(states)} state{'s' * (len(states) != 1)}"
        case EnumType() | StructType() | MessageType() | ServiceType() | ActionType():
            pass
        case _:
            type_ = getattr(node, "type", None)
            if isinstance(type_, TypeRef) and str(type_.type or "") not in ("", type_.span.text):
                yield f"of type `{type_.type}`"


def _multiplicity(lower: str, upper: str) -> str:
    """How many members a role has, in words."""
    if lower == "*" or (lower == "0" and upper == "*"):
        return "any number of members"
    if upper == "*":
        return f"at least {lower} members"
    if upper and upper != lower:
        return f"{lower} to {upper} members"
    return "one member" if lower == "1" else f"{lower} members"


def declaration(node: Node) -> str:
    """The text of a declaration, without what is inside it where that is a block of its own."""
    text = node.span.text
    if isinstance(node, _WHOLE) and text.count("\n") < _MOST_LINES:
        return text
    first = text.partition("\n")[0].rstrip()
    return first.removesuffix("{").rstrip()
