"""Handlers of notifications: capabilities, open folders, changes on disk."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping
from pathlib import Path
from typing import Any

from lsprotocol import types as lsp

from swarmdsl.ide.server.session import Session

# Files whose changes on disk the client reports, if it can.
_WATCHED = ("*.swarm", "*.toml", "*.{msg,srv,action}")


def _initialize(session: Session, params: lsp.InitializeParams) -> None:
    session.initialize(params.initialization_options)
    _open_folders(session)


def _initialized(session: Session, _params: lsp.InitializedParams) -> None:
    if not session.has_capability("workspace.did_change_watched_files.dynamic_registration"):
        return
    registration = lsp.Registration(
        id="watched-files",
        method=lsp.WORKSPACE_DID_CHANGE_WATCHED_FILES,
        register_options=lsp.DidChangeWatchedFilesRegistrationOptions(
            watchers=[lsp.FileSystemWatcher(glob_pattern=f"**/{name}") for name in _WATCHED]
        ),
    )
    session.client.client_register_capability(lsp.RegistrationParams(registrations=[registration]))


def _open_folders(session: Session, _params: object = None) -> None:
    """Use the folders that are open in the editor now."""
    workspace = session.client.workspace
    uris = [each.uri for each in workspace.folders.values()]
    if not uris and workspace.root_uri is not None:
        uris = [workspace.root_uri]
    session.open_folders(_paths(session, uris))


def _did_change_files(session: Session, params: lsp.DidChangeWatchedFilesParams) -> None:
    session.refresh(_paths(session, (each.uri for each in params.changes)))


def _paths(session: Session, uris: Iterable[str]) -> list[Path]:
    return [path for uri in uris if (path := session.path(uri)) is not None]


NOTIFICATIONS: Mapping[str, Callable[[Session, Any], Any]] = {
    lsp.INITIALIZE: _initialize,
    lsp.INITIALIZED: _initialized,
    lsp.WORKSPACE_DID_CHANGE_WATCHED_FILES: _did_change_files,
    lsp.WORKSPACE_DID_CHANGE_WORKSPACE_FOLDERS: _open_folders,
}
