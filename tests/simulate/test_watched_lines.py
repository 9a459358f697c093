"""Monitors that follow only what changes say the same as those that follow every line."""

from __future__ import annotations

import random
from collections import Counter
from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path

import pytest

from swarmdsl.base.diagnostics.collector import Diagnostics
from swarmdsl.base.source import Source
from swarmdsl.driver import pipeline
from swarmdsl.driver.config.toml import parse_toml
from swarmdsl.execution.monitor import automaton, joint, plan, progress, watch
from swarmdsl.execution.simulate.evaluation import properties
from swarmdsl.execution.simulate.evaluation.reporter import observe
from swarmdsl.execution.simulate.inputs.events import Input
from swarmdsl.execution.simulate.inputs.scenario_file import read_scenario
from swarmdsl.execution.simulate.machines.actors import actors
from swarmdsl.execution.simulate.machines.subject import Subject
from swarmdsl.execution.simulate.world.line import as_text
from swarmdsl.execution.simulate.world.runner import run
from swarmdsl.execution.simulate.world.world import World

EXAMPLES = Path(__file__).resolve().parents[2] / "examples"


def verdicts(example: str, events: list[str], seed: int, *, reported: bool = False) -> list[object]:
    """Return the verdicts on a run with some events, and the violations with their lines."""
    return verdicts_on(EXAMPLES / example, events, seed, "", reported=reported)


def verdicts_on(
    path: Path, events: list[str], seed: int, said: str, *, reported: bool
) -> list[object]:
    system = pipeline.check([path]).system
    assert system is not None
    swarm = system.swarms[0]
    subject = Subject(swarm.name, system, swarm=swarm)
    report = Diagnostics()
    document = parse_toml(Source("scenario", said), report)
    assert document is not None
    scenario = read_scenario(document, subject, report)
    assert not [each.message for each in report]
    scenario = replace(scenario, counts={role.name: 3 for role in swarm.roles})
    cast = actors(subject, subject.create_robots(scenario.counts), scenario, Diagnostics())
    listeners: list[object] = []
    world = World(system, cast, scenario, seed, listeners)  # type: ignore[arg-type]
    planned = properties.plan(properties.watchable(subject))
    monitors = properties.watch(planned, world.data)
    if reported:
        observe(world.trace, monitors, world.clock)
    else:
        listeners.append(monitors.see)
    run(world, [Input(event, 7 * 10**9, None, tuple(cast)) for event in events], 10**9 * 120)
    results = monitors.results(world.clock.now, ended=False)
    told = sorted(
        (each.property.name, str(each.robot), each.time, [as_text(line) for line in each.last])
        for each in monitors.violations
    )
    return [*((each.property.name, each.verdict, each.robots) for each in results), *told]


RUNS = pytest.mark.parametrize(
    ("example", "events"),
    [
        ("search_and_rescue", ["MissionStart", "TargetFound", "MissionAbort", "MissionStart"]),
        ("emergency_exit", ["SawExit", "Alarm", "Alarm", "SawExit"]),
        ("storage", ["ShiftStart", "BoxFound", "ShiftEnd"]),
        ("flocking", ["Start", "Scatter", "Danger", "Assemble", "Stop"]),
    ],
)


@RUNS
def test_lines_of_what_matters_alone(example: str, events: list[str]) -> None:
    for seed in range(3):
        found = verdicts(example, events, seed, reported=True)
        assert found == verdicts(example, events, seed)
        assert found


MODEL = """package crew
swarm event Start : std_msgs/Empty
swarm event Home : std_msgs/Empty
function carry : abstraction { service "carry" : std_srvs/Trigger }
statemachine Carrying {
  var box : uint8 = 0
  initial Waiting
  state Waiting {
    defer Home
    on Start -> Work
    after 20 s -> Waiting
  }
  state Work {
    initial Fetch
    on Home [box < 4] / box = box + 1
    on Home -> Waiting
    state Fetch {
      do carry
      on succeeded / box = box + 1, send Home -> Rest
      on aborted / send Start to "robot[1]" after 2 s -> Rest
    }
    state Rest {
      after 3 s -> Fetch
      [box > 8] -> Over
    }
  }
  final Over
}
member Carrier { behavior Carrying }
swarm Crew { robot : Carrier[3] }
"""
SCENARIO = """
[functions.carry]
duration = { uniform = ["1 s", "4 s"] }
aborted = 0.3
[network]
latency = LATENCY
[[faults]]
lost = "robot[2]"
at = "25 s"
lasts = "20 s"
[[faults]]
lost = "robot[0]"
at = "30 s"
lasts = "5 s"
"""
FACTS = ("in Work", "in Rest", "in Over", "in Waiting", "has [box > 3]", "sends Home")
FACTS += ("hears Home", "hears Start", "starts carry", "cancels carry", "sends Start")
FACTS += ("ends carry", "ends carry as succeeded", "ends carry as aborted")


EVENTS = ["Start", "Home"] * 5


def random_sentence(dice: random.Random, facts: Sequence[str]) -> str:
    each = dice.random() < 0.5
    robots = ["", "", "some other robot "] if each else []
    robots += ["all robot ", "some robot ", "no robot ", "2..* robot ", "robot[1] "]

    def fact() -> str:
        found = dice.choice(robots) + dice.choice(facts)
        found = dice.choice((found, found, "count(robot in Work) > 1", "Start"))
        return f"not {found}" if dice.random() < 0.3 else found

    one, other, time = fact(), fact(), f"within {dice.randrange(1, 9)} s"
    if dice.random() < 0.3:
        one = f"({one} {dice.choice(('and', 'or'))} {fact()})"
    patterns = (f"never {one}", f"{one} at all times", f"{one} {time}", f"{one} only after {other}")
    patterns += (f"{one} leads to {other} {time}", f"{one} at most 2 times", f"{one} then {other}")
    patterns += (f"again and again {one}", f"always possible {one}", f"{one} leads to {other}")
    scopes = ("", "", f"after {fact()}, ", f"before {fact()}, ")
    scopes += (f"after {fact()} until {fact()}, ", f"between {fact()} and {fact()}, ")
    return f"{'each robot : ' * each}{dice.choice(scopes)}{dice.choice(patterns)}"


@pytest.mark.parametrize("latency", ['{ uniform = ["10 ms", "2 s"] }', '"5 ms"'])
def test_random_properties_in_lines_of_what_matters(latency: str, tmp_path: Path) -> None:
    """With few properties at a time, most lines do not matter."""
    dice = random.Random(3)
    file = tmp_path / "crew.swarm"
    scenario = SCENARIO.replace("LATENCY", latency)
    kinds: Counter[object] = Counter()
    for seed in range(80):
        facts = dice.sample(FACTS, 3)
        sentences = (f"property P{n} of Crew : {random_sentence(dice, facts)}\n" for n in range(2))
        file.write_text(MODEL + "".join(sentences), encoding="utf-8")
        found = verdicts_on(file, EVENTS, seed, scenario, reported=True)
        assert found == verdicts_on(file, EVENTS, seed, scenario, reported=False)
        kinds.update(each[1] for each in found if len(each) == 3)  # type: ignore[arg-type, index]
    assert min(kinds["true"], kinds["false"], kinds["open"]) > 10


@RUNS
def test_only_what_changes(
    example: str, events: list[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    found = [verdicts(example, events, seed) for seed in range(3)]

    def all_of_them(planned: plan.Plan, _facts: int) -> object:
        return planned.swarm_rules, range(len(planned.gauges))

    look = watch.Watch._look_what_matters

    def at_all(monitors: watch.Watch) -> None:
        look(monitors)
        monitors._common = -1

    monkeypatch.setattr(plan.Plan, "about", all_of_them)
    monkeypatch.setattr(watch.Watch, "_look_what_matters", at_all)
    monkeypatch.setattr(joint.Joint, "_about", lambda found, _facts: found.numbers)
    monkeypatch.setattr(progress.Progress, "affected", lambda each, *_changed: each.robots.values())
    monkeypatch.setattr(automaton.Automaton, "is_final", lambda _self, _state: False)
    assert found == [verdicts(example, events, seed) for seed in range(3)]
    assert all(found)
