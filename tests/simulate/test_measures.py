"""Measures and the fitness are computed in simulations and of replayed traces."""

from __future__ import annotations

import json
import re
import runpy
from pathlib import Path

import pytest

from swarmdsl.cli import run

from .conftest import Ran, Simulate
from .test_properties import EVENTS, MODEL

SWARM = MODEL.replace("swarm Crew { robot", "swarm Crew { fitness Pace; robot")


def with_inputs(*inputs: str, goal: str = "maximize 1") -> str:
    """Return the model with a fitness."""
    lines = "\n".join(f"  in {each}" for each in inputs)
    return f"{SWARM}\nfitness Pace {{\n{lines}\n  {goal}\n}}\n"


def measured(ran: Ran) -> dict[str, tuple[str, str]]:
    """Return the values in a summary, with what is said of them."""
    rows = re.search(r"^measure .*\n((?:\S.*\n)+)", ran.err, re.MULTILINE)
    assert rows is not None, ran.err
    found = {}
    for line in rows[1].splitlines():
        name, value, *note = re.split(r"\s{2,}", line.strip())
        found[name] = (value, note[0] if note else "")
    return found


# Robots 0 and 1 start at 1 and 1.5 s, go for 1 s three times, and rest 4 s between.
@pytest.mark.parametrize(
    ("measure", "value", "note"),
    [
        ("uint32 = count(robot in Busy)", "2", ""),
        ("uint32 = count(all robot in Busy)", "0", ""),
        ("uint32 = count(some robot in Busy and robot[2] in Idle)", "1", ""),
        ("uint32 = max count(robot in Going)", "2", ""),
        ("uint32 = min count(robot in Idle)", "1", ""),
        ("float64 = mean count(robot in Busy)", "1.84848", ""),
        ("uint32 = total(robot sends Found)", "6", ""),
        ("uint32 = total(robot starts go)", "6", ""),
        ("uint32 = total(robot in Going)", "6", ""),
        ("uint32 = total(Start)", "2", ""),
        ("uint32 = total(robot in Idle)", "3", ""),
        ("duration = time(robot in Going)", "6 s", ""),
        ("duration = time(some robot in Going)", "3.5 s", ""),
        ("duration = time until some robot in Busy", "1 s", ""),
        ("duration = time until Start", "1 s", ""),
        ("duration = time until all robot in Busy", "40 s", "not reached"),
        ("duration = max each robot : time(in Going)", "3 s", ""),
        ("duration = mean each robot : time(in Going)", "2 s", ""),
        ("duration = min each robot : time until in Busy", "1 s", ""),
        ("duration = max each robot : time until in Busy", "40 s", "not reached"),
        ("uint32 = sum each robot : count(in Busy and has [tries > 2])", "2", ""),
        ("float64 = mean each robot : count(in Busy)", "0.666667", ""),
        ("uint32 = max each robot : total(sends Found)", "3", ""),
        ("uint32 = sum each robot : max count(in Going)", "2", ""),
    ],
)
def test_measures(simulate: Simulate, measure: str, value: str, note: str) -> None:
    ran = simulate(
        with_inputs(f"x : {measure}"), "--trace", "none", "--until", "40s", events=EVENTS
    )
    assert measured(ran)["x"] == (value, note), ran.err
    assert measured(ran)["Pace"] == ("1", "fitness, to maximize")
    assert ran.code == 0


def test_an_event_before_the_next_input_is_one_fact(simulate: Simulate) -> None:
    model = with_inputs("a : duration = time until Start", "b : uint32 = total(Start)")
    ran = simulate(model, "--trace", "none", events=EVENTS)
    assert (measured(ran)["a"][0], measured(ran)["b"][0]) == ("1 s", "2")


@pytest.mark.parametrize(
    ("goal", "said"),
    [
        ("minimize x / 1 s", ("6", "fitness, to minimize")),
        ("maximize late / 1 s", ("601.5", "fitness, to maximize: with late not reached")),
        ("maximize 1 / count", ("-", "fitness, to maximize: division by zero")),
        ("maximize other", ("-", "fitness, to maximize: `other` is not measured")),
        ("param w : float64\n  maximize w", ("-", "fitness, to maximize: param `w` has no value")),
        ("param w : duration = 2 s\n  maximize x / w", ("3", "fitness, to maximize")),
    ],
)
def test_fitness(simulate: Simulate, goal: str, said: tuple[str, str]) -> None:
    inputs = ["x : duration = time(robot in Going)", "count : uint32 = count(robot in Going)"]
    optional = {
        "other": "other : float64",
        "late": "late : duration = time until all robot in Busy",
    }
    inputs += [text for name, text in optional.items() if name in goal]
    ran = simulate(with_inputs(*inputs, goal=goal), "--trace", "none", events=EVENTS)
    assert measured(ran)["Pace"] == said
    assert ran.code == 0


def test_a_fitness_without_measures_is_not_shown(simulate: Simulate) -> None:
    ran = simulate(with_inputs("x : float64"), "--trace", "none")
    assert "measure" not in ran.err


def test_results_as_json_and_of_a_replayed_trace(
    simulate: Simulate, capsys: pytest.CaptureFixture[str]
) -> None:
    model = with_inputs(
        "spent : duration = time(robot in Going)",
        "late : duration = time until all robot in Busy",
        goal="maximize spent / 1 s",
    )
    model += "property Quiet of Crew : each robot : never sends Found\n"
    ran = simulate(model, "--trace-file", "trace.jsonl", "--results", "results.json", events=EVENTS)
    assert "written: trace.jsonl, results.json" in ran.err
    found = json.loads(Path("results.json").read_text(encoding="utf-8"))
    assert found["subject"] == "Crew"
    assert (found["seed"], found["scenario"]) == (0, None)
    assert found["properties"][0]["name"] == "Quiet"
    assert found["properties"][0]["violations"][0] == {"t": 2000.0, "member": "robot[0]"}
    spent, late = found["measures"]
    assert spent == {"name": "spent", "value": 6.0, "unit": "s"}
    assert late["reached"] is False
    assert found["fitness"] == {"name": "Pace", "goal": "maximize", "value": 6.0}

    arguments = ["--replay", "trace.jsonl", "--results", "again.json"]
    assert run(["simulate", "model.swarm", *arguments]) == 1
    assert "spent    6 s" in capsys.readouterr().err
    again = json.loads(Path("again.json").read_text(encoding="utf-8"))
    assert again["replayed"] == "trace.jsonl"
    assert again["fitness"] == found["fitness"]
    assert again["measures"][0] == spent


def test_values_of_a_trace_that_deviates_say_what_is_left_out(
    simulate: Simulate, capsys: pytest.CaptureFixture[str]
) -> None:
    simulate(
        with_inputs("x : uint32 = total(robot in Going)"),
        "--trace-file",
        "trace.jsonl",
        events=EVENTS,
    )
    path = Path("trace.jsonl")
    lines = path.read_text(encoding="utf-8").splitlines(keepends=True)
    first = next(at for at, each in enumerate(lines) if '"Start"' in each)
    lines[first] = lines[first].replace('"Busy.Going"', '"Idle"')
    path.write_text("".join(lines), encoding="utf-8")
    own = sum('"member": "robot[0]"' in each for each in lines[first:])
    capsys.readouterr()
    assert run(["simulate", "model.swarm", "--replay", "trace.jsonl", "--results", "r.json"]) == 1
    assert f"left out of the following: {own} lines" in capsys.readouterr().err
    found = json.loads(Path("r.json").read_text(encoding="utf-8"))
    assert (found["lines"], found["left_out"]) == (len(lines) - own, own)
    assert found["measures"][0]["value"] == 3  # of robot[1] alone


def test_results_that_cannot_be_written_are_reported(simulate: Simulate) -> None:
    ran = simulate(with_inputs("x : float64"), "--results", "nowhere/results.json")
    assert ran.code == 1
    assert "cannot write" in ran.err


def test_the_script_of_the_fitness_computes_the_same(simulate: Simulate) -> None:
    model = with_inputs(
        "spent : duration = time(robot in Going)",
        "sent : uint32 = total(robot sends Found)",
        goal="param most : duration = 4 s\n  maximize sent * (spent / most) + spent / 2 s",
    )
    simulate(model, "--trace", "none", "--results", "results.json", events=EVENTS)
    found = json.loads(Path("results.json").read_text(encoding="utf-8"))
    assert run(["build", "model.swarm", "--target", "fitness", "-o", "out"]) == 0
    (path,) = Path("out").rglob("fitness.py")
    script = runpy.run_path(str(path))
    values = {each["name"]: each["value"] for each in found["measures"]}
    expected = found["fitness"]["value"]
    assert script["fitness"]({**script["PARAMS"], **values}) == pytest.approx(expected)
