"""What a client tells without asking: which folders and files are open, and what changed."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from pathlib import Path
from typing import Any

from swarmdsl.server.connection import INVALID_PARAMS, Json, RequestError
from swarmdsl.server.documents import Document
from swarmdsl.server.session import Session

# Files whose changes on disk the editor tells of, if it can.
_WATCHED = ("*.swarm", "swarm.toml", "*.{msg,srv,action}")
_INCREMENTAL = 2

CAPABILITIES: Json = {
    "textDocumentSync": {"openClose": True, "change": _INCREMENTAL, "save": False},
    "workspace": {"workspaceFolders": {"supported": True, "changeNotifications": True}},
}


def open_folders(session: Session, params: Json) -> None:
    """Take the folders that are open in the editor when it starts the server."""
    uris = _uris(params.get("workspaceFolders"))
    if not uris and params.get("rootUri") is not None:
        uris = [params["rootUri"]]
    session.models.open_folders(_paths(session, uris))


def _initialized(session: Session, _params: Json) -> bool:
    if session.offers("workspace", "didChangeWatchedFiles", "dynamicRegistration"):
        watchers = [{"globPattern": f"**/{name}"} for name in _WATCHED]
        registration = {
            "id": "watched-files",
            "method": "workspace/didChangeWatchedFiles",
            "registerOptions": {"watchers": watchers},
        }
        session.ask("client/registerCapability", {"registrations": [registration]})
    return False


def _folders_changed(session: Session, params: Json) -> bool:
    event = _object(params, "event")
    gone, new = (_paths(session, _uris(event.get(name))) for name in ("removed", "added"))
    kept = [each for each in session.models.folders if each not in gone]
    session.models.open_folders([*kept, *new])
    return True


def _opened(session: Session, params: Json) -> bool:
    document = _object(params, "textDocument")
    path = session.path(document.get("uri"))
    if path is None:
        return False
    text = document.get("text")
    if not isinstance(text, str):
        raise RequestError(INVALID_PARAMS, "the text is missing")
    session.open(path, document["uri"], Document(text, document.get("version")))
    return True


def _changed(session: Session, params: Json) -> bool:
    found = _object(params, "textDocument")
    path = session.path(found.get("uri"))
    document = session.documents.get(path) if path is not None else None
    if path is None or document is None:
        return False
    try:
        document.change(params["contentChanges"], session.encoding)
    except (KeyError, TypeError, ValueError) as error:
        raise RequestError(INVALID_PARAMS, f"a change is not understood: {error}") from error
    document.version = found.get("version")
    session.edit(path)
    return True


def _closed(session: Session, params: Json) -> bool:
    path = session.path(_object(params, "textDocument").get("uri"))
    if path is not None:
        session.close(path)
    return path is not None


def _on_disk(session: Session, params: Json) -> bool:
    session.models.refresh(_paths(session, _uris(params.get("changes"))))
    return True


def _object(params: Json, name: str) -> Json:
    found = params.get(name)
    if not isinstance(found, dict):
        raise RequestError(INVALID_PARAMS, f"`{name}` is missing")
    return found


def _uris(named: Any) -> list[Any]:
    """The URIs of folders or of changes, as far as there are some."""
    found = named if isinstance(named, list) else []
    return [each["uri"] for each in found if isinstance(each, dict) and "uri" in each]


def _paths(session: Session, uris: list[Any]) -> list[Path]:
    return [path for uri in uris if (path := session.path(uri)) is not None]


NOTIFICATIONS: Mapping[str, Callable[[Session, Json], bool]] = {
    "initialized": _initialized,
    "textDocument/didOpen": _opened,
    "textDocument/didChange": _changed,
    "textDocument/didClose": _closed,
    "workspace/didChangeWatchedFiles": _on_disk,
    "workspace/didChangeWorkspaceFolders": _folders_changed,
}
"""Each returns whether what is wrong may be something else now."""
