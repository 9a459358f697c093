"""Refactorings as code actions: the state or declaration at a range is changed as a whole.

They are listed by what is at the range; the edit is made, and tried on the model, when an action
is chosen. One that would change the meaning is shown as disabled, with the reason.
"""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Callable, Iterator, Mapping
from itertools import takewhile
from pathlib import Path
from typing import Any

from lsprotocol import types as lsp

from swarmdsl.base.records import dataclass
from swarmdsl.base.source import Source, Span
from swarmdsl.driver.workspace import Workspace
from swarmdsl.driver.workspace.renaming import RefusedError
from swarmdsl.ide.server.layout import line_changes
from swarmdsl.ide.server.positions import position
from swarmdsl.ide.server.session import Session
from swarmdsl.project.loader import File
from swarmdsl.tools.refactor.extract_machine import extract_machine, why_not_extract
from swarmdsl.tools.refactor.inline_state import inline_state, why_not_inline
from swarmdsl.tools.refactor.move_declaration import movable, move_declaration, new_path
from swarmdsl.tools.refactor.selected_states import selected_states
from swarmdsl.tools.refactor.wrap_states import why_not_wrap, wrap_states

WRAP = "refactor.extract.state"
EXTRACT = "refactor.extract.machine"
INLINE = "refactor.inline.state"
MOVE = "refactor.move.file"
RENAME = "swarmdsl.rename"
"""Command of a client that lets the user rename what is at a position of a document."""
_DECLARED = re.compile(r"^ *(?:endless )?(state|statemachine) (\w+)", re.MULTILINE)


@dataclass(frozen=True)
class Refactoring:
    """Change of a model that is offered at a range.

    `texts` makes the new texts of files; with a `reason`, the change is not possible.
    """

    kind: str
    title: str
    texts: Callable[[], dict[Path, str]]
    reason: str | None = None


def refactorings(
    session: Session, workspace: Workspace, file: File, params: lsp.CodeActionParams
) -> Iterator[lsp.CodeAction]:
    """Yield the refactorings at a range, of the kinds that the client asks for.

    Only for clients that ask for the edit of the action that is chosen.
    """
    only = params.context.only
    support = "text_document.code_action"
    if not session.has_capability(f"{support}.resolve_support"):
        return
    shows_reasons = session.has_capability(f"{support}.disabled_support")
    for each in _at(session, workspace, file, params.range):
        if only is not None and not any(f"{each.kind}.".startswith(f"{kind}.") for kind in only):
            continue
        action = lsp.CodeAction(title=each.title, kind=each.kind)
        if each.reason is not None:
            if shows_reasons:
                action.disabled = lsp.CodeActionDisabled(reason=each.reason)
                yield action
            continue
        start, end = params.range.start, params.range.end
        action.data = {
            "kind": each.kind,
            "uri": params.text_document.uri,
            "range": [start.line, start.character, end.line, end.character],
        }
        yield action


def resolved(session: Session, action: lsp.CodeAction) -> lsp.CodeAction:
    """Return an action with its edit; raise RefusedError if it would change the meaning."""
    data: Mapping[str, Any] = action.data if isinstance(action.data, dict) else {}
    found = session.file(lsp.TextDocumentIdentifier(uri=str(data.get("uri", ""))))
    if found is None:
        raise RefusedError("the file is not open")
    workspace, file = found
    line, character, end_line, end_character = data["range"]
    part = lsp.Range(lsp.Position(line, character), lsp.Position(end_line, end_character))
    for each in _at(session, workspace, file, part):
        if each.kind == data["kind"]:
            texts = each.texts()
            action.edit = _edit(session, workspace, texts)
            path = file.source.path
            if each.kind in (WRAP, EXTRACT) and RENAME in session.commands and path is not None:
                at = _new_name(file.source.text, texts[path], session.encoding)
                action.command = lsp.Command("Rename", RENAME, arguments=[data["uri"], at])
            return action
    raise RefusedError("the text has changed")


def _at(
    session: Session, workspace: Workspace, file: File, part: lsp.Range
) -> Iterator[Refactoring]:
    if file.library:
        return
    span = session.span(file, part)
    selection = selected_states(file, span)
    if selection is not None:
        names = ", ".join(f"`{each.name}`" for each in selection.states)
        yield Refactoring(
            WRAP,
            f"Extract {names} into a composite state",
            lambda: wrap_states(workspace, file, selection),
            why_not_wrap(selection),
        )
        inside = "the states of " if selection.composite is not None else ""
        yield Refactoring(
            EXTRACT,
            f"Extract {inside}{names} into a machine",
            lambda: extract_machine(workspace, file, selection),
            why_not_extract(selection),
        )
    if selection is not None and selection.composite is not None:
        yield Refactoring(
            INLINE,
            f"Dissolve composite state `{selection.composite.name}`",
            lambda: inline_state(workspace, file, selection),
            why_not_inline(selection),
        )
    declaration = movable(file, span.start)
    if declaration is not None and _creates_files(session):
        name = getattr(declaration, "name", "")
        yield Refactoring(
            MOVE,
            f"Move `{name}` to `{new_path(file, declaration).name}`",
            lambda: move_declaration(workspace, file, declaration),
        )


def _new_name(old: str, new: str, encoding: str) -> lsp.Position:
    """Return the place of the name of the new machine, else of the new state, in the new text."""
    made = Counter(_DECLARED.findall(new))
    made.subtract(_DECLARED.findall(old))
    lines = zip(old.splitlines(keepends=True), new.splitlines(keepends=True), strict=False)
    start = sum(len(one) for one, _ in takewhile(lambda pair: pair[0] == pair[1], lines))
    found = (each for each in _DECLARED.finditer(new, start) if made[each.groups()] > 0)
    best = max(found, key=lambda each: each[1])
    return lsp.Position(*position(Source("", new), best.start(2), encoding))


def _creates_files(session: Session) -> bool:
    support = "workspace.workspace_edit"
    client = session.client.client_capabilities.workspace
    edits = client.workspace_edit if client is not None else None
    operations = edits.resource_operations or () if edits is not None else ()
    return (
        session.has_capability(f"{support}.document_changes")
        and lsp.ResourceOperationKind.Create in operations
    )


def _edit(session: Session, workspace: Workspace, texts: dict[Path, str]) -> lsp.WorkspaceEdit:
    """Return the edit of the lines that differ; files that are not known are made first."""
    known: dict[str, list[lsp.TextEdit]] = {}
    made: list[lsp.CreateFile | lsp.TextDocumentEdit] = []
    start = lsp.Position(line=0, character=0)
    for path, text in texts.items():
        file, uri = workspace.file(path), session.uri(path)
        if file is None:
            made.append(lsp.CreateFile(uri=uri))
            new = lsp.TextEdit(range=lsp.Range(start=start, end=start), new_text=text)
            made.append(_of_document(uri, [new]))
            continue
        source = file.source
        shown = session.documents.get(path)
        ends = "\r\n" if shown is not None and "\r\n" in shown.text else "\n"
        known[uri] = [
            lsp.TextEdit(range=session.range(span), new_text=new.replace("\n", ends))
            for span, new in line_changes(source, text, Span(source, 0, len(source.text)))
        ]
    if not made:
        return lsp.WorkspaceEdit(changes=known)
    others = [_of_document(uri, edits) for uri, edits in known.items()]
    return lsp.WorkspaceEdit(document_changes=[*made, *others])


def _of_document(uri: str, edits: list[lsp.TextEdit]) -> lsp.TextDocumentEdit:
    document = lsp.OptionalVersionedTextDocumentIdentifier(uri=uri)
    return lsp.TextDocumentEdit(text_document=document, edits=[*edits])
