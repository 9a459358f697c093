"""Handler of `swarmdsl/pictures`, an extension of the protocol for the preview."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import Any

from lsprotocol import types as lsp
from pygls.exceptions import JsonRpcInvalidParams

from swarmdsl.driver.pipeline import Result
from swarmdsl.ide.server.session import Session


def _pictures(session: Session, params: Any) -> dict[str, Any] | None:
    """Return the diagrams of a model; draw diagram `id` with the nodes in `folded` folded."""
    uri = getattr(getattr(params, "textDocument", None), "uri", None)
    if not isinstance(uri, str):
        raise JsonRpcInvalidParams("`textDocument` is missing")
    found = session.file(lsp.TextDocumentIdentifier(uri=uri))
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


REQUESTS: Mapping[str, Callable[[Session, Any], Any]] = {"swarmdsl/pictures": _pictures}
