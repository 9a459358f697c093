"""`swarmc simulate` and `swarmc test` in the flat world: choice, scenarios, models of projects."""

from __future__ import annotations

import json
from collections.abc import Callable
from pathlib import Path

import pytest

from swarmdsl.cli import run
from swarmdsl.execution.simulate.inputs import choose_space

from .worlds import TEXT

COVERAGE = '[functions.walk]\nmodel = "coverage"\narguments = { width = 20, speed = 30 }\n'
Simulate = Callable[..., tuple[int, str, str]]


@pytest.fixture
def simulate(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> Simulate:
    monkeypatch.chdir(tmp_path)

    def simulate(*arguments: str, scenario: str = "", text: str = TEXT) -> tuple[int, str, str]:
        Path("demo.swarm").write_text(text.replace("ROBOTS", "2"), encoding="utf-8")
        Path("s.toml").write_text(scenario, encoding="utf-8")
        code = run(["simulate", "demo.swarm", "--scenario", "s.toml", *arguments])
        said = capsys.readouterr()
        return code, said.out, said.err

    return simulate


def test_a_scenario_gives_a_function_a_model(simulate: Simulate) -> None:
    code, out, err = simulate("--trace", "json", scenario=COVERAGE)
    assert code == 0, err
    lines = [json.loads(line) for line in out.splitlines()]
    ends = [line for line in lines if line["event"] == "do.Walk.succeeded"]
    assert {line["member"] for line in ends} == {"rover[0]", "rover[1]"}
    assert all(len(line["at"]) == 3 for line in lines)
    assert all(line["t"] > 100_000 for line in ends)  # at 1 m/s: that of the body


def test_one_robot_can_have_another_model(simulate: Simulate) -> None:
    more = '[functions.walk.of."rover[1]"]\nduration = "2 s"\n'
    code, out, _ = simulate("--trace", "json", "--until", "10s", scenario=COVERAGE + more)
    assert code == 0
    lines = [json.loads(line) for line in out.splitlines()]
    ends = [(line["member"], line["t"]) for line in lines if line["event"] == "do.Walk.succeeded"]
    assert ends == [("rover[1]", 2000)]


def test_the_world_can_be_chosen(simulate: Simulate) -> None:
    _, plain, _ = simulate("--until", "5s", "--trace", "json", "--world", "abstract")
    _, same, _ = simulate("--until", "5s", "--trace", "json")
    assert plain == same
    code, out, _ = simulate("--until", "5s", "--trace", "json", "--world", "flat")
    assert code == 0
    lines = [json.loads(line) for line in out.splitlines()]
    assert all("at" in line for line in lines)
    assert [{k: v for k, v in line.items() if k != "at"} for line in lines] == [
        json.loads(line) for line in plain.splitlines()
    ]
    _, of_scenario, _ = simulate(
        "--until", "5s", "--trace", "json", scenario='[world]\nkind = "flat"\n'
    )
    assert of_scenario == out


def test_many_runs_are_as_alone(simulate: Simulate, tmp_path: Path) -> None:
    text = TEXT.replace(
        "  environment Field\n}",
        """  environment Field
  fitness Fast
}
fitness Fast {
  in ready  : uint32   = count(rover in Done)
  in walked : duration = time(rover in Walk)
  minimize walked / 1 s + 100 * ready
}
""",
    )
    scenario = COVERAGE.replace('"coverage"', '"random_walk"').replace(
        "width = 20, speed = 30", 'leg = 7, time = "30 s"'
    )
    found = []
    for jobs in ("1", "2"):
        code, _, err = simulate(
            "--runs", "5", "--jobs", jobs, "--until", "60s", "--results", f"{jobs}.json",
            scenario=scenario, text=text,
        )  # fmt: skip
        assert code == 0, err
        found.append(Path(f"{jobs}.json").read_text(encoding="utf-8"))
    assert found[0] == found[1]
    assert json.loads(found[0])["runs"] == 5


@pytest.mark.parametrize(
    ("scenario", "said"),
    [
        ('[functions.walk]\nmodel = "covrage"\n', "no model called `covrage`"),
        ('[functions.walk]\nmodel = "coverage"\narguments = { widht = 3 }\n', "has no key `widht`"),
        (
            '[functions.walk]\nmodel = "coverage"\narguments = { width = -3 }\n',
            "`width` takes a length in metres, at least 0.01 m, not `-3`",
        ),
        (
            '[functions.walk]\nmodel = "coverage"\narguments = { width = 1e-9 }\n',
            "`width` takes a length in metres, at least 0.01 m, not `1e-09`",
        ),
        (
            '[functions.walk]\nmodel = "take_off"\narguments = { height = -2 }\n',
            "`height` takes a length in metres, at least 0 m, not `-2`",
        ),
        (
            '[functions.walk]\nmodel = "go_to"\narguments = { speed = 0 }\n',
            "`speed` takes a speed in m/s, at least 0.001 m/s, not `0`",
        ),
        (
            '[functions.walk]\nmodel = "sense"\narguments = { target = "nobody" }\n',
            "no target called `nobody`",
        ),
        (
            '[functions.walk]\nmodel = "coverage"\narguments = { area = "x" }\n',
            "no area called `x`",
        ),
        (
            '[functions.walk]\nmodel = "go_to"\narguments = { to = [1] }\n',
            "`to` takes a place: a list of x, y and perhaps z, in metres",
        ),
        (
            '[functions.walk]\nmodel = "random_walk"\narguments = { time = 3 }\n',
            "`time` takes a time like",
        ),
        (
            '[functions.walk]\nmodel = "go_to"\nduration = "3 s"\n',
            "`duration` takes no value beside a `model`",
        ),
        (
            '[functions.walk]\nmodel = "flock"\narguments = { rule = "viscek" }\n',
            "did you mean `vicsek`?",
        ),
        (
            '[functions.walk]\nmodel = "follow_path"\narguments = { path = [[1, 2], [3]] }\n',
            "`path` takes a place",
        ),
        (
            '[functions.walk]\nmodel = "follow_path"\narguments = { path = [] }\n',
            "`path` takes a path: a list of places",
        ),
        ("[functions.walk]\narguments = {}\n", "`arguments` takes no arguments without a `model`"),
        ('[functions."*"]\nmodel = "go_to"\n', "`model` takes no model"),
        ('[world]\nkind = "round"\n', "no world called `round`"),
        ('[world]\nstep = "0 s"\n', "`step` takes a time from 1 ms to 10 s"),
        ("[world]\nfoo = 1\n", "`[world]` has no key `foo`"),
        ('[functions.walk]\nmodel = "go_to"\narguments = 3\n', "`arguments` takes a table"),
    ],
)
def test_wrong_scenarios_are_reported(simulate: Simulate, scenario: str, said: str) -> None:
    code, _, err = simulate(scenario=scenario)
    assert code == 1
    assert said in err
    assert "Traceback" not in err


def test_a_scenario_names_targets_of_the_environment(simulate: Simulate) -> None:
    text = TEXT.replace("x 30 m", "x 30 m; target person[2] at random; target person at (1 m, 1 m)")
    for target, said in [
        ("person", ""),
        ("person[2]", ""),
        ("person[3]", "no target called `person[3]`"),
        ("persn", "did you mean `person`?"),
    ]:
        scenario = f'[functions.walk]\nmodel = "sense"\narguments = {{ target = "{target}" }}\n'
        code, _, err = simulate("--until", "5s", scenario=scenario, text=text)
        assert (code, "error" in err) == ((1, True) if said else (0, False)), err
        assert said in err


@pytest.mark.parametrize(
    ("model", "said"),
    [
        ("take_off(height = altitude - 3 m)", "argument `height` is -3: it must be at least 0 m"),
        ("take_off", "argument `height` is -5: it must be at least 0 m"),
    ],
)
def test_a_call_with_an_impossible_argument_is_aborted(
    simulate: Simulate, model: str, said: str
) -> None:
    text = TEXT.replace('"walk" : demo_msgs/Go', f'"walk" : demo_msgs/Go; model {model}')
    text = text.replace("altitude : float64", "altitude : float64 in m")
    text = text.replace("altitude = 0", f"altitude = {-5 if model == 'take_off' else 0} m")
    code, out, err = simulate("--until", "5s", "--trace", "json", text=text)
    assert code == 0, err
    assert said in err
    ends = [json.loads(line) for line in out.splitlines()]
    assert [each["t"] for each in ends if each["event"] == "do.Walk.aborted"] == [0, 0]


def test_without_numpy_positions_are_left_out(
    simulate: Simulate, monkeypatch: pytest.MonkeyPatch
) -> None:
    _, plain, _ = simulate("--until", "5s", "--trace", "json")
    monkeypatch.setattr(choose_space, "is_installed", lambda: False)
    code, out, err = simulate("--until", "5s", "--trace", "json", scenario=COVERAGE)
    assert code == 0
    assert err.count("warning[SW1013]: the positions of `S` are left out: there is no NumPy") == 1
    assert "pip install 'swarmdsl[world]'" in err
    assert out == plain
    code, _, err = simulate("--world", "flat")
    assert code == 1
    assert "error[SW1014]: there is no flat world here: it needs NumPy" in err


def test_documents_have_no_places(simulate: Simulate, capsys: pytest.CaptureFixture[str]) -> None:
    Path("m.scxml").write_text(
        '<scxml xmlns="http://www.w3.org/2005/07/scxml" version="1.0"><state id="a"/></scxml>',
        encoding="utf-8",
    )
    code = run(["simulate", "m.scxml", "--world", "flat"])
    assert code == 1
    assert "error[SW1014]: there is no flat world here: it needs a model" in capsys.readouterr().err


PAINT = """
import numpy as np
from swarmdsl.execution.space.functions.base import Model, statuses
from swarmdsl.ir.function_models import Argument

class Paint(Model):
    arguments = (Argument("seconds", "number", 3.0, "how long"),)

    def __init__(self, stage):
        super().__init__(stage)
        self.left = np.zeros(stage.rows)

    def start(self, who, arguments):
        self.left[who] = arguments["seconds"]

    def step(self, who, dt):
        self.left[who] -= dt
        return statuses(self.left[who] < dt / 2)

    def result(self, row):
        return {"target_id": "painted"}

class Broken(Paint):
    def step(self, who, dt):
        raise RuntimeError("no paint")

class Long(Paint):
    def step(self, who, dt):
        return np.zeros(len(who) + 1)

class Text(Paint):
    def step(self, who, dt):
        return "done"

class Leaving(Paint):
    def step(self, who, dt):
        raise SystemExit(0)

class Endless(Paint):
    def step(self, who, dt):
        self.stage.wanted_x[who] = np.nan
        return super().step(who, dt)

class Replacing(Paint):
    def step(self, who, dt):
        self.stage.wanted_x = np.zeros(1)
        return super().step(who, dt)

class Idle(Model):
    pass

NUMBER = 3
"""


@pytest.fixture
def project(tmp_path: Path) -> Path:
    (tmp_path / "functions").mkdir()
    (tmp_path / "functions" / "paint.py").write_text(PAINT, encoding="utf-8")
    (tmp_path / "functions" / "bad.py").write_text("import nowhere", encoding="utf-8")
    (tmp_path / "swarm.toml").write_text(
        """[models]
paint  = "functions/paint.py:Paint"
broken = "functions/paint.py:Broken"
long   = "functions/paint.py:Long"
text   = "functions/paint.py:Text"
leaving = "functions/paint.py:Leaving"
endless = "functions/paint.py:Endless"
replacing = "functions/paint.py:Replacing"
idle = "functions/paint.py:Idle"
number = "functions/paint.py:NUMBER"
typo   = "functions/paint.py:Piant"
bad    = "functions/bad.py:Paint"
gone   = "functions/gone.py:Paint"
entry  = "no_such_entry"
""",
        encoding="utf-8",
    )
    return tmp_path


def uses(name: str, arguments: str = "") -> str:
    return f'[functions.walk]\nmodel = "{name}"\n{arguments}\n'


def test_a_project_has_models_of_its_own(simulate: Simulate, project: Path) -> None:
    code, out, err = simulate(
        "--trace", "json", "--until", "9s", scenario=uses("paint", "arguments = { seconds = 4 }")
    )
    assert code == 0, err
    lines = [json.loads(line) for line in out.splitlines()]
    (end,) = (line for line in lines if line["event"] and line["member"] == "rover[0]")
    assert (end["t"], end["data"]["target_id"]) == (4000, "painted")


@pytest.mark.parametrize(
    ("name", "said"),
    [
        ("number", "error[SW1016]: cannot load model `number`: `NUMBER` is no class made from"),
        ("typo", "cannot load model `typo`"),
        ("bad", "cannot load model `bad`: ModuleNotFoundError: No module named 'nowhere'"),
        ("gone", "cannot load model `gone`: there is no file"),
        ("entry", "no package has an entry point `no_such_entry` of group `swarmdsl.models`"),
        ("broken", "error[SW1015]: the model of `walk` fails at 100 ms: RuntimeError: no paint"),
        ("long", "the model of `walk` fails at 100 ms: `step` returns (3,)"),
        ("text", "the model of `walk` fails at 100 ms: `step` returns str, not a status"),
        ("leaving", "error[SW1015]: the model of `walk` fails at 100 ms: it ends the process"),
        ("endless", "fails at 100 ms: `step` wants a velocity that is not finite"),
        ("replacing", "fails at 100 ms: it replaces `stage.wanted_x` by something of another"),
        ("idle", "error[SW1016]: cannot load model `idle`: `Idle` has no method `step`"),
    ],
)
def test_errors_of_models_of_a_project_are_theirs(
    simulate: Simulate, project: Path, name: str, said: str
) -> None:
    code, _, err = simulate(scenario=uses(name))
    assert code == 1
    assert said in err
    assert "Traceback" not in err


def test_a_model_of_a_project_that_fails_in_many_runs(simulate: Simulate, project: Path) -> None:
    code, _, err = simulate("--runs", "3", "--jobs", "1", scenario=uses("broken"))
    assert code == 1
    assert "3 of 3 runs have no result: the model of `walk` fails: RuntimeError: no paint" in err


def test_an_unknown_argument_of_a_model_of_a_project(simulate: Simulate, project: Path) -> None:
    code, _, err = simulate(scenario=uses("paint", "arguments = { secnods = 4 }"))
    assert code == 1
    assert "model `paint` has no key `secnods`" in err


@pytest.mark.parametrize(
    ("line", "said"),
    [
        ('x = "paint.py"', "takes a class in a file"),
        ("x = 3", "`x` takes a string"),
        ('go_to = "a.py:B"', "takes a name that swarmdsl has no model of"),
        ('"a b" = "a.py:B"', "takes names, not `a b`"),
    ],
)
def test_wrong_models_in_the_project_file(
    simulate: Simulate, tmp_path: Path, line: str, said: str
) -> None:
    (tmp_path / "swarm.toml").write_text(f"[models]\n{line}\n", encoding="utf-8")
    code, _, err = simulate()
    assert code == 1
    assert said in err


def test_tests_run_in_the_world_too(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    Path("demo.swarm").write_text(TEXT.replace("ROBOTS", "1"), encoding="utf-8")
    Path("demo.swarmtest.toml").write_text(
        """
[[test]]
name  = "sweeps"
steps = [
  { all = "rover", in = "Walk", for = "1 min" },
  { all = "rover", in = "Done", within = "30 min" },
]
[test.scenario.functions.walk]
model     = "coverage"
arguments = { width = 20 }
""",
        encoding="utf-8",
    )
    code = run(["test", "demo.swarmtest.toml"])
    said = capsys.readouterr()
    assert code == 0, said.out + said.err


def test_a_model_of_a_project_that_fails_fails_a_test(
    simulate: Simulate, project: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    simulate("--until", "0s", "--world", "abstract")  # writes the model
    for name in ("broken", "paint"):
        text = '[[test]]\nname = "it paints"\nsteps = [{ pass = "1s" }]\n'
        text += f'[test.scenario.functions.walk]\nmodel = "{name}"\n'
        text += "arguments = { seconds = 4 }\n" * (name == "paint")
        Path(f"{name}.swarmtest.toml").write_text(text, encoding="utf-8")
    assert run(["test", "."]) == 1
    said = capsys.readouterr()
    assert "error[SW1015]: the model of `walk` fails at 100 ms: RuntimeError: no paint" in said.out
    assert "1 passed, 1 failed" in said.err


def test_the_summary_tells_how_far_robots_went(simulate: Simulate) -> None:
    scenario = '[functions.walk]\nmodel = "random_walk"\narguments = { time = "20 s" }\n'
    code, _, err = simulate("--trace", "none", scenario=scenario)
    assert code == 0
    lines = err.splitlines()
    (head,) = (
        n
        for n, line in enumerate(lines)
        if line.split() == ["member", "distance", "covered", "first"]
    )
    rows = [line.split() for line in lines[head + 1 : head + 4]]
    assert [row[0] for row in rows] == ["rover[0]", "rover[1]", "together"]
    distances = [float(row[1]) for row in rows]
    assert all(19 < each <= 20 for each in distances[:2])  # less by the steps at walls
    assert distances[2] == pytest.approx(sum(distances[:2]), abs=0.11)
    shares = [float(row[3]) for row in rows]
    assert 0 < shares[0] + shares[1] == pytest.approx(shares[2], abs=0.11)


def test_trace_files_tell_where_robots_are(simulate: Simulate) -> None:
    scenario = '[functions.walk]\nmodel = "random_walk"\narguments = { time = "3500 ms" }\n'
    code, _, err = simulate("--trace-file", "t.jsonl", "--until", "9s", scenario=scenario)
    assert code == 0, err
    lines = [json.loads(line) for line in Path("t.jsonl").read_text().splitlines()]
    moved = [line for line in lines if "moved" in line]
    assert [line["t"] for line in moved] == [1000, 2000, 3000]
    assert all(line["moved"].keys() == {"rover[0]", "rover[1]"} for line in moved)
    assert [line["t"] for line in lines] == sorted(line["t"] for line in lines)
    assert run(["simulate", "demo.swarm", "--replay", "t.jsonl"]) == 0


def test_devices_whose_values_cannot_be_are_reported(simulate: Simulate) -> None:
    devices = """  param reach : float64 = 2.0
  radio { range = 1 m * reach, loss = reach / 8.0 }
  body { speed = 1 m/s / (reach - 5.0) * 0.0 + 1 m/s }
"""
    text = TEXT.replace("  behavior Walking\n", f"  behavior Walking\n{devices}")
    code, _, err = simulate("--until", "1s", "--world", "flat", text=text)
    assert code == 0, err
    for reach, reason in (
        (-3.0, "`range` of the radio of member `Rover` is -3: it must be a number from 0 on"),
        (16.0, "`loss` of the radio of member `Rover` is 2: it must be a probability"),
        (5.0, "`speed` of the body of member `Rover` has no value: "),
    ):
        scenario = f"[params.rover]\nreach = {reach}\n"
        code, out, err = simulate("--until", "1s", "--world", "flat", scenario=scenario, text=text)
        assert (code, out) == (1, ""), err
        assert f"error[SW1017]: {reason}" in err


@pytest.mark.filterwarnings("error")
def test_a_battery_without_room_has_no_share_left(simulate: Simulate) -> None:
    battery = "  param full : float64 = 2.0\n  battery { capacity = 1 Wh * full }\n"
    text = TEXT.replace("  behavior Walking\n", f"  behavior Walking\n{battery}")
    scenario = "[params.rover]\nfull = 0.0\n"
    code, _, err = simulate("--until", "1s", "--world", "flat", scenario=scenario, text=text)
    assert code == 0, err
    (row,) = (
        line.split() for line in err.splitlines() if line.startswith("rover[0]") and " Wh " in line
    )
    assert row[3:6] == ["0.00", "Wh", "-"]
    assert "nan" not in err
