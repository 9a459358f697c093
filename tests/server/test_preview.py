"""Tests of the request for diagrams."""

import pytest

from .model import MODEL

pytestmark = pytest.mark.asyncio(loop_scope="module")

DIAGRAMS = """package dig
message Image {}
endless statemachine Job {
  initial Both
  parallel state Both {
    region Left { initial Work; state Work { after 1 s -> Done } final Done }
    region Right { initial Wait; state Wait { after 1 s -> Over } final Over }
    on done -> Pick
  }
  choice Pick {
    [true] -> Both
    else -> Both
  }
}
sensor Eye { out image : Image }
member Digger {
  behavior Job
  out seen : Image
  eye : Eye
  connect eye.image -> seen
}
environment Yard { world "yard.world" }
swarm Team { digger : Digger[2]; environment Yard }
"""


async def pictures(client, document, **wanted):
    params = {"textDocument": {"uri": document.uri}, **wanted}
    answer = await client.protocol.send_request_async("swarmdsl/pictures", params)
    return answer if isinstance(answer, dict | None) else answer._asdict()


async def test_pictures_follow_what_is_typed(client, editor, folder):
    document = editor.open(folder / "patrol.swarm")
    answer = await pictures(client, document, id="Patrol.statechart")
    assert answer["id"] == "Patrol.statechart"
    assert ">Round</text>" in answer["svg"]
    assert f'data-place="{folder / "patrol.swarm"}:' in answer["svg"]
    editor.type(document, MODEL.replace("Round", "Circle"))
    assert ">Circle</text>" in (await pictures(client, document, id="Patrol.statechart"))["svg"]
    editor.type(document, MODEL.replace("-> Home", "-> Hone", 1))
    assert await pictures(client, document) == {"broken": 1}


async def test_closed_file_has_no_pictures(client, editor, folder):
    document = editor.open(folder / "patrol.swarm")
    editor.close(document)
    assert await pictures(client, document) is None


async def elements(client, document, whole, text, after=""):
    """Return the elements at the first `text` after the first `after`."""
    offset = whole.index(text, whole.index(after))
    line = whole.count("\n", 0, offset)
    character = len(whole[:offset].rpartition("\n")[2].encode("utf-16-le")) // 2
    params = {
        "textDocument": {"uri": document.uri},
        "position": {"line": line, "character": character},
    }
    found = await client.protocol.send_request_async("swarmdsl/diagramElements", params)
    return [(each["diagram"], each["element"]) for each in found]


async def test_elements_of_diagrams_at_a_position(client, editor, folder):
    document = editor.open(folder / "patrol.swarm")
    patrol = "Patrol.statechart"
    assert await elements(client, document, MODEL, "ate Idle") == [(patrol, "Idle")]
    assert await elements(client, document, MODEL, " on Start") == [(patrol, "Idle->0")]
    assert await elements(client, document, MODEL, "aborted ->") == [(patrol, "Round->2")]
    assert await elements(client, document, MODEL, "var mode") == [(patrol, "")]
    assert await elements(client, document, MODEL, "nitial Idle") == [(patrol, "#initial->")]
    assert await elements(client, document, MODEL, "function go_round") == []
    # The names are those of the text, also while it has errors.
    circle = MODEL.replace("state Round", "state Circle")
    editor.type(document, circle)
    assert await elements(client, document, circle, "aborted ->") == [(patrol, "Circle->2")]


async def test_elements_of_nested_states_members_and_swarms(client, editor, folder):
    document = editor.open(folder / "diagrams.swarm", DIAGRAMS)
    job, team = "Job.statechart", "Team.composition"
    assert await elements(client, document, DIAGRAMS, "Left {") == [(job, "Both.Left")]
    assert await elements(client, document, DIAGRAMS, "final Done") == [(job, "Both.Left.Done")]
    assert await elements(client, document, DIAGRAMS, "else ->") == [(job, "Pick->1")]
    inside = ("Digger.internal", team)
    for text, part, role in (
        ("eye : Eye", "eye", "role.digger"),
        ("connect eye", "connector0", "role.digger"),
        ("out seen", ":seen", "role.digger"),
    ):
        assert await elements(client, document, DIAGRAMS, text) == [
            *zip(inside, (part, role), strict=True)
        ]
    assert await elements(client, document, DIAGRAMS, "out image") == [
        ("Digger.internal", "eye:image")
    ]
    assert await elements(client, document, DIAGRAMS, "digger : D") == [(team, "role.digger")]
    assert await elements(client, document, DIAGRAMS, "environment Y", "swarm") == [
        (team, "environment")
    ]
    assert await elements(client, document, DIAGRAMS, "world") == [(team, "environment")]
