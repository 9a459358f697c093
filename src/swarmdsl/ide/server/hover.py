"""Hover: declaration, kind, documentation and support in targets."""

from __future__ import annotations

from collections.abc import Iterator

from swarmdsl.analysis.called_interface import called_interface
from swarmdsl.analysis.node_kinds import kind_name
from swarmdsl.analysis.property_words import in_words
from swarmdsl.analysis.resolve.interfaces import Interfaces
from swarmdsl.analysis.types import BUILT_INS
from swarmdsl.base.source import Span
from swarmdsl.driver.workspace import Workspace
from swarmdsl.driver.workspace.field_references import part_with
from swarmdsl.driver.workspace.references import occurrence_at, owner_at
from swarmdsl.ide.server.identity import described_at
from swarmdsl.ide.server.keyword_hover import keyword_at
from swarmdsl.ide.server.space_words import described_word
from swarmdsl.ide.server.speculative_parse import declaration_at
from swarmdsl.ide.server.support import support
from swarmdsl.project.loader import File
from swarmdsl.syntax.ast import (
    ActionType,
    Call,
    Communication,
    Documented,
    EnumType,
    Field,
    Function,
    FunctionPort,
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
        return own or _built_in(file, offset) or keyword_at(file, offset)
    targets = "\n".join(f"- {line}" for line in support(found.node, workspace.settings))
    text = "\n\n".join([described(found.node), *_context(found.node, workspace)])
    return found.span, f"{text}\n\nIn targets:\n{targets}" if targets else text


def _context(node: Node, workspace: Workspace) -> Iterator[str]:
    """Yield what a declaration is part of, or what a function takes, gives and connects."""
    if isinstance(node, Field):
        for owner in _interfaces_at(node, workspace):
            part = part_with(node, owner)
            yield f"Of {f'the {part} of ' if part else ''}`{owner.name}`."
    if not isinstance(node, Function):
        return
    call = next((each for each in node.items if isinstance(each, Communication)), None)
    if call is not None:
        yield f"Calls {call.paradigm} `{call.name}` : `{call.type.name}`."
    found = called_interface(node, Interfaces(workspace.project.declarations()))
    lists: list[tuple[str, list[Field]]] = []
    match found:
        case ActionType(goal=goal, result=result):
            lists = [("Goal", goal), ("Result", result)]
        case ServiceType(request=request, response=response):
            lists = [("Request", request), ("Response", response)]
    for title, fields in lists:
        shown = ", ".join(f"`{each.name} : {each.type.span.text}`" for each in fields)
        yield f"{title}: {shown or 'no fields'}."
    ports = [each for each in node.items if isinstance(each, FunctionPort)]
    if ports:
        topics = (f"`{each.direction} {each.topic} : {each.type.name}`" for each in ports)
        yield f"Topics: {', '.join(topics)}."


def _interfaces_at(
    node: Field, workspace: Workspace
) -> Iterator[StructType | MessageType | ServiceType | ActionType]:
    """Yield the interface that declares a field; none for the standard ones of ROS."""
    source, start, _ = node.span.absolute
    file = workspace.file(source.path) if source.path is not None else None
    owner = owner_at(file, start) if file is not None else None
    if isinstance(owner, (StructType, MessageType, ServiceType, ActionType)):
        yield owner


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
