"""Tests of mistakes in open TOML files: tests, scenarios and the project file."""

import pytest

from .editor import named
from .model import MODEL

pytestmark = pytest.mark.asyncio(loop_scope="module")

TEST = """[[test]]
name = "🤖 goes"
machine = "Patrol"
steps = [
  { send = "Start" },
  { in = "Round" },
]
"""
SCENARIO = '# 🤖\nuntil = "90s"\nfunctions.go_round.aborted = 0.5\n'


async def test_mistakes_in_tests_as_typed(client, editor, folder):
    path = folder / "patrol.swarmtest.toml"
    document = editor.open(path, TEST)
    assert await editor.told(document) == []
    wrong = TEST.replace('"Round"', '"Ruond"').replace("machine", "amchine = 1\nmachine")
    editor.type(document, wrong)
    unknown, state = sorted(await editor.told(document), key=lambda each: each.range.start.line)
    assert (unknown.code, named([unknown.range], wrong)) == ("SW0012", ["amchine"])
    assert state.message.startswith("no state called `Ruond`")
    assert "did you mean `Round`" in state.message
    assert named([state.range], wrong) == ['"Ruond"']

    # Names are those of the text that is not saved yet.
    editor.type(document, TEST.replace('"Start"', '"Begin"'))
    [found] = await editor.told(document)
    assert found.message.startswith("no event called `Begin`")
    model = editor.open(folder / "patrol.swarm", MODEL.replace("Start", "Begin"))
    assert await editor.told(document) == []
    # A model with mistakes has its own; the names are not looked at.
    editor.type(document, TEST)
    editor.type(model, MODEL.replace("Round", "Raund", 1).replace("-> Home", "-> Hmoe", 1))
    assert await editor.told(document) == []
    assert await editor.told(model) != []
    editor.type(document, "[[test]\n")
    assert [each.code for each in await editor.told(document)] == ["SW0011"]
    editor.close(document)
    assert await editor.told(document) == []


async def test_mistakes_in_scenarios(client, editor, folder):
    path = folder / "windy.toml"
    document = editor.open(path, SCENARIO)
    assert await editor.told(document) == []
    wrong = SCENARIO.replace("go_round", "go_ruond") + "seeds = 3\n"
    editor.type(document, wrong)
    unknown, key = sorted(await editor.told(document), key=lambda each: each.range.start.line)
    assert named([unknown.range, key.range], wrong) == ["go_ruond", "seeds"]
    assert unknown.message.startswith("no function called `go_ruond`")
    # What is no TOML for a moment is still a scenario; what has none of its keys is not.
    editor.type(document, 'until = "90s')
    assert [each.code for each in await editor.told(document)] == ["SW0011"]
    editor.type(document, "[tool]\nname = 3\n")
    assert await editor.told(document) == []
    editor.type(document, "[tool\n")
    assert await editor.told(document) == []

    # A test that names it shows its mistakes, unless it is open.
    path.write_text(wrong, encoding="utf-8")
    editor.close(document)
    text = 'scenario = "windy.toml"\n' + TEST + TEST.replace("goes", "runs")
    tests = editor.open(folder / "patrol.swarmtest.toml", text)
    assert await editor.told(tests) == []
    assert len(await editor.told_of(path)) == 2
    path.write_text(SCENARIO, encoding="utf-8")
    editor.changed_on_disk(path)
    assert await editor.told_of(path) == []


async def test_models_that_a_test_names(client, editor, folder):
    (folder / "apart").mkdir()
    other = folder / "apart" / "other.swarm"
    other.write_text("statemachine Other { initial A; final A }\n", encoding="utf-8")
    path = folder / "apart" / "other.swarmtest.toml"
    text = 'model = "other.swarm"\n[[test]]\nname = "a"\nsteps = [{ in = "B" }]\n'
    document = editor.open(path, text)
    [found] = await editor.told(document)
    assert found.message.startswith("no state called `B`")
    model = editor.open(other, "statemachine Other { initial B; final B }\n")
    assert await editor.told(document) == []
    assert await editor.told(model) == []
    editor.type(document, text.replace("other.swarm", "others.swarm"))
    [found] = await editor.told(document)
    assert named([found.range], text.replace("other.swarm", "others.swarm")) == ['"others.swarm"']


async def test_project_file_alone(client, editor, folder):
    document = editor.open(folder / "swarm.toml", '[project]\nsauces = ["."]\n')
    assert [each.code for each in await editor.told(document)] == ["SW0012"]
    editor.type(document, "[project]\n")
    assert await editor.told(document) == []
    editor.type(document, "[project\n")
    assert [each.code for each in await editor.told(document)] == ["SW0011"]
    editor.close(document)
    assert await editor.told(document) == []
