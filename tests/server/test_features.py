"""Tests of the server process through a third-party client."""

import pytest
from lsprotocol import types as lsp
from pygls.exceptions import JsonRpcException

from .editor import at, named
from .model import LAID_OUT, MODEL

pytestmark = pytest.mark.asyncio(loop_scope="module")


async def test_diagnostics_follow_edits(client, editor, folder):
    document = editor.open(folder / "patrol.swarm")
    assert await editor.told(document) == []
    editor.type(document, MODEL.replace("-> Home", "-> Hone", 1))
    [found] = await editor.told(document)
    assert found.code == "SW0202"
    assert found.message == "no state called `Hone`\nhelp: did you mean `Home`?"
    assert found.severity == lsp.DiagnosticSeverity.Error
    assert found.code_description.href.endswith("SW0202.md")
    assert named([found.range], MODEL.replace("-> Home", "-> Hone", 1)) == ["Hone"]
    editor.type(document, MODEL)
    assert await editor.told(document) == []


async def test_edit_causes_diagnostics_in_another_file(client, editor, folder):
    document = editor.open(folder / "patrol.swarm")
    editor.type(document, MODEL.replace("Patrol {", "Petrol {"))
    await editor.told(document)
    [found] = await editor.told_of(folder / "rover.swarm")
    assert found.message.startswith("no state machine called `Patrol`")
    assert found.related_information[0].location.uri == document.uri
    editor.close(document)
    assert not await editor.told_of(folder / "rover.swarm")


async def test_hover(client, editor, folder):
    document = editor.open(folder / "patrol.swarm")
    for word, shown in {
        "Start [": '```swarm\nevent Start : std_msgs/Empty on "start"\n```\n\nevent\n\nBegin.',
        "Patrol {": "```swarm\nstatemachine Patrol\n```\n\nstate machine, 2 states",
        "rounds = rounds": "```swarm\nvar rounds : int32 = 0\n```\n\nvariable",
        "FAST] /": "```swarm\nFAST\n```\n\nvalue",
        "🤖": None,
    }.items():
        found = await client.text_document_hover_async(
            lsp.HoverParams(text_document=document, position=at(word))
        )
        text = found.contents.value.partition("\n\nIn targets:\n")[0] if found else None
        assert text == shown
        if found:
            assert word.startswith(named([found.range])[0])


async def test_definition_in_another_file(client, editor, folder):
    path = folder / "rover.swarm"
    document = editor.open(path)
    found = await client.text_document_definition_async(
        lsp.DefinitionParams(text_document=document, position=at("Patrol }", path.read_text()))
    )
    assert found.uri == (folder / "patrol.swarm").as_uri()
    assert named([found.range]) == ["Patrol"]
    assert found.range.start == at("Patrol {", inside=0)


async def test_references_and_highlights(client, editor, folder):
    document = editor.open(folder / "patrol.swarm")
    context = lsp.ReferenceContext(include_declaration=True)
    found = await client.text_document_references_async(
        lsp.ReferenceParams(text_document=document, position=at("Patrol {"), context=context)
    )
    assert {(each.uri, each.range.start.line) for each in found} == {
        (document.uri, at("Patrol {").line),
        ((folder / "rover.swarm").as_uri(), 2),
    }
    highlights = await client.text_document_document_highlight_async(
        lsp.DocumentHighlightParams(text_document=document, position=at("rounds <"))
    )
    assert named(each.range for each in highlights) == ["rounds"] * 4
    assert sum(each.kind == lsp.DocumentHighlightKind.Write for each in highlights) == 1


async def test_outline(client, editor, folder):
    document = editor.open(folder / "patrol.swarm")
    found = await client.text_document_document_symbol_async(
        lsp.DocumentSymbolParams(text_document=document)
    )
    assert [each.name for each in found] == ["Start", "Stop", "Mode", "go_round", "Patrol"]
    inside = [each.name for each in found[-1].children]
    assert inside == ["limit", "rounds", "mode", "Idle", "Round", "Home"]
    assert named([found[-1].selection_range]) == ["Patrol"]


async def test_workspace_symbols(client, editor, folder):
    editor.open(folder / "patrol.swarm")
    found = await client.workspace_symbol_async(lsp.WorkspaceSymbolParams(query="rov"))
    assert [each.name for each in found] == ["Rover", "Rovers", "rover"]


async def test_completion(client, editor, folder):
    document = editor.open(folder / "patrol.swarm")
    found = await client.text_document_completion_async(
        lsp.CompletionParams(text_document=document, position=at("Home\n    on aborted", inside=0))
    )
    assert {each.label for each in found} == {"Idle", "Round", "Home"}


async def test_formatting(client, editor, folder):
    document = editor.open(folder / "patrol.swarm", LAID_OUT.replace("  initial", "initial"))
    options = lsp.FormattingOptions(tab_size=4, insert_spaces=True)
    [edit] = await client.text_document_formatting_async(
        lsp.DocumentFormattingParams(text_document=document, options=options)
    )
    assert edit.new_text == "  initial Idle\n"
    editor.type(document, "event {")
    assert not await client.text_document_formatting_async(
        lsp.DocumentFormattingParams(text_document=document, options=options)
    )


async def test_file_without_a_project(client, editor, tmp_path_factory):
    path = tmp_path_factory.mktemp("elsewhere") / "alone.swarm"
    document = editor.open(path, "member M { behavior Nothing }\n")  # not on disk
    [found] = await editor.told(document)
    assert found.code == "SW0202"


async def test_open_file_is_deleted(client, editor, folder):
    path = folder / "patrol.swarm"
    document = editor.open(path)
    path.unlink()
    editor.changed_on_disk(path, lsp.FileChangeType.Deleted)
    editor.type(document, MODEL.replace("-> Home", "-> Hone", 1))
    assert len(await editor.told(document)) == 1


async def test_invalid_requests_are_answered(client, editor, folder):
    document = editor.open(folder / "patrol.swarm", "}{ \0 \ud83e statemachine")
    far = lsp.Position(line=10**6, character=10**6)
    assert await editor.told(document)
    assert not await client.text_document_hover_async(
        lsp.HoverParams(text_document=document, position=far)
    )
    other = lsp.TextDocumentIdentifier(uri="untitled:Untitled-1")
    assert not await client.text_document_hover_async(
        lsp.HoverParams(text_document=other, position=far)
    )


async def renamed(client, document, word, name, text=MODEL):
    found = await client.text_document_rename_async(
        lsp.RenameParams(text_document=document, position=at(word, text), new_name=name)
    )
    return {
        uri.rpartition("/")[2]: [(each.range.start.line, each.new_text) for each in edits]
        for uri, edits in found.changes.items()
    }


async def test_rename_across_files(client, editor, folder):
    document = editor.open(folder / "patrol.swarm")
    prepared = await client.text_document_prepare_rename_async(
        lsp.PrepareRenameParams(text_document=document, position=at("Patrol {"))
    )
    assert (prepared.placeholder, named([prepared.range])) == ("Patrol", ["Patrol"])
    assert await renamed(client, document, "Patrol {", "Tour") == {
        "patrol.swarm": [(at("Patrol {").line, "Tour")],
        "rover.swarm": [(2, "Tour")],
    }
    # The file is unchanged: the editor applies the edits.
    assert await editor.told(document) == []


async def test_rename_to_invalid_names(client, editor, folder):
    document = editor.open(folder / "patrol.swarm")
    for word, name, why in (
        ("rounds =", "limit", "declared twice"),
        ("Idle {", "Home", "declared twice"),
        ("Idle {", "2nd", "not a valid name"),
        ("Idle {", "state", "is a keyword"),
        ("initial", "first", "no name declared"),
    ):
        with pytest.raises(JsonRpcException, match=why):
            await renamed(client, document, word, name)
    assert await editor.told(document) == []


async def test_quick_fixes(client, editor, folder):
    text = MODEL.replace("-> Home", "-> Hone", 1)
    document = editor.open(folder / "patrol.swarm", text)
    place = at("Hone", text)

    async def actions(position, document=document):
        return await client.text_document_code_action_async(
            lsp.CodeActionParams(
                text_document=document,
                range=lsp.Range(start=position, end=position),
                context=lsp.CodeActionContext(diagnostics=[]),
            )
        )

    [action] = await actions(place)
    [edit] = action.edit.changes[document.uri]
    assert (action.title, edit.new_text) == ("Change to `Home`", "Home")
    assert named([edit.range], text) == ["Hone"]
    assert not await actions(at("Idle {", text))

    path = folder / "rover.swarm"
    text = path.read_text().replace('import "patrol.swarm"\n', "")
    [action] = await actions(at("Patrol }", text), editor.open(path, text))
    [edit] = action.edit.changes[path.as_uri()]
    assert edit.new_text == '\n\nimport "patrol.swarm"'
    assert edit.range.start == lsp.Position(line=0, character=text.index("\n"))


async def test_imports_follow_a_renamed_file(client, editor, folder):
    path = folder / "rover.swarm"
    document = editor.open(path)
    text = path.read_text()

    async def changes(old, new):
        move = lsp.FileRename(old_uri=old.as_uri(), new_uri=new.as_uri())
        return await client.workspace_will_rename_files_async(lsp.RenameFilesParams(files=[move]))

    found = await changes(folder / "patrol.swarm", folder / "machines" / "round.swarm")
    [edit] = found.changes[document.uri]
    assert (edit.new_text, named([edit.range], text)) == ("machines/round.swarm", ["patrol.swarm"])
    found = await changes(path, folder / "deep" / "rover.swarm")
    [edit] = found.changes[document.uri]
    assert edit.new_text == "../patrol.swarm"
    position = at('"patrol.swarm"', text)
    location = await client.text_document_definition_async(
        lsp.DefinitionParams(text_document=document, position=position)
    )
    assert location.uri == (folder / "patrol.swarm").as_uri()


async def test_all_safe_fixes_on_request(client, editor, folder):
    text = MODEL.replace("[mode == Mode.FAST]", "[mode == FAST]").replace("-> Home", "-> Hone", 1)
    document = editor.open(folder / "patrol.swarm", text)
    actions = await client.text_document_code_action_async(
        lsp.CodeActionParams(
            text_document=document,
            range=lsp.Range(start=at("Idle {", text), end=at("Idle {", text)),
            context=lsp.CodeActionContext(diagnostics=[], only=["source.fixAll"]),
        )
    )
    [action] = actions
    [edit] = action.edit.changes[document.uri]
    assert action.kind == "source.fixAll.swarmdsl"
    assert "[mode == Mode.FAST]" in edit.new_text
    assert "Hone" not in edit.new_text
