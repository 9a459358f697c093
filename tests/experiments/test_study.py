"""Experiments as files describe them: known effects are found, mistakes have places."""

from __future__ import annotations

import io
import json
import os
import shlex
import subprocess
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from pathlib import Path
from typing import Any

import pytest
import tomli

from swarmdsl.base.diagnostics.collector import Diagnostics
from swarmdsl.cli import run
from swarmdsl.cli.play_pages import play_runs
from swarmdsl.execution.experiments.running import Progress
from swarmdsl.execution.experiments.study import command
from swarmdsl.execution.experiments.study.command import Play, Request, run_study
from swarmdsl.execution.experiments.task import Row
from swarmdsl.execution.experiments.toml_text import toml_text

from .conftest import MODEL, SCENARIO

STUDY = """
model = "model.swarm"
scenario = "scenario.toml"
repetitions = 12
[factors]
robot.patience = ["2 s", "5 s", "8 s"]
count.robot = [2, 4]
"""


@pytest.fixture
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """A model with a scenario, in the current folder."""
    monkeypatch.chdir(tmp_path)
    (tmp_path / "model.swarm").write_text(MODEL, encoding="utf-8")
    (tmp_path / "scenario.toml").write_text(SCENARIO, encoding="utf-8")
    return tmp_path


def ran(
    text: str,
    *,
    resume: bool = False,
    output: str = "out",
    as_json: bool = True,
    play: Play | None = None,
) -> Any:
    """Run a study; return its results as data or text, or its diagnostics."""
    Path("study.toml").write_text(text, encoding="utf-8")
    out, told = io.StringIO(), []

    def open_model(name: str, beside: Path, _report: Diagnostics) -> Path:
        return beside / name

    def tell(report: Diagnostics) -> None:
        for each in report:
            place = ""
            if each.primary is not None:
                span = each.primary.span
                line, column = span.source.line_column(span.start)
                place = f"{span.source.name}:{line}:{column} "
            told.append(f"{place}{each.code} {each.message} ({each.help})")

    request = Request(Path("study.toml"), Path(output), resume=resume, as_json=as_json)
    succeeded = run_study(request, open_model, out, tell, play)
    if not out.getvalue():
        assert not succeeded
        return told
    return json.loads(out.getvalue()) if as_json else out.getvalue()


def test_a_full_factorial_design_finds_the_effects_of_the_model(folder: Path) -> None:
    """The best patience is 5 s: 0.9 better than 2 s and 8 s, with any seed."""
    found = ran(STUDY)
    assert found["factors"] == ["robot.patience", "count of robot"]
    patience, count = found["effects"]["main"]
    assert [each["levels"] for each in patience["levels"]] == [[2.0], [5.0], [8.0]]
    assert [each["adds"] for each in patience["levels"]] == pytest.approx([-0.3, 0.6, -0.3])
    assert patience["certain"]
    # Robots succeed with 0.8, in expectation.
    means = [each["mean"] for each in count["levels"]]
    assert means[1] - means[0] == pytest.approx(1.6, abs=0.7)
    (both,) = found["effects"]["interactions"]
    assert both["share"] == pytest.approx(0, abs=1e-9)
    assert found["best"] == {"robot.patience": 5.0, "count of robot": 4}
    by_levels = {(each.get("factor"), each["b"]): each for each in found["answers"]}
    answer = by_levels["robot.patience", "2 s"]
    assert (answer["a"], answer["better"], answer["paired"]) == ("5 s", "yes", True)
    assert answer["difference"] == pytest.approx(0.9)
    assert by_levels[None, "the model as it is"]["better"] == "yes"
    assert [each["runs"] for each in found["points"]] == [12] * 6


def test_results_are_the_same_after_resume_and_nothing_runs_twice(folder: Path) -> None:
    few = STUDY.replace("repetitions = 12", "repetitions = 4")
    ran(few)
    refused = ran(few)
    assert [each.split()[0] for each in refused] == ["SW1801"]
    resumed = ran(STUDY, resume=True)
    pages = {name: Path("out", name).read_bytes() for name in ("results.json", "report.html")}
    assert resumed == {**ran(STUDY, output="new")}
    for name, content in pages.items():
        assert Path("new", name).read_bytes() == content.replace(b"out/runs", b"new/runs")


def test_worst_runs_play_with_the_command_in_the_report(
    folder: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    text = ran(STUDY, as_json=False, play=play_runs)
    pages = [Path(each.strip()) for each in text.rpartition("written: ")[2].split(",")][-2:]
    worst = next(line for line in text.splitlines() if line.startswith("worst run"))
    value = float(worst.partition("(")[2].partition(")")[0])
    words = shlex.split(worst.rpartition(": ")[2])
    assert words[:2] == ["swarmc", "simulate"]
    best = next(line for line in text.splitlines() if line.startswith("best run"))
    assert float(best.partition("(")[2].partition(")")[0]) > value
    commands = [shlex.split(each.rpartition(": ")[2]) for each in (worst, best)]
    assert [Path(each[each.index("--play") + 1]) for each in commands] == pages
    contents = [each.read_bytes() for each in pages]
    pages[0].unlink()
    scenario = tomli.loads(Path(words[words.index("--scenario") + 1]).read_text())
    assert scenario["count"] == {"robot": 4}
    assert scenario["params"] == {"robot": {"patience": "5s"}}
    assert scenario["functions"] == tomli.loads(SCENARIO)["functions"]
    # The property is violated in this run, which is an error of the command.
    assert run([*words[1:], "--trace", "none", "--results", "one.json"]) in (0, 1)
    capsys.readouterr()
    assert json.loads(Path("one.json").read_text())["fitness"]["value"] == value
    assert pages[0].read_bytes() == contents[0]


def test_ctrl_c_tells_what_the_runs_that_are_done_show(
    folder: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    class Interrupting(Progress):
        left = 3

        def add(self, rows: Sequence[Row]) -> None:
            self.left -= 1
            if not self.left:
                raise KeyboardInterrupt

    @contextmanager
    def interrupting(*_: object) -> Iterator[Progress]:
        yield Interrupting()

    Path("study.toml").write_text(STUDY, encoding="utf-8")
    words = ["experiment", "study.toml", "-o", "out", "--jobs", "1"]
    with monkeypatch.context() as patched:
        patched.setattr(command, "shown", interrupting)
        assert run(words) == 130
    text = capsys.readouterr().out
    assert "interrupted: what follows is about the runs that are done" in text
    assert "the best point is" in text
    assert run([*words, "--resume", "--json"]) == 0
    resumed = json.loads(capsys.readouterr().out)
    assert resumed == ran(STUDY, output="new")


def test_runs_without_a_value_are_told(folder: Path) -> None:
    """The model of each run fails, which is an error and no answer."""
    endless = MODEL.replace("after patience -> Try", "[patience > 0 s] -> Turn").replace(
        "  final Good", "  state Turn { [patience > 0 s] -> Wait }\n  final Good"
    )
    Path("model.swarm").write_text(endless, encoding="utf-8")
    text = ran("repetitions = 1\n[factors]\ncount.robot = [1]", as_json=False)
    assert "no run has a value" in text
    assert "0 of 1" in text
    # The command that plays such a run is there.
    assert "swarmc simulate . --scenario out/runs/1.toml --play out/runs/1-1.html --seed 1" in text


@pytest.mark.parametrize("design", ["latin", "sobol"])
def test_sampled_designs_find_slopes(folder: Path, design: str) -> None:
    """More failures make the swarm worse: each costs one of 4 robots."""
    found = ran(
        f"""
model = "model.swarm"
scenario = "scenario.toml"
repetitions = 20
design = "{design}"
points = 16
[factors]
scenario.functions.go.aborted = {{ from = 0.0, to = 1.0 }}
robot.patience = {{ from = "4900 ms", to = "5100 ms" }}
"""
    )
    first, _ = found["slopes"]["slopes"]
    width = first["to"] - first["from"]
    assert first["factor"] == "scenario functions.go.aborted"
    assert first["change"] == pytest.approx(-1 * width, abs=0.2)
    assert first["certain"]
    assert found["slopes"]["explained"] > 0.8
    assert "effects" not in found


def test_sensitivity_finds_what_matters(folder: Path) -> None:
    """Without chance, the fitness is a square of the patience: the number adds a straight line."""
    text = """
model = "model.swarm"
repetitions = 1
design = "DESIGN"
points = POINTS
[factors]
robot.patience = { from = "0 s", to = "10 s" }
count.robot = { from = 1, to = 2 }
"""
    indices = ran(text.replace("DESIGN", "indices").replace("POINTS", "64"))
    patience, count = indices["sobol_indices"]
    # (p - 5)^2 / 10 has the variance (4/45) * 5^4 / 100, the number 1/4.
    whole = 4 / 45 * 5**4 / 100 + 1 / 4
    assert count["first"] == pytest.approx(1 / 4 / whole, abs=0.06)
    assert patience["total"] == pytest.approx(1 - 1 / 4 / whole, abs=0.06)
    effects = ran(text.replace("DESIGN", "morris").replace("POINTS", "8"), output="morris")
    patience, count = effects["elementary_effects"]
    assert count["size"] == pytest.approx(1 / (2 / 3))
    assert patience["deviation"] > 0


def test_scenarios_faults_and_models_are_factors(folder: Path) -> None:
    Path("calm.toml").write_text(SCENARIO.replace("aborted = 0.2", "aborted = 0"))
    Path("new.swarm").write_text(MODEL.replace("duration = 8 s", "duration = 5 s"))
    found = ran(
        """
repetitions = 8
[factors]
model = ["model.swarm", "new.swarm"]
scenario = ["scenario.toml", "calm.toml"]
[factors.faults]
none = []
"one lost" = [{ at = "1 s", lost = "robot[0]" }]
"""
    )
    model, scenario, faults = found["effects"]["main"]
    adds = [each["adds"] for each in model["levels"]]
    assert adds[1] > adds[0]
    assert [each["levels"] for each in scenario["levels"]] == [["scenario.toml"], ["calm.toml"]]
    none, lost = faults["levels"]
    assert none["adds"] > lost["adds"]
    # The only robot waits for 1 s, and has a fitness of -(1 - 5)^2 / 10.
    for each in found["points"]:
        if each["settings"]["faults"] == "one lost":
            assert each["mean"] == pytest.approx(-1.6)
    assert found["best"] == {"model": "new.swarm", "scenario": "calm.toml", "faults": "none"}


def test_a_property_can_be_measured(folder: Path) -> None:
    found = ran(
        STUDY.replace("repetitions = 12", 'repetitions = 12\nmeasure = "Fine"').replace(
            'robot.patience = ["2 s", "5 s", "8 s"]', "scenario.functions.go.aborted = [0.0, 1.0]"
        )
    )
    means = [each["mean"] for each in found["points"]]
    assert means == [1, 1, 0, 0]
    assert found["points"][2]["violations"] == {"Fine": list(range(1, 13))}


def test_two_revisions_of_a_model_are_compared(
    folder: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    def git(*words: str) -> None:
        names = {
            f"GIT_{who}_{what}": "x"
            for who in ("AUTHOR", "COMMITTER")
            for what in ("NAME", "EMAIL")
        }
        subprocess.run(
            ["git", *words], check=True, env={**os.environ, **names}, capture_output=True
        )

    git("init", "-q")
    git("add", "-A")
    git("commit", "-qm", "first")
    Path("model.swarm").write_text(MODEL.replace("duration = 8 s", "duration = 5 s"))
    Path("study.toml").write_text(
        """
scenario = "scenario.toml"
repetitions = 6
[factors]
model = ["HEAD:model.swarm", "model.swarm"]
"""
    )
    for more in ((), ("--resume",)):
        assert run(["experiment", "study.toml", "-o", "out", "--jobs", "1", "--json", *more]) == 0
        found = json.loads(capsys.readouterr().out)
        first, second = found["points"]
        assert second["mean"] - first["mean"] == pytest.approx(0.9)
    assert run(["results", "out"]) == 0
    shown = capsys.readouterr().out
    assert "HEAD:model.swarm" in shown
    Path("study.toml").write_text('model = "HEAD:model.swarm"\n[factors]\ncount.robot = [1]')
    assert run(["experiment", "study.toml", "-o", "old", "--jobs", "1"]) == 0
    played = "# at HEAD: swarmc simulate model.swarm --scenario old/runs/1.toml --play old/runs/"
    assert played in capsys.readouterr().out
    # The model as it is, is the first one: its runs are the same.
    assert "12 runs in 2 groups" in shown


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        ('model = "model.swarm"', "study.toml:1:1 SW1821 the experiment"),
        ("[factors", "study.toml:1:9 SW0011"),
        (
            "x = 1\n[factors]\ncount.robot = [1]",
            "study.toml:1:1 SW0012 an experiment has no key `x`",
        ),
        ("[factors]\ncount.robot = 4", "study.toml:2:15 SW0013"),
        ("[factors]\ncount.robot = []", "study.toml:2:15 SW0013"),
        ("[factors]\ncount.robot = [1, 2, 1]", "study.toml:2:22 SW0404"),
        ('[factors]\ncount.robot = [1, "2"]', "study.toml:2:19 SW0013"),
        ("[factors]\ncount.robot = { from = 3, to = 2 }", "study.toml:2:32 SW0013"),
        ("[factors]\ncount.robot = { from = 3 }", "study.toml:2:7 SW1008"),
        ("[factors]\nrobot.patience = { from = 1.0, to = 2.0 }", "study.toml:2:7 SW1822"),
        ("[factors]\ncount.robot = [2, 9]", "study.toml:2:19 SW1825 `count of robot` cannot be 9"),
        ("[factors]\ncount.robots = [2]", "study.toml:2:7 SW1825"),
        ("[factors]\nrobot.patience = [1.5]", "study.toml:2:19 SW1825"),
        ("[factors]\nscenario.netwrk.loss = [0.1]", "study.toml:2:17 SW1825"),
        ('[factors]\nscenario = ["no.toml"]', "study.toml:2:13 SW0001"),
        ('scenario = "no.toml"\n[factors]\ncount.robot = [2]', "study.toml:1:12 SW0001"),
        ("[factors]\npatience = [2]", "study.toml:2:1 SW0202 no factor called `patience`"),
        ("[factors]\ncount.robot = { from = 1, to = 2, step = 3 }", "study.toml:2:42 SW0013"),
        ('model = "no.swarm"\n[factors]\ncount.robot = [2]', "study.toml:1:9 SW0001"),
        ('measure = "speed"\n[factors]\ncount.robot = [2]', "study.toml:1:11 SW1824"),
        ('measure = "good"\n[factors]\ncount.robot = [2]', "study.toml:1:11 SW1008"),
        ('swarm = "Flok"\n[factors]\ncount.robot = [2]', "study.toml:1:9 SW0202"),
        ('design = "ful"\n[factors]\ncount.robot = [2]', "study.toml:1:10 SW0202"),
        ("points = 9\n[factors]\ncount.robot = [2]", "study.toml:1:1 SW0012"),
        (
            'design="latin"\npoints=1000000\nrepetitions=100\n[factors]\ncount.robot = [2]',
            "study.toml:1:8 SW1823 100,000,000 runs are too many",
        ),
        ("confidence = 1\n[factors]\ncount.robot = [2]", "study.toml:1:14 SW0013"),
        ("seed = -1\n[factors]\ncount.robot = [2]", "study.toml:1:8 SW0013"),
    ],
)
def test_mistakes_are_told_at_their_place_with_a_way_out(
    folder: Path, text: str, expected: str
) -> None:
    told = ran(text)
    assert len(told) == 1, told
    assert expected in told[0]
    assert not Path("out").exists()


def test_all_mistakes_are_told_in_one_go(folder: Path) -> None:
    Path("bad.toml").write_text("until = 3\n[functions.fly]\naborted = 2\n")
    Path("odd.toml").write_text("until = = 3")
    Path("two.swarm").write_text(MODEL + "swarm Other { robot : Robot }")
    factors = "[factors]\ncount.robto = [2, 3]\ncount.robot = [0, 1, 9]\nrobot.patience = [4, 5]\n"
    told = ran('scenario = "scenario.toml"\nmodel = "model.swarm"\n' + factors)
    places = [each.split()[0] for each in told]
    assert places == [f"study.toml:{at}" for at in ("4:7", "5:16", "5:22", "6:19", "6:22")]
    told = ran('scenario = "bad.toml"\nmodel = "model.swarm"\n[factors]\ncount.robot = [1]')
    assert [each.split()[0] for each in told] == ["bad.toml:1:9", "bad.toml:2:12"]
    told = ran('scenario = "odd.toml"\nmodel = "model.swarm"\n[factors]\ncount.robot = [1]')
    assert [each.split()[0] for each in told] == ["odd.toml:1:9"]
    (told,) = ran('model = "two.swarm"\n[factors]\ncount.robot = [1]')
    assert told.startswith("study.toml:1:9 SW1002")
    wrong = """model = 3
scenario = 4
repetitions = "x"
seed = -1
until = 1
world = "x"
measure = 2
goal = "x"
confidence = 7
design = "x"
foo = 1
[factors]
count.robot = 3
"""
    told = sorted(int(each.split(":")[1]) for each in ran(wrong))
    assert told == [1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 13]


def test_a_feed_tells_what_happens(folder: Path, capsys: pytest.CaptureFixture[str]) -> None:
    Path("study.toml").write_text(STUDY.replace("= 12", "= 2"), encoding="utf-8")
    words = ["experiment", "study.toml", "--jobs", "1", "-o", "out"]
    assert run([*words, "--feed", "feed.jsonl"]) == 0
    lines = [json.loads(line) for line in Path("feed.jsonl").read_text().splitlines()]
    assert [lines[0]["event"], lines[-1]["event"]] == ["begin", "end"]
    assert lines[0] == {
        "event": "begin",
        "subject": "Crew",
        "design": "full",
        "workers": "this process",
    }
    assert [each["done"] for each in lines if each["event"] == "runs"][-1] == 14
    results = json.loads(Path("out/results.json").read_text())
    assert lines[-1] == {"event": "end", **results}
    assert run([*words, "--feed", "study.toml", "--resume"]) == 2
    assert "study.toml" in capsys.readouterr().err


def test_a_level_that_another_factor_makes_right_is_no_mistake(folder: Path) -> None:
    """Without the number of robots, there is no fourth one to lose."""
    text = """
scenario = "scenario.toml"
repetitions = 2
[factors]
count.robot = [4, 6]
faults.none = []
faults.fourth = [{ at = "1 s", lost = "robot[3]" }]
"""
    assert len(ran(text)["points"]) == 4
    (told,) = ran(text.replace("robot[3]", "robot[4]"), output="other")
    assert told.startswith("study.toml:7:17 SW1825 `faults` cannot be fourth")


def test_toml_of_a_scenario_is_read_back(folder: Path) -> None:
    values = {
        "seed": 3,
        "until": '1 "min"\\',
        "params": {'uav."x"': {"a": 0.1, "b": True}, "r": {}},
        "network": {"latency": {"uniform": ["1 ms", "2 ms"]}},
        "faults": [{"at": "1 s", "lost": "robot[0]"}, {"apart": [["a\x7f\n"], ["b"]]}],
    }
    assert tomli.loads(toml_text(values)) == values
