"""Steps and claims of tests; each is tried where it holds and where it fails."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import pytest

from .conftest import Ran

# Functions end only where a test says so.
_STILL = 'scenario = { functions = { "*" = { never = 1 } } }\n'
_START = '{ send = "Start" }'
_DARK = f'{_START}, {{ end = "blink", of = "lamp[0]", result = {{ count = 3 }} }}'


def steps(*each: str) -> str:
    return f'{_STILL}[[test]]\nname = "it"\nsteps = [{", ".join(each)}]\n'


@pytest.mark.parametrize(
    ("before", "so", "not_so"),
    [
        # Whom it is about.
        ("", '{ in = "Off" }', '{ in = "Bright" }'),
        (_START, '{ all = "lamp", in = "On" }', '{ all = "lamp", in = "Off" }'),
        (_START, '{ all = "Lamp", in = "On" }', '{ no = "Lamp", in = "On" }'),
        ('{ send = "Start", to = "lamp[1]" }', '{ who = "lamp[1]", in = "On" }', '{ in = "On" }'),
        (
            '{ send = "Start", to = ["lamp[1]", "lamp[0]", "lamp[1]"] }',
            '{ count = 2, of = "lamp", in = "On" }',
            '{ count = 3, of = "lamp", in = "On" }',
        ),
        (
            '{ send = "Start", to = "lamp[1]" }',
            '{ any = "lamp", in = "On" }',
            '{ all = "lamp", in = "On" }',
        ),
        (
            '{ send = "Start", to = "lamp[1]" }',
            '{ count = 1, of = "lamp", in = "On" }',
            '{ count = 2, of = "lamp", in = "On" }',
        ),
        (
            '{ send = "Start", to = "lamp[1]" }',
            '{ count = "0..1", of = "lamp", in = "On" }',
            '{ count = "2..*", of = "lamp", in = "On" }',
        ),
        (
            '{ send = "Start", to = "lamp[1]" }',
            '{ count = "2..3", of = "lamp", in = "Off" }',
            '{ count = "0..1", of = "lamp", in = "Off" }',
        ),
        # States: paths, several at once, those around, of parts, after the end.
        (_START, '{ in = ["Bright", "Quiet"] }', '{ in = ["Bright", "Loud"] }'),
        (_START, '{ in = "Lamp.Bright" }', '{ in = "Lamp.Dark" }'),
        (_START, '{ in = "On.Bright" }', '{ in = "On.Dark" }'),
        (_START, '{ in = "On.Lamp" }', '{ in = "On.Lamp.Dark" }'),
        (f"{_START}, {_START}", '{ in = "Gone" }', '{ in = "On" }'),
        (_DARK, '{ who = "lamp[1]", in = "Awake" }', '{ who = "lamp[0]", in = "Awake" }'),
        (
            _DARK,
            '{ any = "lamp.eye", in = "Awake" }',
            '{ all = "lamp.eye", in = "Awake" }',
        ),
        (_DARK, '{ who = "lamp[1].eye", in = "Awake" }', '{ who = "lamp[1].eye", in = "Off" }'),
        # What is done: since the last step that does something, at this moment.
        (_START, '{ all = "lamp", starts = "blink" }', '{ any = "lamp", starts = "ring" }'),
        (
            f'{_START}, {{ pass = "1 s" }}',
            '{ no = "lamp", starts = "blink" }',
            '{ any = "lamp", starts = "blink" }',
        ),
        (_DARK, '{ who = "lamp[0]", sends = "Ping" }', '{ who = "lamp[1]", sends = "Ping" }'),
        # Data: of what is sent, and of variables; what is not named may be anything.
        (
            _DARK,
            '{ who = "lamp[0]", sends = "Told", data = { times = 3 } }',
            '{ who = "lamp[0]", sends = "Told", data = { times = 4 } }',
        ),
        (
            _DARK,
            '{ no = "lamp", sends = "Told", data = { times = 4 } }',
            '{ no = "lamp", sends = "Told", data = { times = 3 } }',
        ),
        (
            f'{_DARK}, {{ pass = "1 s" }}',
            '{ no = "lamp", sends = "Told", data = { times = 3 } }',
            '{ any = "lamp", sends = "Told", data = { times = 3 } }',
        ),
        (
            _DARK,
            '{ who = "lamp[0]", has = { count = 3 } }',
            '{ all = "lamp", has = { count = 3 } }',
        ),
        (_DARK, '{ count = 2, of = "lamp", has = { count = 0 } }', "{ has = { count = 0 } }"),
        # Variables of states.
        (
            _DARK,
            '{ who = "lamp[0]", has = { off = true } }',
            '{ who = "lamp[0]", has = { off = false } }',
        ),
        (
            _DARK,
            '{ who = "lamp[0]", has = { "Dark.shown" = 5, "On.Bright.shown" = 2 } }',
            '{ who = "lamp[0]", has = { "Dark.shown" = 4 } }',
        ),
        (
            f'{_DARK}, {{ lose = "lamp[0]" }}',
            '{ no = "lamp", has = { count = 3 } }',
            '{ any = "lamp", has = { count = 3 } }',
        ),
        (_DARK, '{ who = "lamp[1]", starts = "ring" }', '{ no = "lamp", starts = "ring" }'),
        (
            f"{_START}, {_START}",
            '{ all = "lamp", cancels = "blink" }',
            '{ any = "lamp", cancels = "ring" }',
        ),
        # Ends of functions, with outcomes and results.
        (_DARK, '{ count = 1, of = "lamp", in = "Dark" }', '{ who = "lamp[0]", in = "Bright" }'),
        (
            f'{_START}, {{ end = "blink", result = {{ count = 2 }} }}',
            '{ in = "Bright" }',
            '{ in = "Dark" }',
        ),
        (
            f'{_START}, {{ end = "blink", as = "aborted" }}',
            '{ in = "Broken" }',
            '{ in = "Bright" }',
        ),
        # Data of events.
        (
            (
                f'{_START}, {{ end = "blink", as = "aborted" }}, '
                '{ send = "Button", data = { times = 3 } }'
            ),
            '{ in = "Bright" }',
            '{ in = "Broken" }',
        ),
        (
            f'{_START}, {{ end = "blink", as = "aborted" }}, {{ send = "Button" }}',
            '{ in = "Broken" }',
            '{ in = "Bright" }',
        ),
        # Time.
        (
            _DARK,
            '{ who = "lamp[0]", in = "Bright", within = "5 s" }',
            '{ who = "lamp[0]", in = "Bright", within = "4999 ms" }',
        ),
        (
            _DARK,
            '{ who = "lamp[0]", in = "Dark", for = "4999 ms" }',
            '{ who = "lamp[0]", in = "Dark", for = "5 s" }',
        ),
        (
            f'{_DARK}, {{ pass = "5 s" }}',
            '{ who = "lamp[0]", in = "Bright" }',
            '{ who = "lamp[0]", in = "Dark" }',
        ),
        (
            _DARK,
            '{ no = "lamp", in = "Gone", for = "1 h" }',
            '{ no = "lamp.eye", in = "Off", for = "1 h" }',
        ),
        (
            _DARK,
            '{ who = "lamp[0]", starts = "blink", within = "5 s" }',
            '{ who = "lamp[0]", starts = "blink", within = "4 s" }',
        ),
        (
            _DARK,
            (
                '{ who = "lamp[0]", in = "Bright", within = "1 min" }, '
                '{ who = "lamp[1].eye", in = "Off", within = "55 s" }'
            ),
            (
                '{ who = "lamp[0]", in = "Bright", within = "1 min" }, '
                '{ who = "lamp[1].eye", in = "Off", within = "54 s" }'
            ),
        ),
        (
            f'{{ lose = "lamp[2]" }}, {_START}',
            '{ all = "lamp", starts = "blink" }',
            '{ who = "lamp[2]", starts = "blink" }',
        ),
        # Lost robots are nowhere, and are not counted.
        (
            f'{{ lose = "lamp[2]" }}, {_START}',
            '{ all = "lamp", in = "On" }',
            '{ all = "lamp", in = "Off" }',
        ),
        (
            f'{_START}, {{ lose = "lamp[2]" }}',
            '{ no = "lamp[2]", in = "On" }',
            '{ who = "lamp[2]", in = "On" }',
        ),
        (
            f'{_START}, {{ lose = "lamp" }}',
            '{ no = "lamp", in = "On" }',
            '{ all = "lamp", in = "On" }',
        ),
        (_START, '{ who = "lamp", in = "On" }', '{ who = "lamp", in = "Off" }'),
    ],
)
def test_claims(ran: Callable[..., Ran], before: str, so: str, not_so: str) -> None:
    before = f"{before}, " if before else ""

    passed = ran(steps(f"{before}{so}"))
    failed = ran(steps(f"{before}{not_so}"))

    assert (passed.code, "SW1" in passed.out) == (0, False), passed.out
    assert (failed.code, failed.out.count("error[SW1101]")) == (1, 1), failed.out


def test_a_function_that_a_test_ends_ends_by_itself_on_other_robots(
    ran: Callable[..., Ran],
) -> None:
    text = """[[test]]
name  = "it"
steps = [
  { send = "Start" },
  { pass = "3500 ms" },
  { end = "blink", of = "lamp[0]", as = "aborted" },
  { who = "lamp[0]", in = "Broken" },
  { no = "lamp[0]", starts = "blink" },
  { count = 2, of = "lamp", in = "Bright" },
  { count = 2, of = "lamp", starts = "blink", within = "1 s" },
]
"""
    assert ran(text).code == 0


def test_a_function_that_nobody_calls_cannot_end(ran: Callable[..., Ran]) -> None:
    found = ran(steps('{ end = "blink" }'))

    assert "expected `blink` to be running" in found.out
    assert "at the start: it is not running" in found.out


def test_what_must_always_be_so(ran: Callable[..., Ran]) -> None:
    text = f'{steps(_DARK)}always = [{{ count = "CLAIM", of = "lamp", in = "Dark" }}]\n'

    assert ran(text.replace("CLAIM", "0..1")).code == 0
    failed = ran(text.replace("CLAIM", "0"))
    assert failed.code == 1
    assert "expected always 0 of `lamp` in `Dark`" in failed.out
    assert "`lamp[0]` is in `On.Lamp.Dark` and `On.Sound.Quiet`" in failed.out


def test_a_machine_alone(ran: Callable[..., Ran]) -> None:
    text = """machine = "Blinking"
[[test]]
name  = "it"
steps = [{ send = "Start" }, { starts = "blink" }, { in = "Bright", for = "10 s" }]
"""
    assert ran(text).code == 0
    assert "is in `On.Lamp.Bright` and `On.Sound.Quiet`" in ran(text.replace("Bright", "Dark")).out


def test_the_scenario_may_be_a_file_or_a_table(ran: Callable[..., Ran], folder) -> None:
    (folder / "slow.toml").write_text('[functions]\nblink = { duration = "1 h" }\n')
    text = """SCENARIO
[[test]]
name  = "it"
steps = [{ send = "Start" }, { pass = "1 s" }, { no = "lamp", starts = "blink", for = "59 min" }]
"""
    inline = 'scenario = { functions = { blink = { duration = "1 h" } } }'

    assert ran(text.replace("SCENARIO", "")).code == 1
    assert ran(text.replace("SCENARIO", inline)).code == 0
    assert ran(text.replace("SCENARIO", 'scenario = "slow.toml"')).code == 0


def test_members_can_be_more(ran: Callable[..., Ran]) -> None:
    text = """scenario = { count = { spare = 2 } }
[[test]]
name  = "it"
steps = [{ count = 2, of = "spare", in = "Off" }, { count = 5, of = "Lamp", in = "Off" }]
"""
    assert ran(text).code == 0


def test_runs_differ_by_seed_and_enough_must_pass(ran: Callable[..., Ran]) -> None:
    text = """seeds   = 40
passing = SHARE
scenario = { functions = { blink = { aborted = 0.5 } } }
[[test]]
name  = "it"
steps = [{ send = "Start", to = "lamp[0]" }, { pass = "1 s" }, { any = "lamp", in = "Broken" }]
"""
    found = ran(text.replace("SHARE", "1"))

    assert found.code == 1
    share = int(found.out.partition(" of 40 seeds)")[0].rpartition("(")[2])
    # Half of them, within five standard deviations.
    assert 4 <= share <= 36
    assert f"{share} of 40 seeds pass; it fails with " in found.out
    assert ran(text.replace("SHARE", str(share / 40))).code == 0
    missed = ran(text.replace("SHARE", str((share + 1) / 40)))
    assert missed.code == 1
    assert f"{share} of 40 seeds pass, {share + 1} must; it fails with " in missed.out


def test_a_seed_that_fails_fails_again(ran: Callable[..., Ran]) -> None:
    text = """seeds   = 10
scenario = { functions = { blink = { aborted = 0.5 } } }
[[test]]
name  = "it"
steps = [{ send = "Start" }, { pass = "5 s" }, { no = "lamp", in = "Broken" }]
"""
    found = ran(text)
    seed = int(found.out.partition("`--seed ")[2].partition("`")[0])
    alone = ran(text, "--seed", seed)

    assert alone.code == 1
    last = "the last trace lines:"
    assert alone.out.partition(last)[2] == found.out.partition(last)[2] != ""


def test_a_machine_that_never_rests_fails_its_test(ran: Callable[..., Ran], folder) -> None:
    (folder / "loop.scxml").write_text(
        '<scxml xmlns="http://www.w3.org/2005/07/scxml" version="1.0" name="loop">'
        '<state id="rest"><transition event="go" target="a"/></state>'
        '<state id="a"><transition target="b"/></state>'
        '<state id="b"><transition target="a"/></state></scxml>'
    )
    text = """model = "loop.scxml"
[[test]]
name  = "it"
steps = [{ in = "rest" }, { send = "go" }, { in = "a" }]
"""
    found = ran(text)

    assert found.code == 1
    assert "error[SW1006]: `loop` does not reach a stable configuration at 0 ms" in found.out
    assert '{ send = "go" }' in found.out
    assert "it loops through `a` and `b`" in found.out


def test_machines_that_never_stop_answering_each_other(ran: Callable[..., Ran], folder) -> None:
    (folder / "lamps.swarm").write_text("""swarm event Ping : std_msgs/Empty
swarm event Pong : std_msgs/Empty
endless statemachine A {
  initial X
  state X { on Ping / send Pong() }
}
endless statemachine B {
  initial Y
  state Y { on Pong / send Ping() }
}
member Asks { behavior A }
member Answers { behavior B }
swarm S { a : Asks[1]; b : Answers[1] }
""")
    found = ran(steps('{ send = "Ping" }, { pass = "1 s" }'))

    assert found.code == 1
    assert "error[SW1006]: `a[0]` does not reach a stable configuration at 0 ms" in found.out
    assert '{ send = "Ping" }' in found.out
    assert "lamps.swarm:5:9" in found.out


def test_what_fails_in_the_model_is_told(ran: Callable[..., Ran], folder) -> None:
    model = (folder / "lamps.swarm").read_text().replace("count > 2", "1 / count > 2")
    (folder / "lamps.swarm").write_text(model)
    found = ran(steps(f'{_START}, {{ end = "blink" }}'))

    assert found.code == 0
    assert "warning[SW1007]: evaluation failed in `Blinking`: division by zero" in found.out


@pytest.mark.parametrize(
    ("claim", "expected", "told"),
    [
        (
            '{ who = "lamp[0]", sends = "Told", data = { times = 4 } }',
            "expected `lamp[0]` to send `Told` with `times = 4`",
            "`lamp[0]` sends `Ping` and `Told(times = 3)`",
        ),
        (
            '{ all = "lamp", has = { count = 3 } }',
            "expected all `lamp` to have `count = 3`",
            "`lamp[0]` has `count = 3`, `lamp[1]` and `lamp[2]` have `count = 0`",
        ),
    ],
)
def test_data_that_are_others_are_told(
    ran: Callable[..., Ran], claim: str, expected: str, told: str
) -> None:
    found = ran(steps(_DARK, claim))

    assert found.code == 1
    assert f"error[SW1101]: {expected}\n" in found.out
    assert told in found.out


def test_variables_are_waited_for(ran: Callable[..., Ran]) -> None:
    scenario = "scenario = { functions = { blink = { results = [{ count = 2 }] } } }\n"
    held = '{ who = "lamp[0]", has = { count = 2 }, WITHIN }'
    text = f'{scenario}[[test]]\nname = "it"\nsteps = [{_START}, {held}]\n'

    assert ran(text.replace("WITHIN", 'within = "1 s"')).code == 0
    assert ran(text.replace("WITHIN", 'within = "999 ms"')).code == 1


def test_variables_of_documents(ran: Callable[..., Ran], folder: Path) -> None:
    (folder / "d.scxml").write_text(
        """<scxml xmlns="http://www.w3.org/2005/07/scxml" version="1.0" datamodel="ecmascript">
          <datamodel><data id="o" expr="{n: 1, list: [1, true], more: 2}"/></datamodel>
          <state id="a"><transition event="go"><assign location="o.n" expr="o.n + 1"/></transition>
          </state>
        </scxml>""",
        encoding="utf-8",
    )
    text = (
        'model = "d.scxml"\n[[test]]\nname = "it"\nsteps = [{ send = "go" }, { has = { CLAIM } }]\n'
    )

    assert ran(text.replace("CLAIM", "o = { n = 2, list = [1, true] }")).code == 0
    for wrong in ("o = { n = 1 }", "o = { list = [1] }", "o = { list = [true, true] }", "p = 1"):
        found = ran(text.replace("CLAIM", wrong))
        assert (found.code, "SW1101" in found.out) == (1, True)


def test_values_of_enums_by_name(folder: Path, swarmc: Callable[..., Ran]) -> None:
    (folder / "lamps.swarm").unlink()
    (folder / "weeds.swarm").write_text(
        """
        enum Species { DOCK, THISTLE }
        message Weed { species : Species }
        swarm event Seen : Weed
        endless statemachine Weeding {
          var last : Species = Species.DOCK
          initial A
          state A {
            on Seen [last == Species.DOCK] / last = event.species, send Seen(species = last) -> A
          }
        }
        """,
        encoding="utf-8",
    )
    test = """
        [[test]]
        name = "it"
        steps = [
          { send = "Seen", data = { species = "THISTLE" } },
          { sends = "Seen", data = { species = "NAME" } },
          { has = { last = "NAME" } },
        ]
    """
    results = {}
    for name in ("THISTLE", "DOCK", "THISTEL"):
        (folder / "it.swarmtest.toml").write_text(test.replace("NAME", name), encoding="utf-8")
        results[name] = swarmc("test", "it.swarmtest.toml")

    assert results["THISTLE"].code == 0, results["THISTLE"].err
    assert results["DOCK"].code == 1
    assert "error[SW0013]: `species` takes a value of `Species`" in results["THISTEL"].out
