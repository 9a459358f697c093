"""Verdicts on a replayed trace are those of the simulation that has written it."""

from __future__ import annotations

import random
from collections import Counter
from collections.abc import Callable, Sequence
from dataclasses import replace
from pathlib import Path

import pytest

from swarmdsl.base.diagnostics.collector import Diagnostics
from swarmdsl.base.source import Source
from swarmdsl.cli import run as cli_run
from swarmdsl.driver import pipeline
from swarmdsl.driver.config.toml import parse_toml
from swarmdsl.execution.monitor import PropertyResult
from swarmdsl.execution.simulate.evaluation.properties import plan, watch, watchable
from swarmdsl.execution.simulate.evaluation.verdicts import Recording
from swarmdsl.execution.simulate.inputs.events import Input
from swarmdsl.execution.simulate.inputs.scenario_file import read_scenario
from swarmdsl.execution.simulate.machines.actors import actors
from swarmdsl.execution.simulate.machines.subject import Subject
from swarmdsl.execution.simulate.replay.replay import replay
from swarmdsl.execution.simulate.world.line import Line, as_json
from swarmdsl.execution.simulate.world.runner import run
from swarmdsl.execution.simulate.world.world import World

from .conftest import Ran, Simulate
from .test_properties import verdicts
from .test_watched_lines import EVENTS, FACTS, MODEL, SCENARIO, random_sentence

ENDING = """
message Place { x : float64 }
statemachine Walk {
  var place : Place
  var heard : int32 = 0
  initial First
  state First {
    defer Found
    on Start -> Second
  }
  state Second {
    on Found / heard = 1 -> Third
    after 5 s -> Third
  }
  state Third { after 5 s / place.x = 2.0 -> Over }
  final Over
}
member Robot { behavior Walk }
swarm Crew { robot : Robot[2] }
"""
START = {"event": "Start", "after": 1000}
FOUND = {"event": "Found", "data": {"id": "a", "level": 1}, "member": "robot[0]", "after": 100}


Judge = Callable[..., str]


@pytest.fixture
def judge(capsys: pytest.CaptureFixture[str]) -> Judge:
    """Return the verdict on a trace of the last model."""

    def judge(text: str, *options: str) -> str:
        Path("run.jsonl").write_text(text, encoding="utf-8")
        code = cli_run(["simulate", "model.swarm", "--replay", "run.jsonl", *options])
        return verdicts(Ran(code, "", capsys.readouterr().err))["P"][0]

    return judge


@pytest.mark.parametrize(
    ("sentence", "verdict"),
    [
        # All have ended: what has not happened never does.
        ("each robot : in First leads to has [heard > 1]", "false"),
        ("eventually count(robot in Second) > 2", "false"),
        ("always possible some robot in First", "false"),
        ("each robot : in First leads to in Over", "true"),
        # Values are those after each line, though some lines belong together.
        ("each robot : never has [place.x > 1.0] and not in Over", "true"),
        ("each robot : never has [heard > 0] and in Second", "true"),
        ("each robot : never has [heard > 0] and in Third", "false"),
    ],
)
def test_what_has_ended_and_what_values_were(
    sentence: str, verdict: str, simulate: Simulate, judge: Judge
) -> None:
    model = f"{ENDING}\nproperty P of Crew : {sentence}\n"
    ran = simulate(model, events=[FOUND, START])

    assert (verdicts(ran)["P"][0], judge(ran.out)) == (verdict, verdict)


def test_a_trace_that_goes_on_is_open(simulate: Simulate, judge: Judge) -> None:
    model = f"{ENDING}\nproperty P of Crew : eventually some robot has [heard > 0]\n"
    lines = simulate(model, events=[START]).out.splitlines()
    own = [line for line in lines if '"robot[0]"' in line]

    assert judge("\n".join(lines)) == "false"
    assert judge("\n".join(lines[:-1])) == judge("\n".join(own)) == "open"


def test_a_lost_robot_may_come_back(simulate: Simulate, judge: Judge) -> None:
    model = f"{ENDING}\nproperty P of Crew : eventually count(robot in Second) > 2\n"
    lost = '[[faults]]\nat = "3 s"\nlost = "robot[1]"\n'
    ran = simulate(model, events=[START], scenario=lost)

    assert (verdicts(ran)["P"][0], judge(ran.out)) == ("false", "open")


def test_a_robot_that_has_ended_may_be_lost_and_start_anew(
    simulate: Simulate, judge: Judge
) -> None:
    model = f"{ENDING}\nproperty P of Crew : each robot : after in Over, never in First\n"
    lost = '[[faults]]\nat = "20 s"\nlost = "robot[1]"\nlasts = "5 s"\n'
    ran = simulate(model, events=[{**START, "member": "robot[1]"}], scenario=lost)

    # No machine of it was running: its loss has no line.
    assert "fault.lost" not in ran.out
    assert (verdicts(ran)["P"][0], judge(ran.out)) == ("false", "false")


@pytest.mark.parametrize(("until", "verdict"), [("24 s", "open"), ("60 s", "false")])
def test_a_trace_that_is_cut_while_a_robot_that_has_ended_is_lost(
    until: str, verdict: str, simulate: Simulate, judge: Judge
) -> None:
    model = f"{ENDING}\nproperty P of Crew : eventually count(robot in Over) > 2\n"
    lost = '[[faults]]\nat = "20 s"\nlost = "robot[1]"\nlasts = "5 s"\n'
    # The other robot ends at 21 s: all have ended then, and one of them is to start again.
    events = [
        {**START, "member": "robot[1]"},
        {**START, "member": "robot[0]", "after": 11_000},
        {**START, "member": "robot[1]", "after": 26_000},
    ]
    ran = simulate(model, "--until", until, events=events, scenario=lost)
    replayed = judge(ran.out, "--scenario", "scenario.toml")

    assert "fault.lost" not in ran.out
    assert (verdicts(ran)["P"][0], replayed) == (verdict, verdict)


def both(path: Path, seed: int, said: str) -> list[list[PropertyResult]]:
    """Return the verdicts on a run, and those on its trace."""
    system = pipeline.check([path]).system
    assert system is not None
    subject = Subject("Crew", system, swarm=system.swarms[0])
    report = Diagnostics()
    document = parse_toml(Source("scenario", said), report)
    assert document is not None
    scenario = replace(read_scenario(document, subject, report), counts={"robot": 3})
    robots = subject.create_robots(scenario.counts)
    cast, again = (actors(subject, robots, scenario, report) for _ in range(2))
    lines: list[str] = []
    listeners: list[Callable[[Line], object]] = [lambda line: lines.append(as_json(line))]
    world = World(system, cast, scenario, seed, listeners)  # type: ignore[arg-type]
    properties = watchable(subject)
    monitors = watch(plan(properties), world.data)
    listeners.append(monitors.see)
    inputs = [Input(event, 7 * 10**9, None, tuple(cast)) for event in EVENTS]
    ending = run(world, inputs, 10**9 * 400)
    simulated = monitors.results(world.clock.now, ended=ending == "ended")
    recording = Recording(properties, None)
    found = replay(Source("trace", "\n".join(lines)), subject, again, report, recording.see)
    assert not [each.message for each in report]
    return [simulated, recording.results(found.end, found.repeated)[0]]


def shown(results: Sequence[PropertyResult]) -> list[object]:
    return [(each.property.name, each.verdict, each.robots, each.remark) for each in results]


def test_random_runs(tmp_path: Path) -> None:
    """Times are left out: those of a trace are whole milliseconds."""
    dice = random.Random(5)
    file = tmp_path / "crew.swarm"
    scenario = SCENARIO.replace("LATENCY", '{ uniform = ["10 ms", "2 s"] }')
    kinds: Counter[str] = Counter()
    for seed in range(40):
        found: list[str] = []
        while len(found) < 6:
            sentence = random_sentence(dice, FACTS)
            if "within" not in sentence:
                found.append(f"property P{len(found)} of Crew : {sentence}\n")
        file.write_text(MODEL + "".join(found), encoding="utf-8")
        calm = scenario.partition("[[faults]]")[0]
        simulated, replayed = both(file, seed, calm if seed % 2 else scenario)
        assert shown(replayed) == shown(simulated), (seed, found)
        kinds.update(each.verdict for each in simulated)
    assert min(kinds["true"], kinds["false"], kinds["open"]) > 10
