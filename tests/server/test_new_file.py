"""Tests of files that somebody begins to write: empty, without a name, with mistakes."""

import pytest
from lsprotocol import types as lsp

from .editor import at
from .model import MODEL

pytestmark = pytest.mark.asyncio(loop_scope="module")


async def test_file_without_a_name_has_all_features(client, editor):
    text = MODEL.replace("on Stop -> Home", "on Stop -> Hone")
    document = editor.open("untitled:Untitled-1", text)
    [told] = await editor.told(document)
    assert told.code == "SW0202"
    [action] = await client.text_document_code_action_async(
        lsp.CodeActionParams(
            text_document=document,
            range=told.range,
            context=lsp.CodeActionContext(diagnostics=[told]),
        )
    )
    assert list(action.edit.changes) == [document.uri]
    found = await client.text_document_completion_async(
        lsp.CompletionParams(text_document=document, position=at("Hone", text))
    )
    assert "Home" in [each.label for each in found]
    place = await client.text_document_definition_async(
        lsp.DefinitionParams(text_document=document, position=at("Idle", text))
    )
    assert [each.uri for each in (place if isinstance(place, list) else [place])] == [document.uri]
    symbols = await client.text_document_document_symbol_async(
        lsp.DocumentSymbolParams(text_document=document)
    )
    assert [each.name for each in symbols][-1] == "Patrol"
    edits = await client.text_document_formatting_async(
        lsp.DocumentFormattingParams(
            text_document=document,
            options=lsp.FormattingOptions(tab_size=2, insert_spaces=True),
        )
    )
    assert edits


async def test_empty_file_has_no_error_until_it_is_closed(client, editor, folder):
    path = folder / "new.swarm"
    path.write_text("")
    other = editor.open(folder / "patrol.swarm")
    document = editor.open(path)
    assert await editor.told(document) == []
    editor.type(document, "package new\n")
    assert await editor.told(document) == []
    editor.close(document)
    assert [each.code for each in await editor.told_of(path)] == ["SW0005"]
    assert await editor.told(other) == []


async def test_documentation_has_no_warning_while_it_is_typed(client, editor, folder):
    path = folder / "new.swarm"
    path.write_text("package new\nevent A : std_msgs/Empty\n")
    document = editor.open(path)

    async def codes(line, text):
        at_line = lsp.Position(line=line, character=0)
        editor.type(document, (lsp.Range(start=at_line, end=at_line), text))
        return [each.code for each in await editor.told(document)]

    assert await codes(2, "/// About B") == []
    assert await codes(3, "\n") == []  # the declaration comes next
    assert await codes(0, "\n") == ["SW0105"]  # there is something else to do
    assert await codes(3, "/// Long: ") == []
    editor.changed_on_disk(path)
    assert [each.code for each in await editor.told(document)] == ["SW0105"]


async def test_formatter_tells_once_that_a_file_has_errors(client, editor, folder):
    document = editor.open(folder / "patrol.swarm", MODEL + "statemachine {")
    options = lsp.FormattingOptions(tab_size=2, insert_spaces=True)
    for text, count in ((None, 1), (None, 1), (MODEL, 1), (MODEL + "event", 2)):
        if text is not None:
            editor.type(document, text)
        params = lsp.DocumentFormattingParams(text_document=document, options=options)
        await client.text_document_formatting_async(params)
        told = [each.message for each in client.messages if "patrol.swarm" in each.message]
        assert told == ["patrol.swarm: not formatted: this file has syntax errors"] * count


async def test_states_and_machines_have_icons_of_their_own(client, editor, folder):
    document = editor.open(folder / "patrol.swarm")
    symbols = await client.text_document_document_symbol_async(
        lsp.DocumentSymbolParams(text_document=document)
    )
    [machine] = [each for each in symbols if each.name == "Patrol"]
    [state] = [each for each in machine.children if each.name == "Round"]
    # Editors draw these alike.
    alike = {
        lsp.SymbolKind.Module,
        lsp.SymbolKind.Namespace,
        lsp.SymbolKind.Package,
        lsp.SymbolKind.Object,
    }
    assert machine.kind in alike
    assert state.kind not in alike


async def test_activity_without_goal_and_result_has_no_hint(client, editor, folder):
    document = editor.open(folder / "patrol.swarm")
    last = lsp.Position(line=10**6, character=0)
    found = await client.text_document_inlay_hint_async(
        lsp.InlayHintParams(
            text_document=document,
            range=lsp.Range(start=lsp.Position(line=0, character=0), end=last),
        )
    )
    assert "do go_round" in MODEL
    assert not [each.label for each in found or () if "→" in str(each.label)]
