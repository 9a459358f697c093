import sys

import pytest
import pytest_lsp
from lsprotocol import types as lsp
from pytest_lsp import ClientServerConfig, LanguageClient

from .model import MODEL

SERVER = [sys.executable, "-m", "swarmdsl", "lsp"]


@pytest.fixture
def folder(tmp_path):
    (tmp_path / "swarm.toml").write_text('[project]\nname = "patrol"\n')
    (tmp_path / "patrol.swarm").write_text(MODEL)
    (tmp_path / "rover.swarm").write_text(
        'package rover\nimport "patrol.swarm"\nmember Rover { behavior Patrol }\n'
        "swarm Rovers { rover : Rover[2] }\n"
    )
    return tmp_path


@pytest_lsp.fixture(config=ClientServerConfig(server_command=SERVER))
async def client(lsp_client: LanguageClient, folder):
    await lsp_client.initialize_session(
        lsp.InitializeParams(
            capabilities=lsp.ClientCapabilities(),
            workspace_folders=[lsp.WorkspaceFolder(uri=folder.as_uri(), name="models")],
        )
    )
    yield
    await lsp_client.shutdown_session()
