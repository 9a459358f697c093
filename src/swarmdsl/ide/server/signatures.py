"""What a call takes: shown while its arguments are written."""

from __future__ import annotations

from swarmdsl.base.records import dataclass
from swarmdsl.driver.workspace import Workspace
from swarmdsl.ide.server.completion import word_at
from swarmdsl.ide.server.fields import Given, Slots, is_name_on_trial, slots
from swarmdsl.ide.server.speculative_parse import ARGUMENT, NAME, WORD, closers, owner_around, tried
from swarmdsl.project.loader import File
from swarmdsl.syntax.ast import Argument, PartValue, ResultMapping, TopLevel, nodes_of


@dataclass(frozen=True)
class Signature:
    """A call: how it is written, where in that each parameter is, which is being written."""

    label: str
    parameters: list[tuple[int, int, str]]
    active: int | None


def signature(workspace: Workspace, file: File, offset: int) -> Signature | None:
    """The call whose arguments an offset is in; None outside of one."""
    text = file.source.text
    start, end = word_at(text, offset)
    _, first, _ = workspace.piece(file, start)
    head = text[first:start]
    if not closers(head).startswith(")"):
        return None
    words = (*ARGUMENT, *NAME)
    # Which argument it is does not depend on those behind it.
    for owner in tried(workspace, file, (head, ""), owner_around(file, start), words):
        found = slots(owner, workspace.project)
        if found is not None and found.fields:
            return _signature(found, owner, text[start:end])
    return None


def _signature(found: Slots, owner: TopLevel, written: str) -> Signature:
    label = f"{found.of}("
    parameters = []
    for index, field in enumerate(found.fields):
        label += ", " if index else ""
        words = f"{field.name} : {field.type.span.text}"
        parameters.append((len(label), len(label) + len(words), field.doc))
        label += words
    active = _active(found, owner, written)
    return Signature(f"{label})", parameters, active)


def _active(found: Slots, owner: TopLevel, written: str) -> int | None:
    """The parameter whose name or value stands at the place, else the first that is missing."""
    names = [str(field.name) for field in found.fields]
    name = written if is_name_on_trial(owner) else _given(owner)
    left: list[Given] = found.left
    if name in names:
        return names.index(name)
    begins = [str(each.name) for each in left if str(each.name).startswith(written)]
    return names.index(begins[0]) if begins else None


def _given(owner: TopLevel) -> str:
    """The name to which the word on trial gives a value."""
    values: list[Argument | PartValue] = [*nodes_of(owner, Argument), *nodes_of(owner, PartValue)]
    for argument in values:
        if WORD in argument.value.span.text:
            return str(argument.name)
    for result in nodes_of(owner, ResultMapping):
        if WORD in result.target.span.text:
            return str(result.field)
    return ""
