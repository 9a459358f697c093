"""Refactorings as code actions: listed, shown as disabled with a reason, and made when chosen."""

import re

import pytest
import pytest_lsp
from lsprotocol import types as lsp
from pygls.exceptions import JsonRpcException
from pytest_lsp import ClientServerConfig, LanguageClient

from .conftest import SERVER
from .editor import Editor, position

pytestmark = pytest.mark.asyncio(loop_scope="module")

MODEL = """\
package a

swarm event Go : std_msgs/Empty

statemachine M {
  initial A
  state A { on Go -> B }
  state B { on Go -> C.D }
  state C {
    entry / send Go
    initial D
    state D { on Go -> Z }
  }
  final Z
}

member R { behavior M }
property P of M : in C leads to in Z within 5 s
"""


@pytest_lsp.fixture(scope="module", config=ClientServerConfig(server_command=SERVER))
async def client(lsp_client: LanguageClient, tmp_path_factory):
    folder = tmp_path_factory.mktemp("open")
    await lsp_client.initialize_session(
        lsp.InitializeParams(
            initialization_options={"commands": ["swarmdsl.rename"]},
            capabilities=lsp.ClientCapabilities(
                workspace=lsp.WorkspaceClientCapabilities(
                    workspace_edit=lsp.WorkspaceEditClientCapabilities(
                        document_changes=True,
                        resource_operations=[lsp.ResourceOperationKind.Create],
                    )
                ),
                text_document=lsp.TextDocumentClientCapabilities(
                    code_action=lsp.CodeActionClientCapabilities(
                        disabled_support=True,
                        resolve_support=lsp.ClientCodeActionResolveOptions(properties=["edit"]),
                    )
                ),
            ),
            workspace_folders=[lsp.WorkspaceFolder(uri=folder.as_uri(), name="models")],
        )
    )
    yield
    await lsp_client.shutdown_session()


@pytest.fixture
def document(client, tmp_path):
    path = tmp_path / "model.swarm"
    path.write_text(MODEL, encoding="utf-8")
    editor = Editor(client)
    yield editor.open(path)
    editor.close_all()


async def offered(client, document, first, last="", only=None):
    """Return the refactorings from one word to another, by title."""
    start = MODEL.index(first)
    end = MODEL.index(last, start) + len(last) if last else start
    found = await client.text_document_code_action_async(
        lsp.CodeActionParams(
            text_document=document,
            range=lsp.Range(start=position(MODEL, start), end=position(MODEL, end)),
            context=lsp.CodeActionContext(diagnostics=[], only=only),
        )
    )
    return {each.title: each for each in found}


def renamed(action, document):
    """Return the word that the client is told to let the user rename after an edit."""
    text = MODEL.splitlines(keepends=True)
    for each in sorted(action.edit.changes[document.uri], key=lambda e: -e.range.start.line):
        start, end = each.range.start, each.range.end
        assert (start.character, end.character) == (0, 0)
        text[start.line : end.line] = [each.new_text]
    uri, at = action.command.arguments
    assert (action.command.command, uri) == ("swarmdsl.rename", document.uri)
    line = "".join(text).splitlines()[at["line"]]
    return re.match(r"\w+", line[at["character"] :])[0]


async def test_states_are_extracted(client, document):
    found = await offered(client, document, "state A", "state B", [lsp.CodeActionKind.Refactor])
    assert list(found) == [
        "Extract `A`, `B` into a composite state",
        "Extract `A`, `B` into a machine",
    ]
    action, other = found.values()
    assert action.edit is None
    chosen = await client.code_action_resolve_async(other)
    assert renamed(chosen, document) == "MAGroup"
    made = chosen.edit
    assert "state AGroup = MAGroup" in "".join(each.new_text for each in made.changes[document.uri])
    chosen = await client.code_action_resolve_async(action)
    assert renamed(chosen, document) == "AGroup"
    edit = chosen.edit
    new = "".join(each.new_text for each in edit.changes[document.uri])
    assert "initial AGroup\n  state AGroup {\n    initial A\n" in new


async def test_reasons_are_shown(client, document):
    found = await offered(client, document, "final Z")
    reason = found["Extract `Z` into a composite state"].disabled.reason
    assert reason == "the final state `Z` ends what it is in"
    found = await offered(client, document, "state C")
    assert found["Dissolve composite state `C`"].disabled.reason == "`C` has effects at its entry"
    assert found["Extract `C` into a composite state"].disabled is None
    assert not await offered(client, document, "state C", only=[lsp.CodeActionKind.QuickFix])


async def test_declaration_moves_to_a_new_file(client, document):
    [action] = (await offered(client, document, "member R")).values()
    assert action.title == "Move `R` to `r.swarm`"
    made, new, old = (await client.code_action_resolve_async(action)).edit.document_changes
    assert made.uri == new.text_document.uri == document.uri.replace("model.swarm", "r.swarm")
    text = 'package a\n\nimport "model.swarm"\n\nmember R { behavior M }\n'
    assert [each.new_text for each in new.edits] == [text]
    assert old.text_document.uri == document.uri


async def test_refused_when_chosen(client, document):
    found = await offered(client, document, "statemachine M")
    with pytest.raises(JsonRpcException, match="use each other"):
        await client.code_action_resolve_async(found["Move `M` to `m.swarm`"])
