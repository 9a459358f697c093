"""The server as a process, asked by a client of others what an editor asks."""

import pytest
from lsprotocol import types as lsp
from pygls.exceptions import JsonRpcException

from .model import MODEL

pytestmark = pytest.mark.asyncio


def opened(client, path, text=None):
    text = path.read_text() if text is None else text
    document = lsp.TextDocumentItem(uri=path.as_uri(), language_id="swarm", version=1, text=text)
    client.text_document_did_open(lsp.DidOpenTextDocumentParams(text_document=document))
    return lsp.TextDocumentIdentifier(uri=path.as_uri())


def typed(client, document, text, version=2):
    client.text_document_did_change(
        lsp.DidChangeTextDocumentParams(
            text_document=lsp.VersionedTextDocumentIdentifier(uri=document.uri, version=version),
            content_changes=[lsp.TextDocumentContentChangeWholeDocument(text=text)],
        )
    )


def at(word, text=MODEL, inside=1):
    """The position in a text where a word begins, a little further, in UTF-16."""
    before = text[: text.index(word) + inside]
    line = before.rpartition("\n")[2]
    return lsp.Position(line=before.count("\n"), character=len(line.encode("utf-16-le")) // 2)


def named(found, text=MODEL):
    """The texts of ranges, which are in UTF-16."""
    lines = [line.encode("utf-16-le") for line in text.split("\n")]
    return [
        lines[r.start.line][2 * r.start.character : 2 * r.end.character].decode("utf-16-le")
        for r in found
    ]


async def told(client, document):
    """What is said of a file after all that was sent was answered."""
    await client.text_document_document_symbol_async(
        lsp.DocumentSymbolParams(text_document=document)
    )
    return list(client.diagnostics.get(document.uri, []))


async def test_mistakes_are_told_as_one_types(client, folder):
    document = opened(client, folder / "patrol.swarm")
    assert await told(client, document) == []
    typed(client, document, MODEL.replace("-> Home", "-> Hone", 1))
    [found] = await told(client, document)
    assert found.code == "SW0202"
    assert found.message == "no state called `Hone`\nhelp: did you mean `Home`?"
    assert found.severity == lsp.DiagnosticSeverity.Error
    assert found.code_description.href.endswith("SW0202.md")
    assert named([found.range], MODEL.replace("-> Home", "-> Hone", 1)) == ["Hone"]
    typed(client, document, MODEL, 3)
    assert await told(client, document) == []


async def test_a_mistake_in_one_file_is_told_of_another(client, folder):
    document = opened(client, folder / "patrol.swarm")
    typed(client, document, MODEL.replace("Patrol {", "Petrol {"))
    await told(client, document)
    [found] = client.diagnostics[(folder / "rover.swarm").as_uri()]
    assert found.message.startswith("no state machine called `Patrol`")
    assert found.related_information[0].location.uri == document.uri
    client.text_document_did_close(lsp.DidCloseTextDocumentParams(text_document=document))
    await client.workspace_symbol_async(lsp.WorkspaceSymbolParams(query=""))
    assert not client.diagnostics[(folder / "rover.swarm").as_uri()]


async def test_hover(client, folder):
    document = opened(client, folder / "patrol.swarm")
    for word, shown in {
        "Start [": '```swarm\nevent Start : std_msgs/Empty on "start"\n```\n\nevent\n\nBegin.',
        "Patrol {": "```swarm\nstatemachine Patrol\n```\n\nstate machine",
        "rounds = rounds": "```swarm\nvar rounds : int32 = 0\n```\n\nvariable",
        "FAST] /": "```swarm\nFAST\n```\n\nvalue",
        "initial": None,
        "🤖": None,
    }.items():
        found = await client.text_document_hover_async(
            lsp.HoverParams(text_document=document, position=at(word))
        )
        assert (found.contents.value if found else None) == shown
        if found:
            assert word.startswith(named([found.range])[0])


async def test_definition_in_another_file(client, folder):
    path = folder / "rover.swarm"
    document = opened(client, path)
    found = await client.text_document_definition_async(
        lsp.DefinitionParams(text_document=document, position=at("Patrol }", path.read_text()))
    )
    assert found.uri == (folder / "patrol.swarm").as_uri()
    assert named([found.range]) == ["Patrol"]
    assert found.range.start == at("Patrol {", inside=0)


async def test_references_and_highlights(client, folder):
    document = opened(client, folder / "patrol.swarm")
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


async def test_outline(client, folder):
    document = opened(client, folder / "patrol.swarm")
    found = await client.text_document_document_symbol_async(
        lsp.DocumentSymbolParams(text_document=document)
    )
    assert [each.name for each in found] == ["Start", "Stop", "Mode", "go_round", "Patrol"]
    inside = [each.name for each in found[-1].children]
    assert inside == ["limit", "rounds", "mode", "Idle", "Round", "Home"]
    assert named([found[-1].selection_range]) == ["Patrol"]


async def test_declarations_of_all_files(client, folder):
    opened(client, folder / "patrol.swarm")
    found = await client.workspace_symbol_async(lsp.WorkspaceSymbolParams(query="rov"))
    assert [each.name for each in found] == ["Rover", "Rovers", "rover"]


async def test_completion(client, folder):
    document = opened(client, folder / "patrol.swarm")
    found = await client.text_document_completion_async(
        lsp.CompletionParams(text_document=document, position=at("Home\n    on aborted", inside=0))
    )
    assert {each.label for each in found} == {"Idle", "Round", "Home"}


async def test_formatting(client, folder):
    document = opened(client, folder / "patrol.swarm", MODEL.replace("  initial", "initial"))
    options = lsp.FormattingOptions(tab_size=4, insert_spaces=True)
    [edit] = await client.text_document_formatting_async(
        lsp.DocumentFormattingParams(text_document=document, options=options)
    )
    assert "\n  initial Idle\n" in edit.new_text
    typed(client, document, "event {")
    assert not await client.text_document_formatting_async(
        lsp.DocumentFormattingParams(text_document=document, options=options)
    )


async def test_a_file_of_no_project(client, tmp_path_factory):
    path = tmp_path_factory.mktemp("elsewhere") / "alone.swarm"
    document = opened(client, path, "member M { behavior Nothing }\n")  # not on disk
    [found] = await told(client, document)
    assert found.code == "SW0202"


async def test_a_file_that_is_deleted_while_it_is_open(client, folder):
    path = folder / "patrol.swarm"
    document = opened(client, path)
    path.unlink()
    change = lsp.FileEvent(uri=path.as_uri(), type=lsp.FileChangeType.Deleted)
    client.workspace_did_change_watched_files(lsp.DidChangeWatchedFilesParams(changes=[change]))
    typed(client, document, MODEL.replace("-> Home", "-> Hone", 1))
    assert len(await told(client, document)) == 1


async def test_nonsense_is_answered(client, folder):
    document = opened(client, folder / "patrol.swarm", "}{ \0 \ud83e statemachine")
    far = lsp.Position(line=10**6, character=10**6)
    assert await told(client, document)
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


async def test_rename_across_files(client, folder):
    document = opened(client, folder / "patrol.swarm")
    prepared = await client.text_document_prepare_rename_async(
        lsp.PrepareRenameParams(text_document=document, position=at("Patrol {"))
    )
    assert (prepared.placeholder, named([prepared.range])) == ("Patrol", ["Patrol"])
    assert await renamed(client, document, "Patrol {", "Tour") == {
        "patrol.swarm": [(at("Patrol {").line, "Tour")],
        "rover.swarm": [(2, "Tour")],
    }
    # Nothing has changed: the editor applies the edits.
    assert await told(client, document) == []


async def test_names_that_cannot_be_given(client, folder):
    document = opened(client, folder / "patrol.swarm")
    for word, name, why in (
        ("rounds =", "limit", "taken for something else"),
        ("Idle {", "Home", "taken for something else"),
        ("Idle {", "2nd", "no name"),
        ("Idle {", "state", "a word of the language"),
        ("initial", "first", "no name of something"),
    ):
        with pytest.raises(JsonRpcException, match=why):
            await renamed(client, document, word, name)
    assert await told(client, document) == []


async def test_quick_fixes(client, folder):
    text = MODEL.replace("-> Home", "-> Hone", 1)
    document = opened(client, folder / "patrol.swarm", text)
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
    [action] = await actions(at("Patrol }", text), opened(client, path, text))
    [edit] = action.edit.changes[path.as_uri()]
    assert edit.new_text == 'import "patrol.swarm"\n'
    assert edit.range.start == lsp.Position(line=1, character=0)
