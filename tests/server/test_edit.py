"""Tests of signature help, formatting and incremental changes."""

import pytest
from lsprotocol import types as lsp

from .editor import at, position
from .model import LAID_OUT, MODEL
from .test_completion import HEAD, WORK

pytestmark = pytest.mark.asyncio(loop_scope="module")


def cursor(text):
    """Return a text without its cursor (`|`), and the position of the cursor."""
    offset = text.index("|")
    text = text.replace("|", "", 1)
    return text, position(text, offset)


async def signature(client, editor, folder, line, instead="do sweep(speed = 1.0, area = nothing)"):
    text, place = cursor(HEAD + WORK.replace(instead, line).replace("HERE", ""))
    document = editor.open(folder / "signature.swarm", text)
    found = await client.text_document_signature_help_async(
        lsp.SignatureHelpParams(text_document=document, position=place)
    )
    editor.close(document)
    if found is None:
        return None
    [only] = found.signatures
    marks = [only.label[start:end] for start, end in (each.label for each in only.parameters)]
    active = found.active_parameter
    return only.label, marks[active] if active < len(marks) else None


async def test_signature_help(client, editor, folder):
    of_sweep = "sweep(speed : float64, area : geometry_msgs/Pose)"
    for line, wanted in {
        "do sweep(|": (of_sweep, "speed : float64"),
        "do sweep(speed = |)": (of_sweep, "speed : float64"),
        "do sweep(speed = 1.0, |": (of_sweep, "area : geometry_msgs/Pose"),
        "do sweep(speed = 1.0, ar|": (of_sweep, "area : geometry_msgs/Pose"),
        "do sweep gives (place => |)": (
            "sweep(found : bool, place : geometry_msgs/Point)",
            "place : geometry_msgs/Point",
        ),
        "do arm.grip(|)": ("arm.grip(width : float64)", "width : float64"),
        "on Low / send Seen(|)": (
            "Seen(id : string, place : geometry_msgs/Point)",
            "id : string",
        ),
        "do |sweep": None,
        "// sweep(|": None,
    }.items():
        assert await signature(client, editor, folder, line) == wanted, line


async def test_range_formatting(client, editor, folder):
    text = LAID_OUT.replace("  initial Idle", "initial   Idle").replace(
        "  final Home", "final   Home"
    )
    document = editor.open(folder / "patrol.swarm", text)
    start = at("initial", text, 0)
    [edit] = await client.text_document_range_formatting_async(
        lsp.DocumentRangeFormattingParams(
            text_document=document,
            range=lsp.Range(start=start, end=lsp.Position(line=start.line, character=10)),
            options=lsp.FormattingOptions(tab_size=2, insert_spaces=True),
        )
    )
    assert edit.new_text == "  initial Idle\n"
    assert edit.range.start == lsp.Position(line=start.line, character=0)


async def test_formatting_edits_only_changed_lines(client, editor, folder):
    text = LAID_OUT.replace("  initial Idle", "initial   Idle").replace("\n", "\r\n")
    document = editor.open(folder / "patrol.swarm", text)
    [edit] = await client.text_document_formatting_async(
        lsp.DocumentFormattingParams(
            text_document=document,
            options=lsp.FormattingOptions(tab_size=2, insert_spaces=True),
        )
    )
    assert edit.new_text == "  initial Idle\r\n"
    assert (edit.range.end.line - edit.range.start.line, edit.range.end.character) == (1, 0)


async def test_incremental_changes_in_utf_16(client, editor, folder):
    """Positions are in UTF-16 and refer to the text after the previous changes."""
    document = editor.open(folder / "patrol.swarm")
    start = at("🤖🤖", inside=1)
    change = lsp.Range(
        start=start, end=lsp.Position(line=start.line, character=start.character + 2)
    )
    here = lsp.Position(line=at("initial").line, character=10**6)
    editor.type(
        document,
        (change, "\u2028\f"),
        (lsp.Range(start=here, end=here), "\r\n  nonsense"),
    )
    changed = MODEL.replace("🤖🤖", "🤖\u2028\f", 1).replace("Idle\n", "Idle\n  nonsense\n", 1)
    told = [each.range.start for each in await editor.told(document)]
    assert at("nonsense", changed, 0) in told
    assert lsp.Position(line=start.line, character=start.character + 1) in told
