"""Many runs: estimates, tests of chances, worst seeds, the same bytes for any number of jobs."""

from __future__ import annotations

import json
import os
import re
import shlex
from collections.abc import Sequence
from pathlib import Path
from typing import Any

import pytest

from swarmdsl.cli import run
from swarmdsl.execution.simulate.many_runs import many, one_run
from swarmdsl.execution.simulate.many_runs.histogram import bars

from .conftest import Simulate

MODEL = """
statemachine Trying {
  initial Try
  state Try {
    do go(speed = 1.0)
    on succeeded -> Good
    on aborted   -> Bad
  }
  final Good
  final Bad
}
member Robot { behavior Trying }
swarm Crew { robot : Robot[2]; fitness Worth }
fitness Worth {
  in good    : uint32   = count(robot in Good)
  in elapsed : duration = time until some robot in Good
  maximize good
}
property Fine of Crew : never some robot in Bad
property Often of Crew : all robot in Good within 1 min at least 0.5
property Rarely of Crew : eventually some robot in Good at most 0.5
"""
SCENARIO = """
[functions]
go = { duration = { uniform = ["1 s", "9 s"] }, aborted = 0.1 }
"""


def estimated(*arguments: str) -> dict[str, Any]:
    """Return the results of runs of the model that was simulated last."""
    words = ["model.swarm", "--scenario", "scenario.toml", "--results", "many.json", *arguments]
    run(["simulate", *words])
    found: dict[str, Any] = json.loads(Path("many.json").read_text(encoding="utf-8"))
    return found


def test_estimates_name_their_conditions(
    simulate: Simulate, capsys: pytest.CaptureFixture[str]
) -> None:
    simulate(MODEL, scenario=SCENARIO)
    found = estimated("--runs", "60", "--jobs", "1", "--seed", "5")
    said = capsys.readouterr()
    assert "Crew: 60 runs, seeds 5 to 64, scenario scenario.toml, intervals of 95 %" in said.out
    assert (found["runs"], found["first_seed"]) == (60, 5)
    fine, often, rarely = found["properties"]
    assert fine["true"] + fine["false"] == 60
    assert fine["false"] > 0
    assert "chance" not in fine
    low, high = often["interval"]
    assert low < often["true"] / 60 < high
    assert often["verdict"] == "true"
    assert often["indifference"] == pytest.approx([0.48, 0.52])
    assert rarely["verdict"] == "false"
    assert rarely["decided_after"] <= 60
    assert f"error[SW1609]: property `Fine` is violated in {fine['false']} of 60 runs" in said.err
    assert "error[SW1610]: property `Rarely` is not true in at most 0.5" in said.err
    good, _, worth = found["measures"]
    assert good["quantiles"]["1"] == 2
    assert worth["mean"] == good["mean"]


def test_the_worst_runs_can_be_repeated(simulate: Simulate) -> None:
    simulate(MODEL, scenario=SCENARIO)
    found = estimated("--runs", "30", "--jobs", "1")
    worst = next(each["seed"] for each in found["worst"] if each["why"] == "worst Worth")
    words = ["model.swarm", "--scenario", "scenario.toml", "--results", "one.json"]
    run(["simulate", *words, "--trace", "none", "--seed", str(worst)])
    one = json.loads(Path("one.json").read_text(encoding="utf-8"))
    assert one["fitness"]["value"] == found["measures"][-1]["quantiles"]["0"]


def test_the_command_of_a_run_chooses_the_same_subject(
    simulate: Simulate, capsys: pytest.CaptureFixture[str]
) -> None:
    simulate(f"{MODEL}\nswarm Others {{ robot : Robot[2] }}", scenario=SCENARIO)
    capsys.readouterr()
    words = ["--scenario", "scenario.toml", "--property", "Fine", "--until", "90500ms"]
    assert run(["simulate", "model.swarm", *words, "--runs", "20", "--jobs", "1"]) == 1
    lines = capsys.readouterr().out.splitlines()
    command = next(each for each in lines if each.startswith("violates Fine")).split(": ")[-1]
    assert "--until 90500ms" in command
    run([*shlex.split(command)[1:], "--trace", "none"])
    assert "error[SW1606]: property `Fine` is violated" in capsys.readouterr().err


def test_true_verdicts_about_no_part_of_a_run(
    simulate: Simulate, capsys: pytest.CaptureFixture[str]
) -> None:
    later = "property Later of Crew : after some robot in Bad, never all robot in Try"
    simulate(f"{MODEL}\n{later}", scenario=SCENARIO)
    found = estimated("--runs", "6", "--jobs", "1", "--until", "500ms")
    assert found["properties"][-1]["remarks"] == {"its scope never began": 6}
    assert "its scope never began in 6 runs" in capsys.readouterr().out


def test_failed_evaluations_are_counted(
    simulate: Simulate, capsys: pytest.CaptureFixture[str]
) -> None:
    model = MODEL.replace("initial Try", "var n : int32 = 0\n  initial Try").replace(
        "on aborted   -> Bad", "on aborted / n = 1 % n -> Bad"
    )
    simulate(model, scenario=SCENARIO)
    capsys.readouterr()
    words = ["model.swarm", "--scenario", "scenario.toml", "--runs", "30", "--jobs", "2"]
    run(["simulate", *words])
    said = capsys.readouterr()
    fine = re.search(r"^Fine +\d+ +(\d+)", said.out, re.MULTILINE)
    assert fine is not None
    assert "warning[SW1007]: evaluation failed in `Trying`: integer modulo by zero" in said.err
    assert f"times in {fine[1]} of 30 runs" in said.err


def test_a_value_out_of_the_range_of_its_type(
    simulate: Simulate, capsys: pytest.CaptureFixture[str]
) -> None:
    model = MODEL.replace("on aborted   -> Bad", "on aborted -> Try; after 1 min -> Bad")
    model = model.replace(
        "good    : uint32   = count(robot in Good)", "good : uint8 = total(robot starts go)"
    )
    simulate(model, scenario='[functions]\ngo = { duration = "100 ms", aborted = 1.0 }\n')
    found = estimated("--runs", "2", "--jobs", "1")
    assert found["measures"][-1]["count"] == 0
    said = capsys.readouterr().out
    assert re.search(r"no value in 2 runs: `good`: \d+ is out of range of uint8", said)


def test_a_histogram_of_nothing_is_not_written(
    simulate: Simulate, capsys: pytest.CaptureFixture[str]
) -> None:
    simulate(MODEL.replace("; fitness Worth }", " }"))
    words = ["--runs", "2", "--jobs", "1", "--histogram", "m.svg"]
    assert run(["simulate", "model.swarm", *words]) == 0
    said = capsys.readouterr().err
    assert "warning[SW1613]: `m.svg` is not written" in said
    assert "\nwritten: " not in said
    assert not Path("m.svg").exists()


@pytest.mark.parametrize("arguments", [(), ("--early",)])
def test_the_number_of_jobs_changes_nothing(
    simulate: Simulate, capsys: pytest.CaptureFixture[str], arguments: tuple[str, ...]
) -> None:
    simulate(MODEL, scenario=SCENARIO)
    capsys.readouterr()
    seen = set()
    for jobs in ("1", "3"):
        estimated("--runs", "200", "--jobs", jobs, "--histogram", "many.svg", *arguments)
        texts = [Path(name).read_bytes() for name in ("many.json", "many.svg")]
        seen.add((capsys.readouterr().out, *texts))
    assert len(seen) == 1


def test_early_stops_when_all_tests_have_decided(
    simulate: Simulate, capsys: pytest.CaptureFixture[str]
) -> None:
    simulate(MODEL, scenario=SCENARIO)
    found = estimated("--runs", "5000", "--jobs", "1", "--early")
    after = [each["decided_after"] for each in found["properties"] if "bound" in each]
    assert found["runs"] == max(after) < 5000
    said = capsys.readouterr().out
    assert f"Crew: {found['runs']} of 5000 runs, seeds" in said
    assert "intervals of 95 % for a fixed number of runs" in said


def test_an_interrupt_leaves_what_there_is(
    simulate: Simulate, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    def interrupted(runner: one_run.Runner, seed: int) -> one_run.Outcome:
        if seed == 7:
            raise KeyboardInterrupt
        return plain(runner, seed)

    plain = one_run.Runner.run
    simulate(MODEL, scenario=SCENARIO)
    monkeypatch.setattr(one_run.Runner, "run", interrupted)
    words = ["simulate", "model.swarm", "--runs", "50", "--jobs", "1"]
    assert run(words) == 130
    assert "Crew: 7 of 50 runs (interrupted), seeds 0 to 6" in capsys.readouterr().out


def _die(_seeds: Sequence[int]) -> list[one_run.Outcome]:
    os._exit(3)


def test_a_process_that_dies_is_reported(
    simulate: Simulate, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    simulate(MODEL, scenario=SCENARIO)
    monkeypatch.setattr(many, "run_seeds", _die)
    assert run(["simulate", "model.swarm", "--runs", "8", "--jobs", "2"]) == 1
    assert "error[SW1612]: a process ended by itself, after 0 runs" in capsys.readouterr().err


def test_runs_without_a_result(simulate: Simulate, capsys: pytest.CaptureFixture[str]) -> None:
    loop = """
statemachine Round {
  var n : int32 = 1
  initial A
  state A { on Start -> B }
  state B { [n > 0] -> C }
  state C { [n > 0] -> B; on Stop -> Over }
  final Over
}
"""
    scenario = '[[messages]]\nevent = "Start"\nat = "1 s"\n'
    simulate(loop, scenario=scenario)
    words = ["simulate", "model.swarm", "--scenario", "scenario.toml", "--runs", "3", "--jobs", "1"]
    assert run(words) == 1
    said = capsys.readouterr()
    assert "error[SW1611]: 3 of 3 runs have no result" in said.err
    assert "3 runs without a result" in said.out


@pytest.mark.parametrize(
    "arguments",
    [
        ("--runs", "0"),
        ("--runs", "9999999999"),
        ("--runs", "x"),
        ("--runs", "5", "--jobs", "0"),
        ("--jobs", "2"),
        ("--early",),
        ("--confidence", "0.9"),
        ("--indifference", "0.1"),
        ("--error", "0.1"),
        ("--histogram", "t.svg"),
        ("--runs", "5", "--confidence", "1"),
        ("--runs", "5", "--confidence", "nan"),
        ("--runs", "5", "--trace", "json"),
        ("--runs", "5", "--real-time"),
        ("--runs", "5", "--error", "0.5"),
        ("--runs", "5", "--timeline", "t.svg"),
        ("--runs", "5", "--events", "-"),
        ("--runs", "5", "--histogram", "t.png"),
    ],
)
def test_mistakes(
    simulate: Simulate, capsys: pytest.CaptureFixture[str], arguments: tuple[str, ...]
) -> None:
    simulate(MODEL, scenario=SCENARIO)
    capsys.readouterr()
    assert run(["simulate", "model.swarm", *arguments]) == 2
    assert "Traceback" not in capsys.readouterr().err


def test_an_unknown_property(simulate: Simulate, capsys: pytest.CaptureFixture[str]) -> None:
    simulate(MODEL, scenario=SCENARIO)
    words = ["--runs", "5", "--jobs", "1", "--property", "Nothing"]
    assert run(["simulate", "model.swarm", *words]) == 1
    assert "error[SW0202]" in capsys.readouterr().err


def test_bars() -> None:
    assert bars([2.0, 2.0]) == (0.0, [2])
    width, heights = bars([0.0, 1.0, 2.0, 3.0, 10.0])
    assert sum(heights) == 5
    assert width * len(heights) == pytest.approx(10)
