"""Measure the simulator and comparable simulators with the same swarms."""

from __future__ import annotations

import gc
from collections.abc import Callable
from dataclasses import dataclass
from functools import partial
from pathlib import Path
from statistics import median
from time import process_time

import peers
from measure import Section, interleaved, spread
from peers import mesa_model, simpy_model
from swarmdsl.base.diagnostics.collector import Diagnostics
from swarmdsl.driver import pipeline
from swarmdsl.execution.monitor import Plan
from swarmdsl.execution.simulate.evaluation.properties import plan, watch, watchable
from swarmdsl.execution.simulate.evaluation.reporter import observe
from swarmdsl.execution.simulate.machines.actors import actors
from swarmdsl.execution.simulate.machines.subject import Subject, choose
from swarmdsl.execution.simulate.run.prepare import Prepared, Request, prepare
from swarmdsl.execution.simulate.scenario.durations import SECOND
from swarmdsl.execution.simulate.scenario.scenario import Scenario
from swarmdsl.execution.simulate.world.line import as_json
from swarmdsl.execution.simulate.world.runner import run
from swarmdsl.execution.simulate.world.world import World

ROUNDS = 3
GOAL = 400_000
"""Least number of deliveries a second."""
MOST_FOR_PROPERTIES = 20
"""Greatest share of the time, in percent, that ten properties may add to that of a run."""

TALK = """package talk
swarm event Hello : std_msgs/Empty
endless statemachine Listening {{
  var heard : int32 = 0
  initial Here
  state Here {{ on Hello / heard = heard + 1 }}
}}
endless statemachine Talking {{
  var heard : int32 = 0
  initial Here
  state Here {{
    after 1 s / send Hello -> Here
    on Hello / heard = heard + 1
  }}
}}
member Talker {{ behavior Talking }}
member Listener {{ behavior Listening }}
swarm Crowd {{
  talker : Talker[{talkers}]
  listener : Listener[{listeners}]
}}
"""

PROPERTIES = """
property Stays of Crowd : each listener : in Here at all times
property Waits of Crowd : each talker : in Here at all times
property Silent of Crowd : no listener sends Hello at all times
property Some of Crowd : count(talker in Here) >= 1 at all times
property First of Crowd : each talker : sends Hello only after in Here
property Begins of Crowd : some talker sends Hello within 2 s
property Answers of Crowd : talker[0] sends Hello leads to talker[1] sends Hello within 1 s
property Together of Crowd : never some listener in Here and no talker in Here
property Again of Crowd : each talker : again and again in Here
property Possible of Crowd : always possible all listener in Here
"""
"""Ten properties, of all robots and of each one."""


@dataclass(frozen=True)
class Crowd:
    """Robots that all hear what some of them broadcast each second."""

    talkers: int
    listeners: int
    seconds: int

    @property
    def title(self) -> str:
        """Name in the table."""
        hear = f", {self.listeners:,} more listen" if self.listeners else ""
        return f"{self.talkers:,} talk{hear}: {self.deliveries:,} deliveries"

    @property
    def deliveries(self) -> int:
        """Number of events that reach a robot."""
        return self.seconds * self.talkers * (self.talkers + self.listeners - 1)


RESCUE = Path(__file__).resolve().parents[1] / "examples" / "search_and_rescue"
MISSIONS = 10
"""Number of missions of search_and_rescue, in which nearly each step changes a fact."""
WATCHED = (Crowd(10, 990, 100), Crowd(100, 900, 10))
CROWDS = (Crowd(300, 0, 10), Crowd(10, 990, 100), Crowd(10, 9_990, 10))
"""The last two have as many deliveries: the time must not grow with the robots."""


def load(folder: Path, crowd: Crowd, properties: str = "") -> Subject:
    """Return the swarm of a crowd, with properties."""
    file = folder / "talk.swarm"
    counts = {"talkers": crowd.talkers, "listeners": crowd.listeners}
    text = TALK.format(**counts) + properties
    if not crowd.listeners:
        text = text.replace("  listener : Listener[0]\n", "")
    file.write_text(text, encoding="utf-8")
    report = Diagnostics()
    system = pipeline.check([file]).system
    found = choose(system, [], None, None, report)
    assert found is not None, [each.message for each in report]
    return found


def deliveries(subject: Subject, crowd: Crowd, *, trace: bool = False) -> float:
    """Return deliveries per second of CPU time of a run, with a trace or without one."""
    scenario = Scenario()
    robots = subject.create_robots({})
    cast = actors(subject, robots, scenario, Diagnostics())
    lines: list[str] = []
    listeners = [lambda line: lines.append(as_json(line))] if trace else []
    world = World(subject.system, cast, scenario, 0, listeners)
    gc.collect()
    start = process_time()
    properties = watchable(subject)
    monitors = watch(plan(properties), world.data)
    if properties:
        observe(world.trace, monitors, world.clock)
    run(world, [], crowd.seconds * SECOND)
    results = monitors.results(world.clock.now, ended=False)
    spent = process_time() - start
    assert all(each.verdict != "false" for each in results)
    assert world.network.delivered["Hello"] == crowd.deliveries
    return crowd.deliveries / spent


def deliveries_of(model: Callable[[int, int, int], int], crowd: Crowd) -> float:
    """Return deliveries per second of CPU time of another simulator."""
    gc.collect()
    start = process_time()
    heard = model(crowd.talkers, crowd.listeners, crowd.seconds)
    spent = process_time() - start
    assert heard == crowd.deliveries
    return crowd.deliveries / spent


def missions(prepared: Prepared, planned: Plan | None) -> float:
    """Return missions per second of CPU time, with the properties that are watched."""
    spent = 0.0
    assert prepared.scenario.until is not None
    for seed in range(MISSIONS):
        cast, inputs = prepared.stage(Diagnostics())
        world = World(prepared.subject.system, cast, prepared.scenario, seed, [])
        gc.collect()
        start = process_time()
        monitors = watch(planned, world.data) if planned is not None else None
        if monitors is not None:
            observe(world.trace, monitors, world.clock)
        run(world, inputs, MISSIONS * prepared.scenario.until)
        if monitors is not None:
            monitors.results(world.clock.now, ended=False)
        spent += process_time() - start
    return MISSIONS**2 / spent


@dataclass(frozen=True)
class Simulator:
    """Simulator with its deliveries per second; `peer` is the package that it needs."""

    name: str
    speed: Callable[[Subject, Crowd], float]
    peer: str | None = None


SIMULATORS = (
    Simulator("swarmdsl", deliveries),
    Simulator("swarmdsl, JSON trace", partial(deliveries, trace=True)),
    Simulator("SimPy", lambda _, crowd: deliveries_of(simpy_model.heard, crowd), "simpy"),
    Simulator("Mesa", lambda _, crowd: deliveries_of(mesa_model.heard, crowd), "mesa"),
)


def section(folder: Path) -> Section:
    """Run each crowd in each simulator."""
    present, absent = peers.divide(SIMULATORS)
    found = Section(
        "Thousands of deliveries a second of CPU time (minimum / median / maximum of "
        f"{ROUNDS} rounds). Robots broadcast an event each second, and every other robot counts "
        "it. In swarmdsl a delivery is a macrostep of a state machine, with statistics and "
        "coverage. In SimPy a robot is a process that takes events from its store; in Mesa it is "
        "an agent whose method is called at each step, with neither queue nor state machine.",
        ["swarm", *(peers.title(each.name, each.peer) for each in present)],
    )
    for crowd in CROWDS:
        subject = load(folder, crowd)
        speeds = interleaved(
            {each.name: partial(each.speed, subject, crowd) for each in present}, ROUNDS
        )
        found.rows.append(
            [crowd.title, *(spread(values, "{:.0f}", 1e-3) for values in speeds.values())]
        )
        found.goal(
            f"deliveries a second, {crowd.title}",
            median(speeds["swarmdsl"]),
            GOAL,
            "{:,.0f}",
            least=True,
        )
    _watched(folder, found)
    found.notes += absent
    return found


def _watched(folder: Path, found: Section) -> None:
    """Compare runs with properties and without any.

    Most deliveries change no fact in the crowds, and nearly all steps do in the missions.
    """
    for crowd in WATCHED:
        alone, watched = load(folder, crowd), load(folder, crowd, PROPERTIES)
        _overhead(
            f"ten properties, {crowd.title}",
            partial(deliveries, alone, crowd),
            partial(deliveries, watched, crowd),
            found,
        )
    request = Request((RESCUE,), scenario=RESCUE / "mission.toml")
    prepared = prepare(request, Diagnostics())
    assert prepared is not None
    properties = watchable(prepared.subject)
    _overhead(
        f"{len(properties)} properties, {MISSIONS} times {MISSIONS} missions of search_and_rescue",
        partial(missions, prepared, None),
        partial(missions, prepared, plan(properties)),
        found,
    )


def _overhead(
    title: str, alone: Callable[[], float], watched: Callable[[], float], found: Section
) -> None:
    """Compare the speeds of runs that are watched and of those that are not, which take turns."""
    speeds = interleaved({"alone": alone, "watched": watched}, ROUNDS)
    pairs = zip(speeds["alone"], speeds["watched"], strict=True)
    found.goal(
        f"percent more time with {title}",
        median(100 * (one / other - 1) for one, other in pairs),
        MOST_FOR_PROPERTIES,
        "{:.0f}",
    )
