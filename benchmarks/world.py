"""Measure the flat world: robots a second, growth, memory, and ir-sim with the same robots."""

from __future__ import annotations

import gc
import tracemalloc
from collections.abc import Callable
from dataclasses import dataclass
from functools import partial
from pathlib import Path
from statistics import median
from time import process_time

import peers
from measure import Section, interleaved, spread
from peers import irsim_world
from swarmdsl.execution.simulate.scenario.scenario import Robot
from swarmdsl.execution.space.functions.catalog import CLASSES
from swarmdsl.execution.space.functions.running import Running
from swarmdsl.execution.space.layout import Battery, Body, Eye, Layout, Radio, Unit
from swarmdsl.execution.space.radio import Links
from swarmdsl.execution.space.shapes import Edge
from swarmdsl.execution.space.stage import Stage
from swarmdsl.ir import Targets
from swarmdsl.ir.function_models import MODELS

ROUNDS = 3
SECONDS = 60
SEEDS = 30
GOAL = 1_200_000
"""Least number of robots that move on a second, with 30 seeds and nothing but bodies."""
MOST_GROWTH = 2.0
"""Greatest share of the time a robot may take among 5,000 robots, relative to among 50."""
CROWDS = (
    *((8, 1, False), (8, SEEDS, False), (20, SEEDS, False), (50, SEEDS, False), (5000, 1, False)),
    *((8, SEEDS, True), (50, SEEDS, True), (5000, 1, True)),
)
"""Numbers of robots and of seeds, and if robots have batteries, sensors and radios."""
PEER_ROBOTS = 20


@dataclass(frozen=True)
class Simulator:
    """World with the CPU seconds that it takes; `peer` is the package that it needs."""

    name: str
    seconds: Callable[[Path], float]
    peer: str | None = None


def stage(robots: int, seeds: int, *, devices: bool) -> Stage:
    """Return robots, 100 m2 for each, with a wall and targets; or with bodies alone."""
    side = (100.0 * robots) ** 0.5
    body = Body(radius=0.15, speed=2.0)
    unit = partial(Unit, body=body)
    if devices:
        battery = Battery(1e7, moving=30.0, idling=1.0)
        eyes = (Eye("person", 5.0, rate=2.0),)
        unit = partial(unit, battery=battery, radio=Radio(15.0), eyes=eyes)
    units = tuple(
        unit(Robot(f"robot[{number}]", "robot", "Robot", number, robots))
        for number in range(robots)
    )
    wall = Edge(side / 2, 0.0, side / 2, side / 2, 0.0, float("inf"), True, 0)
    targets = (Targets("person", 10),) if devices else ()
    return Stage(Layout(units, (side, side), edges=(wall,), targets=targets), range(seeds))


def steps(on: Stage, seconds: int, model: str = "random_walk") -> float:
    """Let all robots do a function; return the CPU seconds, without those of the start."""
    running = Running(model, CLASSES[model], on)
    arguments = {each.name: each.default for each in MODELS[model].arguments}
    for row in range(on.rows):
        running.start(row, arguments)
    links, part = Links(on), on.rows_of(range(len(on.seeds)))
    gc.collect()
    start = process_time()
    for _ in range(round(seconds / on.dt)):
        on.ticks += 1
        running.step(part)
        on.move(part)
        links.moved()
        on.eyes.look(part)
        if links.is_needed:
            links.within()
    return process_time() - start


def per_second(robots: int, seeds: int, devices: bool) -> float:
    """Return how many robots move on a second of CPU time."""
    seconds = SECONDS if robots * seeds <= 1500 else 10
    on = stage(robots, seeds, devices=devices)
    return on.rows * seconds / on.dt / steps(on, seconds)


def memory(robots: int) -> float:
    """Return the greatest number of bytes that a robot takes, among many of them."""
    tracemalloc.start()
    steps(stage(robots, 1, devices=True), 1)
    _, peak = tracemalloc.get_traced_memory()
    tracemalloc.stop()
    return peak / robots


def alone(folder: Path) -> float:
    """Return the CPU seconds of 20 robots in a hall with a wall."""
    return steps(stage(PEER_ROBOTS, 1, devices=False), SECONDS)


def together(folder: Path) -> float:
    """Return the CPU seconds of a run when 30 seeds move on together."""
    return steps(stage(PEER_ROBOTS, SEEDS, devices=False), SECONDS) / SEEDS


SIMULATORS = (
    Simulator("swarmdsl", alone),
    Simulator("swarmdsl, one of 30 seeds", together),
    Simulator(
        "ir-sim",
        lambda folder: irsim_world.seconds(folder, PEER_ROBOTS, SECONDS * 10, 0.1),
        "ir-sim",
    ),
)


def section(folder: Path) -> Section:
    """Measure the speed of swarms of all sizes, and other simulators."""
    found = Section(
        "Robots that move on a second of CPU time, in millions (minimum / median / maximum of "
        f"{ROUNDS} rounds): each step is 100 ms, on 100 m2 a robot with a wall, on which robots "
        "walk about at random. With devices they also use energy, look twice a second for ten "
        "targets, and note who is in reach of their radio. With 30 seeds, the robots of all runs "
        "move on together.",
        ["robots", "seeds", "devices", "millions a second", "ms a step"],
    )
    speeds = interleaved(
        {str(crowd): partial(per_second, *crowd) for crowd in CROWDS},
        ROUNDS,
    )
    for robots, seeds, devices in CROWDS:
        values = speeds[str((robots, seeds, devices))]
        milliseconds = [1e3 * robots * seeds / value for value in values]
        found.rows.append(
            [
                f"{robots:,}",
                str(seeds),
                "yes" if devices else "no",
                spread(values, "{:.2f}", 1e-6),
                spread(milliseconds, "{:.2f}"),
            ]
        )
    found.goal(
        f"robots a second, 8 robots with {SEEDS} seeds",
        median(speeds[str((8, SEEDS, False))]),
        GOAL,
        "{:,.0f}",
        least=True,
    )
    found.goal(
        "time of a robot among 5,000, relative to among 50 with 30 seeds",
        median(speeds[str((50, SEEDS, True))]) / median(speeds[str((5000, 1, True))]),
        MOST_GROWTH,
        "{:.2f}",
    )
    found.notes.append(f"memory of a robot among 5,000: {memory(5000) / 1024:.1f} KiB")
    present, absent = peers.divide(SIMULATORS)
    spent = interleaved({each.name: partial(each.seconds, folder) for each in present}, ROUNDS)
    for each in present:
        milliseconds = spread(spent[each.name], "{:.1f}", 1e3)
        found.notes.append(
            f"{SECONDS} s of {PEER_ROBOTS} robots in a hall with a wall, at 10 Hz, without energy, "
            f"sensors and radio, in {peers.title(each.name, each.peer)}: {milliseconds} ms"
        )
    found.notes += absent
    return found
