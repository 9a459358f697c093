"""Handlers for the preview, extensions of the protocol."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import Any

from lsprotocol import types as lsp
from pygls.exceptions import JsonRpcInvalidParams

from swarmdsl.driver.pipeline import Result
from swarmdsl.ide.server.diagram_elements import elements_at
from swarmdsl.ide.server.session import Session


def _pictures(session: Session, params: Any) -> dict[str, Any] | None:
    """Return the diagrams of a model; draw diagram `id` with the nodes in `folded` folded."""
    found = session.file(_document(params))
    if found is None:
        return None
    # Layout and lowering are imported on the first request.
    from swarmdsl.ide.preview.pictures import Pictures, pictures

    workspace = found[0]
    report = workspace.report
    valid = None if report.has_errors else workspace.project
    made = pictures(Result(report, workspace.files, valid))
    if not isinstance(made, Pictures):
        return dict(made)
    wanted, hidden = getattr(params, "id", None), getattr(params, "folded", None)
    return {
        **made.listed(),
        **made.drawn(
            wanted if isinstance(wanted, str) else None,
            [each for each in hidden if isinstance(each, str)] if isinstance(hidden, list) else (),
        ),
    }


def _elements(session: Session, params: Any) -> list[dict[str, str]]:
    """Return the elements of diagrams that show a position, see `elements_at`."""
    document, at = _document(params), getattr(params, "position", None)
    line, character = getattr(at, "line", None), getattr(at, "character", None)
    if not (isinstance(line, int) and isinstance(character, int) and min(line, character) >= 0):
        raise JsonRpcInvalidParams("`position` is missing")
    place = session.place(document, lsp.Position(line, character))
    found = elements_at(*place) if place is not None else []
    return [{"diagram": diagram, "element": element} for diagram, element in found]


def _document(params: Any) -> lsp.TextDocumentIdentifier:
    uri = getattr(getattr(params, "textDocument", None), "uri", None)
    if not isinstance(uri, str):
        raise JsonRpcInvalidParams("`textDocument` is missing")
    return lsp.TextDocumentIdentifier(uri=uri)


REQUESTS: Mapping[str, Callable[[Session, Any], Any]] = {
    "swarmdsl/pictures": _pictures,
    "swarmdsl/diagramElements": _elements,
}
