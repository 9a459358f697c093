"""Tests of semantic tokens, folding, hints, lenses, links, selections and hover."""

from pathlib import Path

import pytest
from lsprotocol import types as lsp

from swarmdsl.codegen.exchange.content_policy import goal_policy, result_policy
from swarmdsl.codegen.shared.constants import params_by_name
from swarmdsl.driver import pipeline

from .editor import at, named, position
from .model import MODEL

pytestmark = pytest.mark.asyncio(loop_scope="module")
EXAMPLE = Path(__file__).resolve().parents[2] / "examples" / "search_and_rescue"
BEHAVIOURS, SAR = EXAMPLE / "behaviours.swarm", EXAMPLE / "sar.swarm"


def whole(text):
    return lsp.Range(start=lsp.Position(line=0, character=0), end=position(text, len(text)))


def coloured(client, data, text):
    """Decode semantic tokens to words with their types."""
    legend = client.offered.semantic_tokens_provider.legend
    lines = [line.encode("utf-16-le") for line in text.split("\n")]
    found, line, character = [], 0, 0
    for index in range(0, len(data), 5):
        down, right, length, type_, modifiers = data[index : index + 5]
        line, character = line + down, right if down else character + right
        word = lines[line][2 * character : 2 * (character + length)].decode("utf-16-le")
        names = [name for bit, name in enumerate(legend.token_modifiers) if modifiers >> bit & 1]
        found.append((word, legend.token_types[type_], *names))
    return found


async def tokens(client, document):
    return await client.text_document_semantic_tokens_full_async(
        lsp.SemanticTokensParams(text_document=document)
    )


async def test_semantic_tokens(client, editor, folder):
    text = MODEL + (
        "message a_msgs/Odd { state : int32, on : bool }\nevent Odd : a_msgs/Odd\n"
        "statemachine Uses {\n  initial A\n  state A { on Odd [event.state > abs(1)] -> B }\n"
        "  final B\n}\n"
    )
    document = editor.open(folder / "patrol.swarm", text)
    found = coloured(client, (await tokens(client, document)).data, text)
    for each in (
        ("package", "keyword"),
        ("patrol", "namespace"),
        ("Start", "event", "declaration"),
        ("std_msgs", "namespace"),
        ("SLOW", "enumMember", "declaration", "readonly"),
        ("SLOW", "enumMember", "readonly"),
        ("go_round", "function"),
        ("Patrol", "class", "declaration"),
        ("int32", "type", "defaultLibrary"),
        ("limit", "parameter"),
        ("Round", "label"),
        ("on", "keyword"),
        ("state", "keyword"),
        ("state", "property", "declaration"),
        ("state", "property"),
        ("on", "property", "declaration"),
        ("event", "keyword"),
        ("abs", "function", "defaultLibrary"),
    ):
        assert each in found
    assert all(word.replace("_", "").isalnum() for word, *_ in found)


async def test_semantic_tokens_of_a_range(client, editor):
    document = editor.open(BEHAVIOURS)
    text = BEHAVIOURS.read_text(encoding="utf-8")
    all_ = coloured(client, (await tokens(client, document)).data, text)
    machine = text.index("statemachine RoverRescue")
    part = await client.text_document_semantic_tokens_range_async(
        lsp.SemanticTokensRangeParams(
            text_document=document,
            range=lsp.Range(start=position(text, machine), end=position(text, len(text))),
        )
    )
    words = coloured(client, part.data, text)
    assert words[-40:] == all_[-40:]
    assert ("MissionStart", "event", "declaration") in all_
    assert ("MissionStart", "event", "declaration") not in words


async def test_semantic_token_edits(client, editor, folder):
    document = editor.open(folder / "patrol.swarm")
    before = await tokens(client, document)
    text = MODEL.replace("state Idle", "state /* new */ Idle").replace("Stop", "Halt")
    editor.type(document, text)

    async def delta(result):
        return await client.text_document_semantic_tokens_full_delta_async(
            lsp.SemanticTokensDeltaParams(text_document=document, previous_result_id=result)
        )

    changed = await delta(before.result_id)
    data = list(before.data)
    for edit in changed.edits:
        data[edit.start : edit.start + edit.delete_count] = edit.data
    assert data == list((await tokens(client, document)).data)
    assert ("Halt", "event") in coloured(client, data, text)
    assert sum(len(edit.data) for edit in changed.edits) < len(data)
    assert list((await delta("no such result")).data) == data


@pytest.mark.parametrize(
    "change",
    [
        ("/// Begin.", "/// Begin.\n///"),
        ("event Start", "event  Start"),
        ("/* 🤖🤖 */ state", "/* 🤖🤖🤖 */ state"),
        ("state Idle", "state /* 🤖 */ Idle"),
        ("event Stop", "event"),
    ],
)
async def test_cached_results_move_with_edits(client, editor, folder, change):
    async def told(document):
        outline = await client.text_document_document_symbol_async(
            lsp.DocumentSymbolParams(text_document=document)
        )
        assert outline
        return outline, (await tokens(client, document)).data

    document = editor.open(folder / "patrol.swarm")
    before = await told(document)
    editor.type(document, MODEL.replace(*change))
    edited = await told(document)
    assert edited != before
    editor.close(document)
    assert await told(editor.open(folder / "patrol.swarm", MODEL.replace(*change))) == edited


async def test_incomplete_file_keeps_its_semantic_tokens(client, editor, folder):
    text = MODEL.replace("on Stop -> Home", "on Stop ->")
    document = editor.open(folder / "patrol.swarm", text)
    found = coloured(client, (await tokens(client, document)).data, text)
    assert ("Round", "label", "declaration") in found
    assert ("rounds", "variable") in found


async def test_folding_range_request(client, editor, folder):
    text = (
        '// one\n// two\npackage p\nimport "a.swarm"\n\nimport "b.swarm"\n/* three\n four */\n'
        'statemachine M { // {\n  state A {\n  }\n  state B { "}"\n  do\n'
    )
    document = editor.open(folder / "folds.swarm", text)
    found = await client.text_document_folding_range_async(
        lsp.FoldingRangeParams(text_document=document)
    )
    assert [(each.start_line, each.end_line, each.kind) for each in found] == [
        (0, 1, "comment"),
        (3, 5, "imports"),
        (6, 7, "comment"),
    ]
    editor.type(document, text + "  }\n}\n")
    found = await client.text_document_folding_range_async(
        lsp.FoldingRangeParams(text_document=document)
    )
    blocks = [(each.start_line, each.end_line) for each in found if not each.kind]
    assert blocks == [(8, 13), (11, 12)]


async def test_selection_ranges(client, editor, folder):
    document = editor.open(folder / "patrol.swarm")
    [found] = await client.text_document_selection_range_async(
        lsp.SelectionRangeParams(text_document=document, positions=[at("FAST] /")])
    )
    texts = []
    lines = MODEL.split("\n")
    while found is not None:
        start, end = found.range.start, found.range.end
        first = lines[start.line][start.character :] if start.line != end.line else None
        texts.append(first or named([found.range])[0])
        found = found.parent
    assert texts[:4] == ["FAST", "Mode.FAST", "mode == Mode.FAST", texts[3]]
    assert texts[3].startswith("on Start [mode")
    assert texts[4] == "state Idle {"
    assert texts[-1] == "/// Robots that go round. 🤖"


async def test_policy_hints_match_the_output(client, editor):
    """The hint of each activity shows its policies as compiled."""
    text = BEHAVIOURS.read_text(encoding="utf-8")
    document = editor.open(BEHAVIOURS)
    found = await client.text_document_inlay_hint_async(
        lsp.InlayHintParams(text_document=document, range=whole(text))
    )
    wanted = [
        f" {goal_policy(state.activity, params).value} → {result_policy(state.activity).value}"
        for machine in pipeline.check([BEHAVIOURS]).system.machines
        for params in [params_by_name(machine.params)]
        for state in machine.walk()
        if state.activity is not None
    ]
    wanted = [each for each in wanted if each != " empty → empty"]  # nothing is implicit
    assert sorted(each.label for each in found) == sorted(wanted)
    assert len(set(wanted)) > 2


async def test_hints_of_ports_and_enum_values(client, editor):
    text = SAR.read_text(encoding="utf-8") + (
        "\nenum Mode { A, B = 4, C }\nswarm One { uav : Uav }\n"
    )
    document = editor.open(SAR, text)
    found = await client.text_document_inlay_hint_async(
        lsp.InlayHintParams(text_document=document, range=whole(text))
    )
    shown = [each.label for each in found]
    assert " : cpswarm_msgs/TargetPositionEvent" in shown
    assert [each for each in shown if "=" in each] == [" = 0", " = 5"]
    assert shown.count("[1]") == 1
    few = await client.text_document_inlay_hint_async(
        lsp.InlayHintParams(
            text_document=document,
            range=lsp.Range(start=at("enum Mode", text), end=at("swarm One", text)),
        )
    )
    assert [each.label for each in few] == [" = 0", " = 5"]


async def test_document_links(client, editor, folder):
    text = 'import "patrol.swarm"\nimport cpswarm.functions.*\nimport "missing.swarm"\n'
    document = editor.open(folder / "links.swarm", text)
    found = await client.text_document_document_link_async(
        lsp.DocumentLinkParams(text_document=document)
    )
    places = named([each.range for each in found], text)
    assert places == ["patrol.swarm", "cpswarm.functions.*"]
    assert found[0].target == (folder / "patrol.swarm").as_uri()
    assert "/library/cpswarm/functions" in found[1].target


async def test_code_lenses(client, editor):
    document = editor.open(SAR)
    text = SAR.read_text(encoding="utf-8")
    found = await client.text_document_code_lens_async(lsp.CodeLensParams(text_document=document))
    # Without these commands in the client, there are no preview lenses.
    assert {each.command for each in found} == {None}
    counted = {}
    for each in found:
        resolved = await client.code_lens_resolve_async(each)
        counted[named([each.range], text)[0]] = resolved.command.title
    assert counted["Gps"] == "2 references"
    assert counted["SearchAndRescue"] == "17 references"
    assert counted["Field"] == "1 reference"


async def hovered(client, editor, path, word, text=None):
    text = text or path.read_text(encoding="utf-8")
    found = await client.text_document_hover_async(
        lsp.HoverParams(text_document=editor.open(path, text), position=at(word, text))
    )
    return found.contents.value


async def test_hover_shows_multiplicity_and_support_in_targets(client, editor):
    assert "role, 3 members" in await hovered(client, editor, SAR, "uav   :")
    assert "role, 1 to 5 members" in await hovered(client, editor, SAR, "rover :")
    found = await hovered(client, editor, BEHAVIOURS, "Mission {\n    region")
    assert "`smach`: exact, container `Concurrence`" in found
    text = "type Distance = float64\nevent Far : Distance\n"
    found = await hovered(client, editor, EXAMPLE / "new.swarm", "Far", text)
    assert "event, of type `float64`" in found


async def test_hover_shows_a_built_in_function(client, editor):
    text = "const HALF : int32 = div(7, clamp(2, 0, 3))\n"
    found = await hovered(client, editor, EXAMPLE / "new.swarm", "div", text)
    assert "div(a, b) : int64" in found
    assert "rounded down" in found
    found = await hovered(client, editor, EXAMPLE / "new.swarm", "clamp", text)
    assert "clamp(x, low, high)\n" in found


async def test_hover_shows_a_property_in_words(client, editor):
    found = await hovered(client, editor, SAR, "Lands of")
    assert "property Lands of SearchAndRescue : each uav : " in found
    assert (
        "\n\nproperty\n\nIn each run of swarm `SearchAndRescue`, for each `uav` by itself: "
        "whenever it hears `MissionAbort`, then or within `5 min` it is in `Mission.Idle`.\n\n"
    ) in found


async def test_hover_shows_what_a_robot_knows_of_itself(client, editor):
    text = """
      statemachine M {
        initial A
        state A { after 1 s [self.index > 0] -> B }
        final B
      }
    """
    found = await hovered(client, editor, EXAMPLE / "new.swarm", "index", text)
    assert "self.index : uint32" in found
    assert "number of the robot in its role" in found
    assert "The robot that runs" in await hovered(
        client, editor, EXAMPLE / "new.swarm", "self", text
    )


async def test_hover_shows_who_sent_an_event(client, editor):
    text = """
      swarm event Go : std_msgs/Empty
      statemachine M {
        initial A
        state A {
          on Go [event.sent > 2 s and event.sender != ""] / send Go to base[0] -> B
        }
        final B
      }
      member Rover { behavior M }
      swarm S { base : Rover }
    """
    found = await hovered(client, editor, EXAMPLE / "new.swarm", "sender", text)
    assert "event.sender : string" in found
    assert "event.sent : duration" in await hovered(
        client, editor, EXAMPLE / "new.swarm", "sent", text
    )
    found = await hovered(client, editor, EXAMPLE / "new.swarm", "base[", text)
    assert "base : Rover" in found
    assert "one member" in found


async def test_hover_shows_who_sent_what_a_property_is_about(client, editor):
    text = """
      message Spot { x : float64 }
      swarm event Go : Spot
      statemachine M {
        var far : float64 = 3.0
        initial A
        state A { on Go / send Go(x = far) -> B }
        final B
      }
      member Rover { behavior M }
      swarm S { base : Rover[2] }
      property P of S : each base : never hears Go [event.sender == "base[1]" and event.x > far]
    """
    place = EXAMPLE / "new.swarm"
    assert "event.sender : string" in await hovered(client, editor, place, "sender", text)
    assert "base : Rover" in await hovered(client, editor, place, "base[1]", text)
    assert "var far : float64" in await hovered(client, editor, place, "far]", text)
    found = await hovered(client, editor, place, "P of", text)
    assert 'it hears `Go` with `event.sender == "base[1]" and event.x > far`' in found


async def test_hover_shows_which_robot_was_lost(client, editor):
    text = """
      statemachine M {
        initial A
        state A { on member_lost [event.role == "base" and event.id != self.id] -> B }
        final B
      }
      member Rover { behavior M }
      swarm S { heartbeat 1 s lost after 5 s; base : Rover }
    """
    for place, declared in (("role ==", "event.role : string"), ("id !=", "event.id : string")):
        found = await hovered(client, editor, EXAMPLE / "new.swarm", place, text)
        assert declared in found
        assert "joined or was lost" in found


async def test_hover_shows_support_in_targets_of_the_project(client, editor, folder):
    (folder / "swarm.toml").write_text("[targets.smach]\nros = 2\n[targets.yasmin]\n")
    model = folder / "lab.swarm"
    model.write_text("statemachine M { initial A; state A { initial B; final B }  final C }\n")
    found = await hovered(client, editor, model, "A {")
    assert found.partition("In targets:\n")[2].splitlines() == [
        "- `smach` with `ros=2`: exact, a `StateMachine`",
        "- `yasmin`: exact, a `StateMachine`",
    ]


async def called(client, editor, path, word):
    text = path.read_text(encoding="utf-8")
    [item] = await client.text_document_prepare_call_hierarchy_async(
        lsp.CallHierarchyPrepareParams(text_document=editor.open(path), position=at(word, text))
    )
    incoming = await client.call_hierarchy_incoming_calls_async(
        lsp.CallHierarchyIncomingCallsParams(item=item)
    )
    outgoing = await client.call_hierarchy_outgoing_calls_async(
        lsp.CallHierarchyOutgoingCallsParams(item=item)
    )
    return [each.from_.name for each in incoming], [each.to.name for each in outgoing]


async def test_call_hierarchy(client, editor):
    assert await called(client, editor, BEHAVIOURS, "Coverage {") == (
        ["TakeOff", "Tracking", "LocalCoverage"],
        ["SelectRover", "Abort", "uav_coverage"],
    )
    incoming, outgoing = await called(client, editor, BEHAVIOURS, "Ready\n      state")
    assert incoming == ["Rescue", "Bid", "Drive"]
    assert outgoing == ["Bid"]
    # A function is called by the states that perform it, in any file.
    functions = EXAMPLE / "functions.swarm"
    assert await called(client, editor, functions, "bid_action") == (["Bid"], [])
    # A machine is called by the members that run it.
    editor.open(SAR)
    assert (await called(client, editor, BEHAVIOURS, "RoverRescue {"))[0] == ["Rover"]
