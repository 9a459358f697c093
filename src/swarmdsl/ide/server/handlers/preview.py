"""The answer to an editor that shows the diagrams of a model: a request beyond the protocol."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import Any

from lsprotocol import types as lsp
from pygls.exceptions import JsonRpcInvalidParams

from swarmdsl.driver.pipeline import Result
from swarmdsl.ide.server.session import Session


def _pictures(session: Session, params: Any) -> dict[str, Any] | None:
    """The diagrams of the model that a file belongs to, that of `id` drawn with `folded` nodes."""
    uri = getattr(getattr(params, "textDocument", None), "uri", None)
    if not isinstance(uri, str):
        raise JsonRpcInvalidParams("the document is missing")
    found = session.file(lsp.TextDocumentIdentifier(uri=uri))
    if found is None:
        return None
    # Layout and lowering are imported by those who look at pictures.
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


REQUESTS: Mapping[str, Callable[[Session, Any], Any]] = {"swarmdsl/pictures": _pictures}
