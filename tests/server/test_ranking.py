"""Tests of the order of completions: what is wanted is among the first three."""

import os

import pytest
from lsprotocol import types as lsp

from swarmdsl.base.diagnostics.collector import Diagnostics
from swarmdsl.base.source import Source
from swarmdsl.ide.server.completion import completions
from swarmdsl.ide.server.models import Models
from swarmdsl.syntax.formatter import format_source

from .editor import position
from .flows import FUNCTIONS, GIVEN, MODEL, flows
from .patrol import PATROL, lines
from .suggest import Suggest
from .test_completion import HEAD, state

LIBRARY = HEAD.replace("package here\n", "package here\nimport cpswarm.events.*\n")
HEIGHT = (
    HEAD
    + """\
enum Speed { WALK RUN }
action Fly { goal { altitude : float64 in m, speed : Speed } result { pose : geometry_msgs/Pose } }
message Level { height : float64 in m, name : string }
event Measured : Level
function fly : abstraction { action "fly" : Fly }
statemachine Pilot {
  param name : string = "a"
  param reach : float64 in m = 5 m
  var target_pose : geometry_msgs/Pose
  var level : Level
  var turns : int32
  var done_once : bool
  initial Up
  state Up {
    HERE
  }
  state Down { on Low -> Over }
  final Over
}
"""
)


def pilot(line):
    return HEIGHT.replace("HERE", line)


# What is wanted among the first three at the cursor (`|`), where nothing is typed yet.
POSITIONS = {
    "number in metres": (pilot("do fly(altitude = |)"), "reach"),
    "field of an event as a number": (
        pilot("on Measured / send Measured(height = |)"), "event.height",
    ),
    "value of an enum": (pilot("do fly(speed = |)"), "Speed.WALK"),
    "where a result goes": (pilot("do fly gives (pose => |)"), "target_pose"),
    "field of a goal": (pilot("do fly(|)"), "altitude"),
    "field of a result": (pilot("do fly gives (|)"), "pose"),
    "default of a param": (HEAD + "statemachine M { param first : int32 = |", "MOST"),
    "Boolean in a guard": (pilot("on Low [|"), "done_once"),
    "number beside another": (pilot("on Low [turns < |"), "turns"),
    "text beside another": (pilot('on Low [name == |'), "name"),
    "condition behind another": (pilot("on Low [turns > 3 and |"), "done_once"),
    "assigned Boolean": (pilot("on Low / done_once = |"), "true"),
    "assigned message": (pilot("on Measured / level = |"), "event"),
    "changed variable": (pilot("on Low / |"), "target_pose"),
    "unit of a time": (pilot("after 5 |"), "s"),
    "unit of a length": (pilot("do fly(altitude = 5 |"), "m"),
    "type of a swarm event": (HEIGHT + "swarm event E : |", "Level"),
    "type of a variable": (HEIGHT.replace("var turns : int32", "var turns : |"), "float64"),
    "type of a port": (HEAD + "sensor S { out image : |", "sensor_msgs/Image"),
    "action of a function": (HEIGHT + 'function f : abstraction { action "f" : |', "Fly"),
    "file": ('import "|"', "other.swarm"),
    "package": ("import cpswarm.|", "cpswarm.costs.*"),
    "event": (pilot("on |"), "Low"),
    "event that is not handled": (pilot("on Low -> Down\n    on |"), "High"),
    "outcome": (pilot("do fly\n    on |"), "succeeded"),
    "outcome that is left": (pilot("do fly\n    on succeeded -> Down\n    on |"), "aborted"),
    "end of a state": (state("on |"), "done"),
    "target": (pilot("on Low -> |"), "Over"),
    "target that nothing reaches": (pilot("on Low -> |"), "Down"),
    "initial state": (HEIGHT.replace("initial Up", "initial |"), "Up"),
    "function": (pilot("do |"), "fly"),
    "sent event": (pilot("on Low / send |"), "High"),
    "machine of a member": (HEIGHT + "member Drone { behavior | }", "Pilot"),
    "member of a swarm": (HEIGHT + "member Drone { behavior Pilot } swarm S { a : | }", "Drone"),
    "begin of a state": (pilot("|"), "on"),
    "begin of a machine": (HEAD + "statemachine M {\n  |\n}", "initial"),
    "name of a missing state": (
        HEIGHT.replace("on Low -> Over", "on Low -> Parked").replace("final Over", "final |"),
        "Parked",
    ),
}  # fmt: skip


def words(tmp_path, text):
    """Return the completions at the cursor, in order."""
    offset = text.index("|")
    (tmp_path / "other.swarm").write_text("package other\nevent Elsewhere : std_msgs/Empty\n")
    models = Models([tmp_path])
    models.edit(tmp_path / "model.swarm", text.replace("|", "", 1))
    found = completions(*models.file(tmp_path / "model.swarm"), offset)
    return [each.word for each in found]


def test_wanted_is_among_the_first_three(tmp_path):
    missed = {
        place: found[:4]
        for place, (text, wanted) in POSITIONS.items()
        if wanted not in (found := words(tmp_path, text))[:3]
    }
    assert len(POSITIONS) == 37
    assert missed == {}


# What must not be offered at a position, although the grammar allows it.
ILLEGAL = {
    "number in metres": {"event", "true", "fly"},
    "where a result goes": {"event", "true", "self", "MOST", "min", "reach"},
    "default of a param": {"first", "event", "self", "elapsed", "present"},
    "type of a swarm event": {"string", "float64", "Speed", "Mode"},
    "action of a function": {"Level", "string"},
    "unit of a length": {"s", "kg", "rad"},
    "unit of a time": {"m", "kg"},
    "text beside another": {"true", "not"},
}


def test_illegal_is_not_offered(tmp_path):
    offered = {place: set(words(tmp_path, POSITIONS[place][0])) for place in ILLEGAL}
    assert {place: offered[place] & ILLEGAL[place] for place in ILLEGAL} == {
        place: set() for place in ILLEGAL
    }


@pytest.mark.asyncio(loop_scope="module")
async def test_names_are_in_the_list_as_they_are_typed(client, editor, tmp_path):
    (tmp_path / "swarm.toml").write_text('[project]\nname = "patrol"\n')
    (tmp_path / "flying.swarm").write_text(FUNCTIONS)
    document = editor.open(tmp_path / "patrol.swarm", GIVEN)
    lines = GIVEN.split("\n")
    hidden = {}
    for flow in flows():
        before, after = "\n".join(lines[: flow.line]), "\n" + "\n".join(lines[flow.line :])
        suggest = Suggest(client, editor, document, before, after)
        found = await suggest.type(flow.typed)
        labels = [item.label for item in found[:3]]
        if flow.wanted not in labels:
            hidden[flow.typed] = labels
        lines[flow.line - 1] += flow.chosen + flow.then
    assert len(flows()) >= 20
    assert hidden == {}
    assert "\n".join(lines) == MODEL
    editor.type(document, MODEL)
    found = await editor.told(document)
    assert [each.code for each in found if each.severity == lsp.DiagnosticSeverity.Error] == []


@pytest.mark.asyncio(loop_scope="module")
async def test_first_item_completes_the_words_of_a_new_user(client, editor, tmp_path):
    document = editor.open(tmp_path / "patrol.swarm", "")
    text = ""
    others = {}
    for line, layout in zip(lines(), PATROL.splitlines(), strict=True):
        text += layout[: len(layout) - len(layout.lstrip())]
        for piece in line:
            opened = text.count("{") - text.count("}")
            suggest = Suggest(client, editor, document, text, "\n}" * opened)
            found = await suggest.type(piece.typed) if piece.completed else []
            if piece.completed and (not found or found[0].label != piece.text):
                others[layout, piece.typed] = [item.label for item in found[:3]]
            text += piece.text
        text += "\n"
    assert others == {}
    assert text == PATROL
    editor.type(document, text)
    assert await editor.told(document) == []


@pytest.mark.asyncio(loop_scope="module")
async def test_typed_character_begins_a_list_only_before_a_name(client, editor, tmp_path):
    for text, char, wanted in (
        (pilot("on |"), " ", True),
        (pilot("on Low |"), " ", False),
        (pilot(" |"), " ", False),
        (pilot("on Low /|"), "/", False),
        (HEIGHT + "event E : std_msgs/|", "/", True),
        (HEIGHT + 'event E : Level on "|', '"', False),
    ):
        offset = text.index("|")
        document = editor.open(tmp_path / "model.swarm", text.replace("|", "", 1))
        found = await client.text_document_completion_async(
            lsp.CompletionParams(
                text_document=document,
                position=position(text, offset),
                context=lsp.CompletionContext(
                    trigger_kind=lsp.CompletionTriggerKind.TriggerCharacter,
                    trigger_character=char,
                ),
            )
        )
        editor.close(document)
        assert bool(found) == wanted, text[offset - 20 : offset]


def test_folders_and_packages_of_ros_are_offered(tmp_path, monkeypatch):
    messages = tmp_path / "ws" / "lamp_msgs" / "msg"
    index = tmp_path / "ros" / "share" / "ament_index" / "resource_index" / "rosidl_interfaces"
    messages.mkdir(parents=True)
    index.mkdir(parents=True)
    (messages / "Lamp.msg").write_text("bool on\n")
    (index / "nav2_msgs").touch()
    prefixes = os.pathsep.join(map(str, (tmp_path / "ros", tmp_path / "gone")))
    monkeypatch.setenv("AMENT_PREFIX_PATH", prefixes)
    assert words(tmp_path, 'import ros "|"') == ["ws/lamp_msgs", "nav2_msgs"]
    assert words(tmp_path, 'import ros "nav2_msgs"\nimport ros "|"') == ["ws/lamp_msgs"]


@pytest.mark.asyncio(loop_scope="module")
async def test_name_of_another_file_adds_its_import(client, editor, tmp_path):
    (tmp_path / "swarm.toml").write_text('[project]\nname = "patrol"\n')
    (tmp_path / "flying.swarm").write_text(FUNCTIONS)
    for head in (
        "package here\n\nimport cpswarm.events.*\n\n",
        "package here\n\n",
        "// A header.\n/* Of two comments. */\n\n",
        "",
    ):
        text = head + "statemachine M {\n  initial A\n\n  state A {\n    do tid|\n  }\n}\n"
        offset = text.index("|")
        text = text.replace("|", "", 1)
        (tmp_path / "model.swarm").write_text(text)
        document = editor.open(tmp_path / "model.swarm")
        found = await client.text_document_completion_async(
            lsp.CompletionParams(text_document=document, position=position(text, offset))
        )
        [item] = [each for each in found if each.label == "tidy"]
        [edit] = item.additional_text_edits
        lines = text.replace("do tid", "do tidy").split("\n")
        line, column = edit.range.start.line, edit.range.start.character
        lines[line] = lines[line][:column] + edit.new_text + lines[line][column:]
        changed = "\n".join(lines)
        assert changed.startswith(head.rstrip())
        assert 'import "flying.swarm"' in changed
        assert format_source(Source("model.swarm", changed), Diagnostics()) == changed
        editor.type(document, changed)
        assert "SW0202" not in [each.code for each in await editor.told(document)]
        editor.close(document)
