"""Hover: declaration, kind, documentation and support in targets."""

from __future__ import annotations

from collections.abc import Iterator

from swarmdsl.analysis.node_kinds import kind_name
from swarmdsl.analysis.property_words import in_words
from swarmdsl.analysis.types import BUILT_INS
from swarmdsl.base.source import Span
from swarmdsl.driver.workspace import Workspace
from swarmdsl.driver.workspace.references import occurrence_at, owner_at
from swarmdsl.ide.server.identity import described_at
from swarmdsl.ide.server.space_words import described_word
from swarmdsl.ide.server.speculative_parse import declaration_at
from swarmdsl.ide.server.support import support
from swarmdsl.project.loader import File
from swarmdsl.syntax.ast import (
    ActionType,
    Call,
    Documented,
    EnumType,
    MessageType,
    Multiplicity,
    Node,
    Parallel,
    Property,
    Role,
    ServiceType,
    State,
    StateMachine,
    StructType,
    TypeRef,
    nodes_of,
)
from swarmdsl.syntax.types import written

# Shown in full if they are short.
_SHOWN_IN_FULL = (StructType, EnumType, MessageType, ServiceType, ActionType)
_MAX_LINES = 20


def hover(workspace: Workspace, file: File, offset: int) -> tuple[Span, str] | None:
    """Return the name at an offset and its Markdown, or None if there is none."""
    found = occurrence_at(workspace, file, offset)
    if found is None:
        owner = owner_at(file, offset)
        own = described_at(owner, offset, workspace.project) if owner is not None else None
        if own is None and owner is not None:
            own = described_word(owner, offset)
        return own or _built_in(file, offset)
    targets = "\n".join(f"- {line}" for line in support(found.node, workspace.settings))
    text = described(found.node)
    return found.span, f"{text}\n\nIn targets:\n{targets}" if targets else text


def _built_in(file: File, offset: int) -> tuple[Span, str] | None:
    """Return the built-in function at an offset and its Markdown."""
    owner = declaration_at(file, offset)
    for call in nodes_of(owner, Call) if owner is not None else ():
        span, name = call.function.span.absolute, str(call.function)
        if span.start <= offset <= span.end and name in BUILT_INS:
            known = BUILT_INS[name]
            return span, f"```swarm\n{known.signature(name)}\n```\n\n{known.doc}"
    return None


def described(node: Node) -> str:
    """Return declaration, kind and documentation of a node as Markdown."""
    parts = [f"```swarm\n{declaration(node)}\n```", ", ".join([kind_name(node), *_facts(node)])]
    if isinstance(node, Property):
        parts.append(in_words(node))
    if isinstance(node, Documented) and node.doc:
        parts.append(node.doc)
    return "\n\n".join(parts)


def _facts(node: Node) -> Iterator[str]:
    """Yield facts that the declaration implies."""
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
            if isinstance(type_, TypeRef) and type_.type is not None:
                full = written(type_.type)
                if full != type_.span.text:
                    yield f"of type `{full}`"


def _multiplicity(lower: str, upper: str) -> str:
    """Describe a multiplicity, e.g. "at least 2 members"."""
    if lower == "*" or (lower == "0" and upper == "*"):
        return "any number of members"
    if upper == "*":
        return f"at least {lower} members"
    if upper and upper != lower:
        return f"{lower} to {upper} members"
    return "one member" if lower == "1" else f"{lower} members"


def declaration(node: Node) -> str:
    """Return the text of a declaration, without its body if that is long or a block."""
    text = node.span.text
    if isinstance(node, _SHOWN_IN_FULL) and text.count("\n") < _MAX_LINES:
        return text
    first = text.partition("\n")[0].rstrip()
    return first.removesuffix("{").rstrip()
