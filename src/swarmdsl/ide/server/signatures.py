"""Signature help: the parameters of the call around the cursor."""

from __future__ import annotations

from swarmdsl.base.records import dataclass
from swarmdsl.driver.workspace import Workspace
from swarmdsl.ide.server.completion import word_at
from swarmdsl.ide.server.fields import Slot, Slots, is_placeholder_name, slots
from swarmdsl.ide.server.speculative_parse import (
    ARGUMENT,
    NAME,
    PLACEHOLDER,
    closing_brackets,
    declaration_at,
    parse_with_placeholder,
)
from swarmdsl.project.loader import File
from swarmdsl.syntax.ast import Argument, PartValue, ResultMapping, TopLevel, nodes_of


@dataclass(frozen=True)
class Signature:
    """Label of a call, spans of its parameters in the label, index of the active one."""

    label: str
    parameters: list[tuple[int, int, str]]
    active: int | None


def signature(workspace: Workspace, file: File, offset: int) -> Signature | None:
    """Return the call around an offset, or None outside of a call."""
    text = file.source.text
    start, end = word_at(text, offset)
    _, first, _ = workspace.fragment_span(file, start)
    head = text[first:start]
    if not closing_brackets(head).startswith(")"):
        return None
    words = (*ARGUMENT, *NAME)
    # The active argument does not depend on the arguments after it.
    for owner in parse_with_placeholder(
        workspace, file, (head, ""), declaration_at(file, start), words
    ):
        found = slots(owner, workspace.project)
        if found is not None and found.fields:
            return _signature(found, owner, text[start:end])
    return None


def _signature(found: Slots, owner: TopLevel, written: str) -> Signature:
    label = f"{found.callee}("
    parameters = []
    for index, field in enumerate(found.fields):
        label += ", " if index else ""
        words = f"{field.name} : {field.type.span.text}"
        parameters.append((len(label), len(label) + len(words), field.doc))
        label += words
    active = _active(found, owner, written)
    return Signature(f"{label})", parameters, active)


def _active(found: Slots, owner: TopLevel, written: str) -> int | None:
    """Return the parameter at the cursor, else the first unassigned one with this prefix."""
    names = [str(field.name) for field in found.fields]
    name = written if is_placeholder_name(owner) else _assigned_name(owner)
    unassigned: list[Slot] = found.unassigned
    if name in names:
        return names.index(name)
    matching = [str(each.name) for each in unassigned if str(each.name).startswith(written)]
    return names.index(matching[0]) if matching else None


def _assigned_name(owner: TopLevel) -> str:
    """Return the name to which the placeholder is assigned."""
    values: list[Argument | PartValue] = [*nodes_of(owner, Argument), *nodes_of(owner, PartValue)]
    for argument in values:
        if PLACEHOLDER in argument.value.span.text:
            return str(argument.name)
    for result in nodes_of(owner, ResultMapping):
        if PLACEHOLDER in result.target.span.text:
            return str(result.field)
    return ""
