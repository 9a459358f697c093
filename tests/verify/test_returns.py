"""Proofs about swarms whose robots come back, or lose sight of others, under a scenario."""

from __future__ import annotations

from collections import Counter
from collections.abc import Sequence
from pathlib import Path
from random import Random

import pytest

from swarmdsl.base.diagnostics.collector import Diagnostics
from swarmdsl.cli import run
from swarmdsl.execution.engine import LoopError
from swarmdsl.execution.monitor import FALSE
from swarmdsl.execution.simulate.evaluation.properties import plan, watch, watchable
from swarmdsl.execution.simulate.machines.actors import actors
from swarmdsl.execution.simulate.machines.subject import Subject
from swarmdsl.execution.simulate.scenario.durations import SECOND, Fixed, Uniform
from swarmdsl.execution.simulate.scenario.scenario import EVERY_FUNCTION, Fault, Message, Scenario
from swarmdsl.execution.simulate.world.line import Line
from swarmdsl.execution.simulate.world.runner import run as simulate
from swarmdsl.execution.simulate.world.world import World
from swarmdsl.execution.verify.automata.limits import Budget, Limits
from swarmdsl.execution.verify.proofs.prove import prove
from swarmdsl.execution.verify.proofs.verdict import Verdict
from swarmdsl.execution.verify.replay.play import play
from swarmdsl.execution.verify.robot.environment import Options
from swarmdsl.execution.verify.search.run import written
from swarmdsl.execution.verify.swarm.model import Model

from .conftest import at_least, model_of, system_of, verdicts_of
from .random_swarms import random_swarm

_RUNS = 20
"""Number of simulations of a random swarm."""
_LENGTH = 60 * SECOND
FEW = (0, 2, 3, 5, 8, 15, 19, 20, 22, 26, 32, 33, 83)

_PAIR = """package pair
event Go : std_msgs/Empty
swarm event Ask : std_msgs/Empty
endless statemachine M {
  var n : int32 = 0
  initial Calm
  state Calm {
    on Go / n = min(n + 1, 2), send Ask -> Busy
    on member_lost -> Alone
  }
  state Busy {
    on Ask -> Calm
    on member_lost -> Alone
  }
  state Alone {
    on member_joined -> Calm
  }
}
member A { behavior M }
swarm S {
  a : A[2]
  heartbeat 1 s lost after 5 s
}
"""


_DEAF = "".join(line for line in _PAIR.splitlines(True) if "member_" not in line)


def verdicts(path: Path, scenario: Scenario, *properties: str, text: str = _PAIR) -> list[Verdict]:
    """Return the verdicts on properties of two robots under a scenario."""
    named = (f"property P{n} of S : {text}\n" for n, text in enumerate(properties))
    path.write_text(text + "".join(named), encoding="utf-8")
    return list(verdicts_of(model_of(path, None, Options(scenario=scenario))).values())


def away(lasts: int | None, *robots: str) -> Scenario:
    fault = Fault(Fixed(5 * SECOND), robots or None, lasts=lasts)
    return Scenario(faults=(fault,), messages=(Message("Go", Fixed(0), every=SECOND),))


def test_a_robot_that_comes_back_starts_anew(tmp_path: Path) -> None:
    asked = (
        "each a : after in Busy, never has [n == 0]",
        "never no a in Calm and no a in Busy",
    )
    scenario = away(2 * SECOND, "a[0]")
    found = verdicts(tmp_path / "pair.swarm", scenario, *asked, text=_DEAF)

    assert [each.outcome for each in found] == ["fails", "holds"]
    assert found[0].robot == "a[0]"
    assert found[0].run is not None
    lines = found[0].run.lines
    lost = next(n for n, line in enumerate(lines) if line.event == "fault.lost")
    (back,) = (line for line in lines[lost:] if line.event is None)
    assert back.actor is lines[lost].actor
    assert back.time - lines[lost].time == 2 * SECOND


def test_what_can_still_happen_is_no_violation(tmp_path: Path) -> None:
    """A run that only is violated if nothing follows shows nothing where anything can follow."""
    path = tmp_path / "pair.swarm"
    path.write_text(f"{_DEAF}property P of S : eventually some a in Busy\n", encoding="utf-8")
    model = model_of(path)
    network = model.network(model.groups(model.properties))
    (property_,) = model.properties

    assert not play(network, [], property_).flaw
    assert "does not see a violation" in play(network, [], property_, ended=False).flaw


def test_a_robot_is_lost_as_often_as_the_scenario_has_it(tmp_path: Path) -> None:
    once, twice = away(2 * SECOND, "a[0]"), away(2 * SECOND, "a[0]")
    twice = Scenario(faults=twice.faults * 2, messages=twice.messages)
    asked = "a[0] in Calm at most 2 times"

    # Nothing comes from outside, and nobody listens to heartbeats.
    for scenario, outcome in ((once, "holds"), (twice, "fails")):
        quiet = Scenario(faults=scenario.faults)
        (verdict,) = verdicts(tmp_path / "pair.swarm", quiet, asked, text=_DEAF)
        assert verdict.outcome == outcome


def test_who_loses_sight_of_others_may_take_them_for_lost(tmp_path: Path) -> None:
    apart = Fault(Fixed(5 * SECOND), lasts=9 * SECOND, apart=(("a[0]",), ("a[1]",)))
    scenario = Scenario(faults=(apart,), messages=(Message("Go", Fixed(0), every=SECOND),))
    asked = (
        "never some a in Alone",
        "each a : in Alone only after hears member_lost",
        "never some a in Busy",
    )
    found = verdicts(tmp_path / "pair.swarm", scenario, *asked)

    # Whether they do depends on times that are not looked at; a run without it is one.
    assert [each.outcome for each in found] == ["unknown", "holds", "fails"]
    assert "robots take each other for lost in it" in found[0].reason


def scenario_of(chance: Random, robots: Sequence[str]) -> Scenario:
    """Return a random scenario in which robots are lost for a time, or lose sight of each other."""
    faults = []
    for _ in range(chance.randint(1, 2)):
        at, lasts = Uniform(0, 20 * SECOND), chance.choice((2, 4, 12)) * SECOND
        if chance.random() < 0.6:
            faults.append(Fault(at, (chance.choice(robots),), lasts=lasts))
        else:
            length = chance.choice((None, lasts))
            faults.append(Fault(at, lasts=length, apart=((robots[0],), (robots[1],))))
    often = [Message(each, Uniform(0, 5 * SECOND), every=3 * SECOND) for each in ("Go", "Tick")]
    return Scenario(
        functions={(EVERY_FUNCTION, ""): {"duration": Uniform(0, 9 * SECOND), "aborted": 0.3}},
        messages=tuple(often if chance.random() < 0.7 else often[:1]),
        faults=tuple(faults),
        latency=chance.choice((Fixed(0), Uniform(0, SECOND))),
        loss=chance.choice((0.0, 0.0, 0.3, 1.0)),
    )


def violated(subject: Subject, scenario: Scenario, seed: int) -> set[str]:
    """Return the properties that a simulation violates."""
    assert subject.system is not None
    cast = actors(subject, subject.create_robots({}), scenario, Diagnostics())

    def see(line: Line) -> None:
        watched.see(line)

    world = World(subject.system, cast, scenario, seed, [see], subject.heartbeat)
    watched = watch(plan(list(watchable(subject))), world.data)
    try:
        ending = simulate(world, [], _LENGTH)
    except LoopError:
        return set()
    results = watched.results(world.clock.now, ended=ending == "ended")
    return {each.property.name for each in results if each.verdict == FALSE}


def compared(seed: int, path: Path, capsys: pytest.CaptureFixture[str]) -> Counter[str]:
    """Hold the verdicts on a random swarm against simulations; replay runs that violate one."""
    chance = Random(seed)
    text = random_swarm(seed, heartbeat=seed % 3 > 0)
    if chance.random() < 0.5:
        text = text.replace("on member_lost", "on member_joined", 1)
    path.write_text(text, encoding="utf-8")
    system = system_of(path)
    subject = Subject("S", system, system.swarms[0])
    robots = [robot.name or "" for robot in subject.create_robots({})]
    scenario = scenario_of(chance, robots)
    options = Options(3, scenario=scenario)
    model = Model(
        subject, {}, watchable(subject), options, Budget(Limits(states=4000)), Diagnostics()
    )
    real = set[str]().union(*(violated(subject, scenario, n) for n in range(_RUNS)))
    found: Counter[str] = Counter()
    for property_ in watchable(subject):
        verdict = prove(property_, model, Budget(Limits(states=4000)))
        found[verdict.outcome] += 1
        if not verdict.full:
            assert verdict.outcome != "holds" or property_.name not in real, (seed, verdict)
        if verdict.run is not None:
            found["back"] += any(line.event is None and line.time > 0 for line in verdict.run.lines)
            trace = path.with_suffix(".jsonl")
            trace.write_text("".join(f"{line}\n" for line in written(verdict.run)))
            run(["simulate", str(path), "--replay", str(trace), "--property", property_.name])
            told = capsys.readouterr().err
            assert "as in the model" in told, (seed, verdict, told)
            assert "left out" not in told, (seed, verdict, told)
            assert f"property `{property_.name}` is violated" in told, (seed, verdict)
    return found


@pytest.mark.timeout(3000)
def test_verdicts_are_those_of_all_simulations_with_returns(
    seeds: Sequence[int], tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    found: Counter[str] = Counter()
    for seed in seeds:
        found += compared(seed, tmp_path / "random.swarm", capsys)

    assert min(found["holds"], found["fails"]) >= at_least(12, seeds), found
    assert found["back"], found
