"""Fixtures: one server for all tests of a module, with a client as in an editor."""

import gc
import sys

import pytest
import pytest_lsp
from lsprotocol import types as lsp
from pytest_lsp import ClientServerConfig, LanguageClient

from .editor import Editor
from .model import MODEL, ROVER

SERVER = [sys.executable, "-m", "swarmdsl", "lsp"]


@pytest.fixture(autouse=True)
def stays_frozen(monkeypatch: pytest.MonkeyPatch) -> None:
    """Keep objects frozen by pytest exempt from garbage collections of an in-process server."""
    monkeypatch.setattr(gc, "unfreeze", lambda: None)


@pytest_lsp.fixture(
    scope="module",
    config=ClientServerConfig(server_command=SERVER),
)
async def client(lsp_client: LanguageClient, tmp_path_factory):
    folder = tmp_path_factory.mktemp("open")
    answer = await lsp_client.initialize_session(
        lsp.InitializeParams(
            capabilities=lsp.ClientCapabilities(),
            workspace_folders=[lsp.WorkspaceFolder(uri=folder.as_uri(), name="models")],
        )
    )
    lsp_client.offered = answer.capabilities
    yield
    await lsp_client.shutdown_session()


@pytest.fixture
def folder(tmp_path):
    """Return the folder of a project with two files."""
    (tmp_path / "swarm.toml").write_text('[project]\nname = "patrol"\n')
    (tmp_path / "patrol.swarm").write_text(MODEL, encoding="utf-8")
    (tmp_path / "rover.swarm").write_text(ROVER)
    return tmp_path


@pytest.fixture
def editor(client):
    """Return an editor; all files are closed at the end."""
    editor = Editor(client)
    yield editor
    editor.close_all()
