"""Monitors that follow only what changes say the same as those that follow every line."""

from __future__ import annotations

from pathlib import Path

import pytest

from swarmdsl.base.diagnostics.collector import Diagnostics
from swarmdsl.driver import pipeline
from swarmdsl.execution.monitor import facts
from swarmdsl.execution.monitor import watch as monitors
from swarmdsl.execution.simulate import properties
from swarmdsl.execution.simulate.actors import actors
from swarmdsl.execution.simulate.inputs import Input
from swarmdsl.execution.simulate.run import run
from swarmdsl.execution.simulate.scenario import Scenario
from swarmdsl.execution.simulate.subject import Subject
from swarmdsl.execution.simulate.trace import Line
from swarmdsl.execution.simulate.world import World

EXAMPLES = Path(__file__).resolve().parents[2] / "examples"


def verdicts(example: str, events: list[str], seed: int) -> list[object]:
    """Return the verdicts on a run with some events, and the violations."""
    system = pipeline.check([EXAMPLES / example]).system
    assert system is not None
    swarm = system.swarms[0]
    subject = Subject(swarm.name, system, swarm=swarm)
    scenario = Scenario(counts={role.name: 3 for role in swarm.roles})
    cast = actors(subject, subject.create_robots(scenario.counts), scenario, Diagnostics())
    listeners: list[object] = []
    world = World(system, cast, scenario, seed, listeners)  # type: ignore[arg-type]
    watch = properties.watch(properties.watchable(subject), world.data)
    listeners.append(watch.see)
    run(world, [Input(event, 7 * 10**9, None, tuple(cast)) for event in events], 10**9 * 120)
    results = watch.results(world.clock.now, ended=False)
    told = sorted((each.property.name, str(each.robot), each.time) for each in watch.violations)
    return [*((each.property.name, each.verdict, each.robots) for each in results), *told]


@pytest.mark.parametrize(
    ("example", "events"),
    [
        ("search_and_rescue", ["MissionStart", "TargetFound", "MissionAbort", "MissionStart"]),
        ("emergency_exit", ["SawExit", "Alarm", "Alarm", "SawExit"]),
        ("storage", ["ShiftStart", "BoxFound", "ShiftEnd"]),
        ("flocking", ["Start", "Scatter", "Danger", "Assemble", "Stop"]),
    ],
)
def test_only_what_changes(
    example: str, events: list[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    found = [verdicts(example, events, seed) for seed in range(3)]

    def all_trackers(route: facts.Route, line: Line) -> object:
        return route._all

    monkeypatch.setattr(facts.Route, "trackers_of", all_trackers)
    monkeypatch.setattr(monitors._Watched, "affected", lambda watched, changed: watched.robots)
    assert found == [verdicts(example, events, seed) for seed in range(3)]
    assert all(found)
