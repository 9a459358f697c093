"""Tests of files on disk: which ones are read, and changes of them."""

import pytest
from lsprotocol import types as lsp
from pygls.exceptions import JsonRpcException

from swarmdsl.driver.workspace import Workspace
from swarmdsl.ide.server.models import Models

from .editor import at
from .model import MODEL, ROVER

pytestmark = pytest.mark.asyncio(loop_scope="module")


async def test_rejected_rename_leaves_no_trace(client, editor, folder):
    """A closed file is read from disk again, with its byte order mark and line ends."""
    closed = folder / "rover.swarm"
    closed.write_bytes(b"\xef\xbb\xbf" + ROVER.replace("\n", "\r\n").encode())
    document = editor.open(folder / "patrol.swarm", MODEL.replace("\n", "\r\n"))
    found = await client.text_document_rename_async(
        lsp.RenameParams(text_document=document, position=at("Patrol {"), new_name="Tour")
    )
    assert len(found.changes) == 2
    closed.write_bytes(b"\xef\xbb\xbf" + ROVER.replace("Patrol }", "Petrol }").encode())
    editor.changed_on_disk(closed)
    [told] = await editor.told_of(closed)
    assert told.message.startswith("no state machine called `Petrol`")
    assert await editor.told(document) == []


async def test_overriding_changes_no_text(folder):
    path = folder / "patrol.swarm"
    text = "\ufeff" + MODEL.replace("\n", "\r\n")
    workspace = Workspace([folder], texts={path: text})
    with workspace.overriding({path: "event Other : Nothing", folder / "rover.swarm": "!"}):
        assert workspace.report.has_errors
    assert not workspace.report.has_errors
    assert workspace._store.edited(path) == text
    assert workspace._store.edited(folder / "rover.swarm") is None


async def test_errors_in_the_project_file(client, editor, folder):
    document = editor.open(folder / "patrol.swarm")
    assert await editor.told_of(folder / "swarm.toml") == []
    project = folder / "swarm.toml"
    project.write_text('[project]\nname = "patrol"\nsauces = ["."]\n')
    editor.changed_on_disk(project)
    [found] = await editor.told_of(project)
    assert (found.code, found.range.start.line) == ("SW0012", 2)
    # The workspace is up to date, including unsaved changes of the project file.
    assert await editor.told(document) == []
    opened = editor.open(project, '[project]\nname = "patrol"\nsources = ["rover.swarm"]\n')
    assert await editor.told_of(project) == []
    editor.type(opened, "[project\n")
    [found] = await editor.told_of(project)
    assert found.code == "SW0011"
    editor.close(opened)
    assert [each.code for each in await editor.told_of(project)] == ["SW0012"]


@pytest.mark.parametrize("way", ["file", "ros", "link"])
async def test_files_outside_of_the_workspace_are_not_read(client, editor, folder, tmp_path, way):
    outside = folder.parent / f"outside_of_{folder.name}"
    (outside / "secret_msgs" / "msg").mkdir(parents=True)
    (outside / "secret.swarm").write_text("const SECRET : int32 = 5\n")
    (outside / "secret_msgs" / "msg" / "Key.msg").write_text("int32 secret\n")
    wanted = {"file": f"../{outside.name}/secret.swarm", "ros": f"../{outside.name}"}.get(way)
    if way == "link":
        (folder / "link.swarm").symlink_to(outside / "secret.swarm")
        wanted = "link.swarm"
    path = folder / "open.swarm"
    path.write_text(
        f'import {"ros " if way == "ros" else ""}"{wanted}"\nstruct A {{ x : int32 }}\n'
    )
    document = editor.open(path)
    [found] = [each for each in await editor.told(document) if each.range.start.line == 0]
    assert found.code == "SW0016"
    # Libraries of the project may be read.
    (folder / "swarm.toml").write_text(f'[project]\nlibraries = ["../{outside.name}"]\n')
    editor.changed_on_disk(folder / "swarm.toml")
    assert await editor.told(document) == []


async def test_installed_libraries_are_read(client, editor, folder):
    document = editor.open(
        folder / "uses.swarm",
        "import cpswarm.functions.*\nstatemachine M {\n  initial A\n"
        "  state A { do uav_mavros_takeoff; on succeeded -> B }\n  final B\n}\n",
    )
    assert not [each for each in await editor.told(document) if each.range.start.line == 0]


async def test_file_without_a_project_sees_only_its_folder(tmp_path):
    alone, above = tmp_path / "folder" / "alone.swarm", tmp_path / "above.swarm"
    alone.parent.mkdir()
    (alone.parent / "beside.swarm").write_text("const BESIDE : int32 = 5\n")
    above.write_text("const ABOVE : int32 = 5\n")
    models = Models()
    models.edit(alone, 'import "beside.swarm"\nimport "../above.swarm"\nconst A : int32 = BESIDE\n')
    codes = [each.code for _, _, found in models.diagnostics() for each in found]
    assert codes == ["SW0016"]


async def test_names_in_libraries_cannot_be_renamed(client, editor, folder):
    text = "import cpswarm.functions.*\nmember M { }\n"
    document = editor.open(folder / "uses.swarm", text)
    with pytest.raises(JsonRpcException, match="no name"):
        await client.text_document_rename_async(
            lsp.RenameParams(text_document=document, position=at("cpswarm", text), new_name="x")
        )
