"""The bundled server needs only a Python interpreter."""

from __future__ import annotations

import json
import os
import shutil
import subprocess
import sys
import zipfile
from pathlib import Path

import pytest
import pytest_lsp
import tomli
from lsprotocol import types as lsp
from pytest_lsp import ClientServerConfig, LanguageClient

ROOT = Path(__file__).resolve().parents[2]
EXTENSION = ROOT / "editors" / "vscode"
# Without the packages installed here.
BARE = [sys.executable, "-I", "-S", str(EXTENSION / "server")]

BASE = '/// Begin.\nevent Start : std_msgs/Empty on "start"\n'
MODEL = """import "base.swarm"

statemachine Patrol {
  initial Idle
  state Idle { on Start -> Home }
    final Hone
}
"""


@pytest.fixture(scope="module", autouse=True)
def bundle() -> None:
    """Build the bundled server as `make vsix` does."""
    program = [sys.executable, str(EXTENSION / "bundle" / "make.py")]
    made = subprocess.run(program, capture_output=True, text=True)
    if "Could not find a version" in made.stderr or "No matching distribution" in made.stderr:
        pytest.skip("pip cannot fetch the packages of the server: `make vsix`")
    assert made.returncode == 0, made.stderr


@pytest_lsp.fixture(config=ClientServerConfig(server_command=[*BARE, "lsp"]))
async def client(lsp_client: LanguageClient, tmp_path: Path):
    (tmp_path / "swarm.toml").write_text('[project]\nname = "patrol"\nsources = ["."]\n')
    (tmp_path / "base.swarm").write_text(BASE)
    (tmp_path / "patrol.swarm").write_text(MODEL)
    await lsp_client.initialize_session(
        lsp.InitializeParams(
            capabilities=lsp.ClientCapabilities(),
            workspace_folders=[lsp.WorkspaceFolder(uri=tmp_path.as_uri(), name="models")],
        )
    )
    yield
    await lsp_client.shutdown_session()


@pytest.mark.asyncio
async def test_bundle_serves_an_editor(client: LanguageClient, tmp_path: Path) -> None:
    uri = (tmp_path / "patrol.swarm").as_uri()
    client.text_document_did_open(
        lsp.DidOpenTextDocumentParams(
            text_document=lsp.TextDocumentItem(uri=uri, language_id="swarm", version=1, text=MODEL)
        )
    )
    await client.wait_for_notification(lsp.TEXT_DOCUMENT_PUBLISH_DIAGNOSTICS)
    [found] = [each for each in client.diagnostics[uri] if "Home" in each.message]
    document = lsp.TextDocumentIdentifier(uri=uri)
    event = {"text_document": document, "position": lsp.Position(line=4, character=19)}
    hover = await client.text_document_hover_async(lsp.HoverParams(**event))
    assert hover
    assert "Begin." in hover.contents.value
    place = await client.text_document_definition_async(lsp.DefinitionParams(**event))
    assert isinstance(place, lsp.Location)
    assert place.uri.endswith("base.swarm")
    completed = await client.text_document_completion_async(lsp.CompletionParams(**event))
    assert completed
    renamed = await client.text_document_rename_async(lsp.RenameParams(new_name="Go", **event))
    assert renamed
    assert len(renamed.changes or {}) == 2
    [action] = await client.text_document_code_action_async(
        lsp.CodeActionParams(document, found.range, lsp.CodeActionContext([found]))
    )
    assert "Hone" in action.title
    symbols = await client.text_document_document_symbol_async(lsp.DocumentSymbolParams(document))
    assert [each.name for each in symbols or []] == ["Patrol"]
    params = {"textDocument": {"uri": uri}}
    assert await client.protocol.send_request_async("swarmdsl/pictures", params)
    options = lsp.FormattingOptions(tab_size=2, insert_spaces=True)
    edits = await client.text_document_formatting_async(
        lsp.DocumentFormattingParams(document, options)
    )
    assert edits


def test_bundle_runs_tests(tmp_path: Path) -> None:
    for path in (ROOT / "examples" / "minimal").glob("*.*"):
        shutil.copy(path, tmp_path)
    program = [*BARE, "test", "--results", "-", "--coverage", "--play", "run.html"]
    program.append(f"{tmp_path / 'blinker.swarmtest.toml'}::it blinks until it is told to stop")
    ran = subprocess.run(program, capture_output=True, text=True, cwd=tmp_path)
    kinds = [json.loads(line)["type"] for line in ran.stdout.splitlines()]
    assert kinds == ["file", "started", "result", "coverage", "end"]
    assert ran.returncode == 0
    assert (tmp_path / "run.html").is_file()

    wrong = tmp_path / "wrong.swarmtest.toml"
    steps = '[{ all = "blinker", in = "Off" }]'
    wrong.write_text(f'test = [{{ name = "\U0001f916", steps = {steps} }}]', "utf-8")
    failed = subprocess.run(
        [*BARE, "test", str(wrong), "--play", "failed.html"],
        capture_output=True,
        text=True,
        cwd=tmp_path,
        env={**os.environ, "FORCE_COLOR": "1"},  # as in a terminal
    )
    assert "expected all `blinker` in `Off`" in failed.stdout
    assert (failed.returncode, "internal error" in failed.stderr) == (1, False)
    assert (tmp_path / "failed.html").is_file()


def test_bundle_debugs() -> None:
    model = ROOT / "examples" / "minimal" / "blinker.swarm"
    requests = [
        ("initialize", {}),
        ("launch", {"program": str(model), "stopOnEntry": True}),
        ("disconnect", {}),
    ]
    written = b""
    for number, (command, arguments) in enumerate(requests, 1):
        request = {"seq": number, "type": "request", "command": command, "arguments": arguments}
        body = json.dumps(request).encode()
        written += b"Content-Length: %d\r\n\r\n%s" % (len(body), body)
    ran = subprocess.run([*BARE, "debug"], input=written, capture_output=True)
    bodies = [part.partition(b"\r\n\r\n")[2] for part in ran.stdout.split(b"Content-Length: ")]
    messages = [json.loads(body) for body in bodies if body]
    answers = [each for each in messages if each["type"] == "response"]
    assert [(each["command"], each["success"]) for each in answers] == [
        ("initialize", True),
        ("launch", True),
        ("disconnect", True),
    ]
    assert (ran.returncode, ran.stderr) == (0, b"")


def test_bundle_rejects_build() -> None:
    ran = subprocess.run([*BARE, "build", "."], capture_output=True, text=True)
    assert ran.returncode == 1
    assert "install the Python package swarmdsl" in ran.stderr


def test_archive_has_what_the_package_is_built_of() -> None:
    with zipfile.ZipFile(EXTENSION / "swarmdsl.zip") as archive:
        names = {name.removeprefix("swarmdsl/") for name in archive.namelist()}
        settings = tomli.loads(archive.read("swarmdsl/pyproject.toml").decode())
    wheel = settings["tool"]["hatch"]["build"]["targets"]["wheel"]
    folders = [*wheel["packages"], *wheel["force-include"]]
    files = [
        *(settings["project"]["readme"], *settings["project"]["license-files"]),
        *(settings["tool"]["hatch"]["version"]["path"], *wheel["shared-data"]),
    ]
    assert names == {"pyproject.toml", *files} | {
        path.relative_to(ROOT).as_posix()
        for folder in folders
        for path in (ROOT / folder).rglob("*")
        if path.is_file() and "__pycache__" not in path.parts
    }
