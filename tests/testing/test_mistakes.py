"""Mistakes in test files are reported at their places, each once; what has none runs."""

from __future__ import annotations

import json
from collections.abc import Callable

import pytest

from .conftest import Ran

ONE = '[[test]]\nname = "it"\nsteps = [STEP]\n'
FINE = '{ pass = "1 s" }'


def findings(found: Ran) -> list[tuple[str, str, str | None]]:
    """Return the code, message and help of each diagnostic."""
    assert "Traceback" not in found.err
    assert "internal error" not in found.err
    each = [json.loads(line) for line in found.out.splitlines()]
    return [(one["code"], one["message"], one.get("help")) for one in each]


def reported(ran: Callable[..., Ran], text: str) -> tuple[str, str, str]:
    """The code, the marked text and the help of the one thing that is wrong."""
    found = ran(text, "--format", "json")
    assert found.code == 1
    (line,) = found.out.splitlines()
    one = json.loads(line)
    row = text.splitlines()[one["line"] - 1]
    marked = row[one["column"] - 1 : one["end_column"] - 1]
    return one["code"], marked, one.get("help") or ""


@pytest.mark.parametrize(
    ("step", "code", "marked", "help_"),
    [
        ('{ send = "Sart" }', "SW0202", '"Sart"', "did you mean `Start`?"),
        ("{ send = 3 }", "SW0013", "3", ""),
        ('{ send = "Start", to = "lam" }', "SW0202", '"lam"', "did you mean `lamp`?"),
        ('{ send = "Start", to = ["lam"] }', "SW0202", '"lam"', "did you mean `lamp`?"),
        ('{ send = "Start", to = [] }', "SW0013", "[]", ""),
        ('{ send = "Start", to = [1] }', "SW0013", "[1]", ""),
        ('{ send = "Start", too = "lamp" }', "SW0012", "too", "did you mean `to`?"),
        ('{ send = "Button", data = { time = 3 } }', "SW0601", "time", "did you mean `times`?"),
        ('{ send = "Button", data = { times = "a" } }', "SW0013", '"a"', ""),
        ('{ send = "Button", data = 3 }', "SW0013", "3", ""),
        ('{ end = "blnk" }', "SW0202", '"blnk"', "did you mean `blink`?"),
        ('{ end = "blink", as = "abort" }', "SW0202", '"abort"', "did you mean `aborted`?"),
        ('{ end = "blink", of = "lamp[7]" }', "SW0202", '"lamp[7]"', "did you mean `lamp["),
        ('{ end = "blink", result = { cont = 3 } }', "SW0601", "cont", "did you mean `count`?"),
        ('{ end = "blink", as = "aborted", result = { } }', "SW0013", "{ }", ""),
        ('{ end = "blink", result = 3 }', "SW0013", "3", ""),
        ('{ pass = "soon" }', "SW0013", '"soon"', ""),
        ("{ pass = 3 }", "SW0013", "3", ""),
        ('{ pass = "\u0665 s" }', "SW0013", '"\u0665 s"', ""),
        ('{ count = "\u0661", of = "lamp", in = "Off" }', "SW0013", '"\u0661"', ""),
        ('{ lose = "spare[0]", at = 3 }', "SW0012", "at", "the keys are `lose`"),
        (
            "{ has = { shown = 1 } }",
            "SW0203",
            "shown",
            "write `On.Lamp.Bright.shown` or `On.Lamp.Dark.shown`",
        ),
        ("{ has = { of = true } }", "SW0202", "of", "did you mean `off`?"),
        ('{ in = "Brigth" }', "SW0202", '"Brigth"', "did you mean `Bright`?"),
        ('{ in = ["Bright", "Loudd"] }', "SW0202", '"Loudd"', "did you mean `Loud`?"),
        ("{ in = 3 }", "SW0013", "3", ""),
        ("{ in = [] }", "SW0013", "[]", ""),
        ('{ all = "lamp.eye", in = "Bright" }', "SW0202", '"Bright"', "the states are `Off`"),
        ('{ al = "lamp", in = "Off" }', "SW0012", "al", "did you mean `all`?"),
        ('{ all = ["lamp"], in = "Off" }', "SW0013", '["lamp"]', ""),
        ('{ all = "lamp", no = "lamp", in = "Off" }', "SW1103", "no", ""),
        ('{ of = "lamp", in = "Off" }', "SW1103", "of", "write `all`"),
        ('{ count = 4, of = "lamp", in = "Off" }', "SW1103", "4", ""),
        ('{ count = "3..1", of = "lamp", in = "Off" }', "SW0013", '"3..1"', ""),
        ('{ count = true, of = "lamp", in = "Off" }', "SW0013", "true", ""),
        ('{ in = "Off", sends = "Ping" }', "SW1103", "sends", ""),
        ('{ sends = "Pin" }', "SW0202", '"Pin"', "did you mean `Ping`?"),
        ('{ sends = "Ping", to = "lam" }', "SW0202", '"lam"', "did you mean `lamp`?"),
        ('{ all = "lamp", sends = "Start" }', "SW1103", '"Start"', ""),
        ('{ all = "lamp.eye", starts = "blink" }', "SW1103", '"blink"', ""),
        ('{ no = "lamp", sends = "Ping", within = "1 s" }', "SW1103", "within", "use `for`"),
        (
            '{ count = 0, of = "lamp", starts = "ring", within = "1 s" }',
            "SW1103",
            "within",
            "use `for`",
        ),
        ("{ has = { cuont = 3 } }", "SW0202", "cuont", "did you mean `count`?"),
        ('{ has = { count = "a" } }', "SW0013", '"a"', ""),
        ("{ has = { count = 2147483648 } }", "SW0013", "2147483648", ""),
        ("{ has = { } }", "SW0013", "{ }", ""),
        ("{ has = 3 }", "SW0013", "3", ""),
        ('{ all = "lamp.eye", has = { count = 3 } }', "SW0202", "count", "there are no variables"),
        ('{ has = { count = 3 }, in = "Off" }', "SW1103", "has", ""),
        ("{ vars = { count = 3 } }", "SW0012", "vars", ""),
        ("{ values = { count = 3 } }", "SW0012", "values", "write `has`"),
        ('{ sends = "Told", data = { tims = 3 } }', "SW0601", "tims", "did you mean `times`?"),
        ('{ sends = "Told", data = { times = "a" } }', "SW0013", '"a"', ""),
        ('{ sends = "Told", data = 3 }', "SW0013", "3", ""),
        ('{ sends = "Told", data = { } }', "SW0013", "{ }", ""),
        ('{ in = "Off", data = { times = 3 } }', "SW1103", "data", "use `has`"),
        ('{ wait = "1 s" }', "SW0012", "wait", "write `pass`"),
        ('{ expect = "Off", all = "lamp" }', "SW0012", "expect", "write `in`"),
        ('{ in = "Off", within = "1" }', "SW0013", '"1"', ""),
        ('{ in = "Off", within = "1 s", for = "1 s" }', "SW1103", "for", ""),
        ('{ all = "lamp" }', "SW1008", '{ all = "lamp" }', "say what is expected with `in`"),
        ("{ }", "SW1008", "{ }", "say what is expected with `in`"),
        ("3", "SW0013", "3", ""),
    ],
)
def test_steps(ran: Callable[..., Ran], step: str, code: str, marked: str, help_: str) -> None:
    found = reported(ran, ONE.replace("STEP", step))

    assert found[:2] == (code, marked)
    assert found[2].startswith(help_)


@pytest.mark.parametrize(
    ("text", "code", "marked", "help_"),
    [
        (f"sead = 3\n{ONE}", "SW0012", "sead", "did you mean `seeds`?"),
        (f'swarm = "Lamp"\n{ONE}', "SW0202", '"Lamp"', "did you mean `Lamps`?"),
        (f'machine = "Blinkin"\n{ONE}', "SW0202", '"Blinkin"', "did you mean `Blinking`?"),
        (f'machine = "Blinking"\nswarm = "Lamps"\n{ONE}', "SW1103", "machine", ""),
        (f'model = "lamp.swarm"\n{ONE}', "SW0001", '"lamp.swarm"', ""),
        (f"model = 3\n{ONE}", "SW0013", "3", ""),
        (f"model = []\n{ONE}", "SW0013", "[]", ""),
        (f'scenario = "no.toml"\n{ONE}', "SW0001", '"no.toml"', ""),
        (f"scenario = 3\n{ONE}", "SW0013", "3", ""),
        (
            f"scenario = {{ functions = {{ blik = {{ }} }} }}\n{ONE}",
            "SW0202",
            "blik",
            "did you mean `blink`?",
        ),
        (f"seeds = 0\n{ONE}", "SW0013", "0", ""),
        (f'seeds = "many"\n{ONE}', "SW0013", '"many"', ""),
        (f"passing = 1.5\n{ONE}", "SW0013", "1.5", ""),
        (ONE.replace('name = "it"', 'nam = "it"\nname = "it"'), "SW0012", "nam", "did you mean"),
        (ONE.replace('"it"', '""'), "SW0013", '""', ""),
        (ONE.replace('name = "it"', ""), "SW1008", "test", ""),
        (ONE.replace("steps = [STEP]", ""), "SW1008", "test", ""),
        (ONE.replace("[STEP]", "[]"), "SW1008", "[]", ""),
        (f'{ONE}always = [{{ in = "Of" }}]\n', "SW0202", '"Of"', "did you mean `Off`?"),
        (f'{ONE}always = [{{ in = "Off", within = "1 s" }}]\n', "SW0012", "within", ""),
        (f"{ONE}{ONE}", "SW0201", '"it"', ""),
        (ONE.replace('"it"', '"it'), "SW0011", "", ""),
    ],
)
def test_files(ran: Callable[..., Ran], text: str, code: str, marked: str, help_: str) -> None:
    found = reported(ran, text.replace("STEP", FINE))

    assert found[:2] == (code, marked)
    assert found[2].startswith(help_)


def test_a_file_without_tests(ran: Callable[..., Ran]) -> None:
    for text in ("", 'swarm = "Lamps"\n', "test = []\n"):
        found = ran(text, "--format", "json")
        assert found.code == 1
        assert [code for code, _, _ in findings(found)] == ["SW1102"]


def test_names_that_mean_several_states(ran: Callable[..., Ran], folder) -> None:
    model = (folder / "lamps.swarm").read_text()
    twice = model.replace("state Loud {", "state Dark {").replace("-> Loud", "-> Dark")
    (folder / "lamps.swarm").write_text(twice)

    code, marked, help_ = reported(ran, ONE.replace("STEP", '{ in = "Dark" }'))

    assert (code, marked) == ("SW0203", '"Dark"')
    assert help_ == "write `On.Lamp.Dark` or `On.Sound.Dark`"


def test_events_that_nobody_waits_for_are_told(ran: Callable[..., Ran]) -> None:
    step = '{ send = "Button", to = "lamp.eye" }'
    found = ran(ONE.replace("STEP", step), "--format", "json")

    assert [code for code, _, _ in findings(found)] == ["SW1004"]
    assert found.code == 0


def test_several_mistakes_are_told_together(ran: Callable[..., Ran]) -> None:
    text = ONE.replace("STEP", '{ send = "Sart" }, { in = "Of" }, { pass = 1 }')

    assert [code for code, _, _ in findings(ran(text, "--format", "json"))] == [
        *("SW0202", "SW0202", "SW0013")
    ]


def test_tests_beside_one_with_a_mistake_are_run(
    ran: Callable[..., Ran], swarmc: Callable[..., Ran], folder
) -> None:
    wrong = ONE.replace('"it"', '"wrong"').replace("STEP", '{ send = "Sart" }')
    after = ONE.replace('"it"', '"after"').replace("STEP", '{ in = "On" }')
    found = ran(ONE.replace("STEP", FINE) + wrong + after, "--junit", "out.xml")

    assert found.code == 1
    lines = found.out.splitlines()
    assert lines[0] == "it.swarmtest.toml"
    assert lines[1] == "error[SW0202]: no event called `Sart`"
    at = lines.index("  ok      it")
    assert lines[at + 1 : at + 3] == ["  unread  wrong", "  FAILED  after"]
    assert found.err.startswith("1 passed, 1 failed, 1 test not read in ")
    junit = (folder / "out.xml").read_text()
    assert 'tests="3" failures="1" errors="1"' in junit
    assert '<error message="no event called `Sart`"' in junit
    # Those that are left out do not matter.
    chosen = swarmc("test", "it.swarmtest.toml", "-k", "::it")
    assert (chosen.code, "Sart" in chosen.out) == (0, False)
    # What is wrong with the file is wrong with all of them.
    assert ran('swarm = "Lmps"\n' + ONE.replace("STEP", FINE) + wrong).err.startswith(
        "0 passed, 1 file not read in "
    )


def test_mistakes_in_the_model_are_told_once(swarmc: Callable[..., Ran], folder) -> None:
    (folder / "lamps.swarm").write_text("statemachine A {\n  initial B\n}\n")
    for name in ("one", "two"):
        (folder / f"{name}.swarmtest.toml").write_text(ONE.replace("STEP", FINE))
    found = swarmc("test")

    assert found.code == 1
    assert found.out.count("error[SW0202]") == 1
    assert "two.swarmtest.toml\n  not run: the model has errors" in found.out
    assert found.err.startswith("0 passed, 2 files not read in ")


def test_a_model_with_nothing_or_too_much_to_test(ran: Callable[..., Ran], folder) -> None:
    text = ONE.replace("STEP", FINE)
    (folder / "lamps.swarm").write_text("message A { b : int32 }\n")
    assert reported(ran, text)[0] == "SW1001"

    machine = "statemachine NAME {\n  initial B\n  final B\n}\n"
    two = machine.replace("NAME", "One") + machine.replace("NAME", "Two")
    (folder / "lamps.swarm").write_text(two)
    code, marked, help_ = reported(ran, text)
    assert (code, marked) == ("SW1002", "name")
    assert help_ == 'write `machine = "One"` or `machine = "Two"`'
