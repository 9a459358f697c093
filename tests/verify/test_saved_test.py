"""Runs as behaviour tests: they fail, until the model is mended."""

from __future__ import annotations

import json
import re
from collections.abc import Callable
from pathlib import Path

import pytest

from swarmdsl.cli import run

from .conftest import MODELS, ROOT

PAGE = (ROOT / "docs" / "verify.md").read_text(encoding="utf-8")
EXAMPLES = dict(re.findall(r"```swarm file=(\w+)\.swarm[^\n]*\n(.*?)```", PAGE, re.DOTALL))
# What mends each example: drones land in turn, and ask again.
IN_TURN = (
    ("  initial Circle\n", "  var turn : uint32 = 0\n  initial Circle\n"),
    (
        "    on succeeded / send Taken -> Land\n",
        "    on succeeded [self.index == turn] / send Taken -> Land\n    on succeeded -> Circle\n",
    ),
    ("    on Taken -> Wait\n", "    on Free [turn < 3] / turn = turn + 1 -> Circle\n"),
    ("  state Wait { on Free -> Circle }\n", ""),
)
AGAIN = (("on Yes -> Land }", "on Yes -> Land\n    after 5 s / send Ask -> Wait }"),)
ADDRESSED = (("send Grant -> Busy", "send Grant to event.sender -> Busy"),)
SHORTER = (("after 3 s -> Wait", "after 1 s -> Wait"),)

# Runs that go on for ever: a function is aborted, an event comes, or a message is lost each time;
# claims of all forms.
EXAMPLES["trying"] = """package trying
event Go : std_msgs/Empty
event Stop : std_msgs/Empty
function land : abstraction { service "land" : std_srvs/Empty }
statemachine Fly {
  var tries : uint8 = 0
  initial Up
  state Up {
    on Go -> Land
    on Stop -> Rest
  }
  state Land {
    do land
    on succeeded -> Down
    on aborted -> Land
  }
  state Rest {
    after 3 s -> Up
    on Stop -> Rest
  }
  final Down
  final Lost
}
member Drone { behavior Fly }
swarm Field { drone : Drone[1..2] }
property Or of Field : each drone : in Land leads to in Down or in Lost
property And of Field : some drone in Land leads to not some drone in Land and no drone in Rest
property Fewer of Field : some drone in Rest leads to count(drone in Rest) < 1
property Has of Field : each drone : in Land leads to has [tries > 2] or in Down
property Starts of Field : after Go, some drone in Rest leads to some drone in Up
property Ends of Field : each drone : starts land leads to ends land as succeeded or in Lost
property Again of Field : again and again drone[0] in Up or not drone[0] in Rest
"""
GIVES_UP = (
    (
        "on aborted -> Land",
        "on aborted [tries < 3] / tries = tries + 1 -> Land\n    on aborted -> Lost",
    ),
    ("    on Stop -> Rest\n  }\n  final", "  }\n  final"),
)
EXAMPLES["losing"] = """package losing
event Seen : std_msgs/Empty
swarm event Ask : std_msgs/Empty
swarm event Yes : std_msgs/Empty
endless statemachine Fly {
  initial Circle
  state Circle { on Seen / send Ask -> Wait }
  state Wait {
    on Yes -> Circle
    after 5 s / send Ask -> Wait
  }
}
endless statemachine Watch {
  initial Ready
  state Ready { on Ask / send Yes -> Ready }
}
member Drone { behavior Fly }
member Tower { behavior Watch }
swarm Field {
  drone : Drone
  tower : Tower
}
property Answer of Field : drone in Wait leads to drone in Circle
"""
# Events that come just when a delay ends, in one lap, and after no time, in the other.
EXAMPLES["restarting"] = """package restarting
event Go : std_msgs/Empty
swarm event Tell : std_msgs/Empty
endless statemachine Fly {
  initial Up
  state Up {
    after 2 s -> Down
    on Tell -> Up
  }
  state Down { on Go -> Down }
}
member Drone { behavior Fly }
swarm Field { drone : Drone[2] }
property Some of Field : each drone : in Up leads to some drone in Down
property Mine of Field : each drone : after Go, eventually in Down
"""
EXAMPLES["answering"] = """package answering
event Go : std_msgs/Empty
swarm event Ping : std_msgs/Empty
swarm event Pong : std_msgs/Empty
endless statemachine Fly {
  initial Calm
  state Calm {
    on Go / send Ping -> Busy
    on Ping / send Pong -> Calm
  }
  state Busy {
    on Go -> Calm
    on Pong / send Ping -> Busy
  }
}
member Drone { behavior Fly }
swarm Field { drone : Drone[2] }
"""

Saved = Callable[..., str]


@pytest.fixture
def saved(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Saved:
    """Write a model, verify it, and return the written test file."""
    monkeypatch.chdir(tmp_path)

    def saved(text: str, *options: str) -> str:
        Path("model.swarm").write_text(text, encoding="utf-8")
        run(["verify", "model.swarm", "--save-test", "it.swarmtest.toml", *options])
        return Path("it.swarmtest.toml").read_text(encoding="utf-8")

    return saved


@pytest.mark.parametrize(
    ("name", "options", "names", "mended"),
    [
        (
            "landing",
            (),
            ["drone[1] goes on from Wait", "OneLands", "AllDown for drone[1]"],
            IN_TURN,
        ),
        ("asking", ("--lossy",), ["drone[0] goes on from Wait", "CanLand for drone[0]"], AGAIN),
        ("courier", (), ["Waits for courier[0]"], SHORTER),
        ("charging", ("--size", "drone=any", "--property", "Alone"), ["Alone"], ADDRESSED),
        (
            "trying",
            (),
            [
                "Or for drone[0]",
                "And",
                "Fewer",
                "Has for drone[0]",
                "Starts",
                "Ends for drone[0]",
                "Again",
            ],
            GIVES_UP,
        ),
        (
            "losing",
            ("--lossy",),
            ["Answer"],
            (("after 5 s / send Ask -> Wait", "after 5 s -> Circle"),),
        ),
        (
            "restarting",
            ("--property", "Some", "--property", "Mine"),
            ["Some for drone[1]", "Mine for drone[1]"],
            (("    on Tell -> Up\n", ""),),
        ),
        ("answering", (), ["answers to Ping come to rest"], (("Pong / send Ping", "Pong"),)),
    ],
)
def test_each_run_of_the_page_fails_until_the_model_is_mended(
    saved: Saved,
    capsys: pytest.CaptureFixture[str],
    name: str,
    options: tuple[str, ...],
    names: list[str],
    mended: tuple[tuple[str, str], ...],
) -> None:
    text = saved(EXAMPLES[name], *options)
    assert re.findall(r'^name = "(.*)"$', text, re.MULTILINE) == names
    capsys.readouterr()

    assert run(["test", "it.swarmtest.toml"]) == 1
    assert re.findall("  FAILED  (.*)", capsys.readouterr().out) == names

    model = Path("model.swarm")
    for old, new in mended:
        assert old in model.read_text(encoding="utf-8")
        model.write_text(model.read_text(encoding="utf-8").replace(old, new), encoding="utf-8")
    # Those about a state that is gone name what is missing.
    gone = [each for each in names if "Wait" in each] if name == "landing" else []
    code = run(["test", "it.swarmtest.toml"])
    out = capsys.readouterr().out
    passed = [each.partition(" (")[0] for each in re.findall("  ok      (.*)", out)]
    assert passed == [each for each in names if each not in gone], out
    assert bool(code) == bool(gone)
    assert ("no state called `Wait`" in out) == bool(gone)
    assert run(["verify", "model.swarm", *options]) == 0, capsys.readouterr().out


def test_data_results_and_delays_are_replayed(
    saved: Saved, capsys: pytest.CaptureFixture[str]
) -> None:
    text = saved(
        """package model
message Where { x : int32, wait : duration }
action Look { result { found : bool, took : duration } }
event Order : Where on "order"
swarm event Seen : Where
function look : abstraction { action "look" : Look }
endless statemachine Search {
  var found : bool
  initial Idle
  state Idle { on Order [event.x > 3] -> Rest }
  state Rest { after 1.5 s -> Looking }
  state Looking {
    do look gives (found => found)
    on succeeded [found] / send Seen(x = 2) -> Found
    on succeeded, aborted -> Idle
  }
  state Found { on Seen -> Both }
  state Both {}
}
member Scout { behavior Search }
swarm Scouts { scout : Scout[2] }
property NotBoth of Scouts : never some scout in Both
"""
    )
    assert '{ send = "Order", to = "scout[0]", data = { x = 4, wait = "0 s"' in text
    assert '{ end = "look", of = "scout[1]", result = { found = true, took = "0 s"' in text
    assert '{ pass = "1501 ms" }' in text
    assert run(["test", "it.swarmtest.toml"]) == 1
    assert "property `NotBoth` is violated" in capsys.readouterr().out


def test_an_input_comes_before_a_delay_that_ends_at_the_same_time(
    saved: Saved, capsys: pytest.CaptureFixture[str]
) -> None:
    text = saved(
        """package model
event Go : std_msgs/Empty
endless statemachine Work {
  initial Idle
  state Idle {
    on Go -> Hit
    after 1 s -> Late
  }
  state Late { on Go -> Idle }
  state Hit { on Go -> Idle }
}
member Worker { behavior Work }
swarm Crew { worker : Worker }
property NoHits of Crew : never some worker in Hit
property Starts of Crew : some worker in Late at all times
"""
    )

    assert '{ pass = "999999 us" },\n  { send = "Go", to = "worker[0]" }' in text
    # A run that violates a property at the start has no input.
    assert text.endswith('steps = [\n  { pass = "1 s" },\n]\n')
    assert run(["test", "it.swarmtest.toml"]) == 1
    assert capsys.readouterr().out.count("FAILED") == 2


def test_a_machine_alone(saved: Saved, capsys: pytest.CaptureFixture[str]) -> None:
    text = saved(
        """package model
event Go : std_msgs/Empty
endless statemachine Work {
  initial Idle
  state Idle { on Go -> Busy }
  state Busy {}
}
property Rests of Work : in Idle at all times
property Back of Work : always possible in Idle
""",
        "--machine",
        "Work",
    )

    assert 'machine = "Work"' in text
    assert '{ send = "Go" }' in text
    outside = "  # Add here what must come from outside.\n"
    assert f'{outside}  {{ satisfies = "Back", within = "10 min" }},' in text
    assert f'{outside}  {{ count = 0, in = "Busy", within = "10 min" }},' in text
    assert run(["test", "it.swarmtest.toml"]) == 1
    assert capsys.readouterr().out.count("FAILED") == 3


def test_functions_end_as_in_the_run_where_robots_have_places(
    saved: Saved, capsys: pytest.CaptureFixture[str]
) -> None:
    text = saved(
        """package model
action Rest {}
function rest : swarm {
  action "rest" : Rest
  model hover(time = 3 s)
}
endless statemachine Work {
  initial Calm
  state Calm {
    do rest
    on succeeded, aborted -> Done
    after 30 s -> Late
  }
  state Done {}
  state Late {}
}
member Robot { behavior Work }
swarm Crew { robot : Robot }
property Punctual of Crew : never some robot in Late
"""
    )

    assert 'world = { kind = "abstract" }' in text
    assert run(["test", "it.swarmtest.toml"]) == 1
    assert "property `Punctual` is violated" in capsys.readouterr().out


def test_what_a_test_cannot_show_is_named(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    path = tmp_path / "it.swarmtest.toml"
    text = """package model
swarm event Tell : std_msgs/Empty
statemachine Work {
  var n : uint8 = 100
  initial Idle
  state Idle { after 1 s / send Tell, n = n + 200 -> Done }
  final Done
}
statemachine Hear {
  initial Idle
  state Idle { after 1 s -> Late }
  state Late {
    after 9 s -> Done
    on Tell [false] -> Done
  }
  final Done
}
member Worker { behavior Work }
member Listener { behavior Hear }
swarm Pair {
  worker : Worker
  listener : Listener
}
"""
    (tmp_path / "model.swarm").write_text(text, encoding="utf-8")
    run(["verify", str(tmp_path / "model.swarm"), "--save-test", str(path)])

    out = capsys.readouterr().out
    assert "SW1706" in out
    assert "not written as a test: lost-Tell: it is about all runs, and a test is about one" in out
    assert "SW1708" in out
    assert "not written as a test: fails-Work: a test warns of it, but does not fail" in out
    assert not path.exists()


def test_runs_to_one_state_have_names_of_their_own(
    saved: Saved, capsys: pytest.CaptureFixture[str]
) -> None:
    text = saved(
        """package model
event Go : std_msgs/Empty
statemachine Fly {
  var late : bool = false
  var free : bool = false
  initial Rest
  state Rest {
    on Go -> Trap
    after 1 s / late = true -> Rest
  }
  state Trap { on Go [late and free] -> Rest }
  final End
}
member Drone { behavior Fly }
swarm Field {
  drone : Drone[1..2]
  other : Drone
}
""",
        *("--size", "drone=1..2", "-o", "runs", "--results", "results.json"),
    )
    names = ["drone[0] goes on from Trap", "other[0] goes on from Trap"]
    assert re.findall(r'^name = "(.*)"$', text, re.MULTILINE) == names
    capsys.readouterr()
    assert run(["test", "it.swarmtest.toml"]) == 1
    assert re.findall("  FAILED  (.*)", capsys.readouterr().out) == names

    found = json.loads(Path("results.json").read_text(encoding="utf-8"))["findings"]
    runs = {each["role"]: Path(each["run"]) for each in found if "run" in each}
    assert [each.name for each in runs.values()] == ["waits-Trap.jsonl", "waits-Trap-2.jsonl"]
    for role, path in runs.items():
        last = json.loads(path.read_text(encoding="utf-8").splitlines()[-1])
        assert last["member"] == f"{role}[0]"


@pytest.mark.parametrize(
    ("name", "told"),
    [("it.toml", "must end with `.swarmtest.toml`"), ("there.swarmtest.toml", "exists")],
)
def test_a_wrong_file_is_told(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], name: str, told: str
) -> None:
    (tmp_path / "there.swarmtest.toml").write_text("# mine\n", encoding="utf-8")

    assert run(["verify", str(MODELS / "waits.swarm"), "--save-test", str(tmp_path / name)]) == 2
    assert told in capsys.readouterr().err
    assert (tmp_path / "there.swarmtest.toml").read_text(encoding="utf-8") == "# mine\n"
