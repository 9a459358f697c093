"""Motion in a simulator outside, against a process that stands in for one."""

from __future__ import annotations

import json
import subprocess
import sys
from collections.abc import Iterator
from functools import partial
from pathlib import Path
from typing import Any

import pytest

from swarmdsl.base.diagnostics.collector import Diagnostics
from swarmdsl.execution.simulate.machines.actors import actors
from swarmdsl.execution.simulate.machines.subject import Subject
from swarmdsl.execution.simulate.scenario.durations import SECOND
from swarmdsl.execution.simulate.scenario.scenario import Scenario
from swarmdsl.execution.simulate.world.line import as_json
from swarmdsl.execution.simulate.world.runner import run
from swarmdsl.execution.simulate.world.world import World
from swarmdsl.execution.space.ensemble import Ensemble
from swarmdsl.execution.space.outside import OutsideError, OutsideMotion
from swarmdsl.execution.space.prepare import prepare_setting
from swarmdsl.execution.space.stage import Stage
from swarmdsl.ir import Point, System

from .worlds import changed, numbers, system_of

# Robots that get a fifth of the way to the velocity that they want in each step, and a wall.
SIMULATOR = """
import json, socketserver, sys

MODE = sys.argv[1]

class Handler(socketserver.StreamRequestHandler):
    def handle(self):
        begin = json.loads(self.rfile.readline())
        step = begin["step"]
        places = [robot["place"] for robot in begin["robots"]]
        velocities = [[0.0] * 3 for _ in places]
        self.answer(places, [False] * len(places))
        for line in self.rfile:
            if MODE == "ends":
                return
            if MODE == "odd":
                self.wfile.write(b"no places\\n")
                continue
            if MODE == "few":
                self.answer(places[1:], [])
                continue
            touched = []
            for place, velocity, wanted in zip(places, velocities, json.loads(line)["velocities"]):
                for axis in range(3):
                    velocity[axis] += 0.2 * (wanted[axis] - velocity[axis])
                    place[axis] += velocity[axis] * step
                touched.append(place[0] > 30)
                place[0] = min(place[0], 30.0)
            self.answer(places, touched)

    def answer(self, places, touched):
        line = json.dumps({"places": places, "touched": touched})
        self.wfile.write(line.encode() + b"\\n")

with socketserver.ThreadingTCPServer(("127.0.0.1", 0), Handler) as server:
    print(server.server_address[1], flush=True)
    server.serve_forever()
"""


@pytest.fixture
def simulator(request: pytest.FixtureRequest) -> Iterator[tuple[str, int]]:
    mode = getattr(request, "param", "works")
    command = [sys.executable, "-c", SIMULATOR, mode]
    with subprocess.Popen(command, stdout=subprocess.PIPE, text=True) as process:
        assert process.stdout is not None
        yield "127.0.0.1", int(process.stdout.readline())
        process.kill()


def go_to(x: float) -> Scenario:
    arguments = {"to": (x, 20.0, 0.0)}
    return Scenario(functions={("walk", ""): {"model": "go_to", "arguments": arguments}})


def system(folder: Path) -> System:
    return changed(
        system_of(folder, robots=1),
        role={"start": Point(10, 20)},
        member={"body": numbers(radius=0.3, speed=2)},
    )


def play(
    system: System, scenario: Scenario, address: tuple[str, int]
) -> tuple[Stage, list[dict[str, Any]]]:
    (swarm,) = system.swarms
    subject, report = Subject(swarm.name, system, swarm), Diagnostics()
    setting = prepare_setting(subject, scenario, report, partial(OutsideMotion, address))
    assert setting is not None
    ensemble = Ensemble(setting, [0])
    cast = actors(subject, subject.create_robots({}), scenario, report)
    lines: list[dict[str, Any]] = []
    sink = [lambda line: lines.append(json.loads(as_json(line)))]
    world = World(system, cast, scenario, 0, sink, subject.heartbeat, ensemble.spaces[0])
    try:
        run(world, [], 30 * SECOND)
    finally:
        ensemble.stage.motion.close()
    return ensemble.stage, lines


def test_a_simulator_moves_robots_to_where_their_functions_want(
    tmp_path: Path, simulator: tuple[str, int]
) -> None:
    stage, lines = play(system(tmp_path), go_to(20), simulator)
    _, arrived = lines
    assert arrived["event"] == "do.Walk.succeeded"
    assert arrived["at"] == pytest.approx([20, 20, 0], abs=0.1)
    assert stage.distance[0] == pytest.approx(10, abs=0.6)
    assert arrived["t"] > 10 / 2 * 1000


def test_what_stops_a_robot_outside_ends_its_function(
    tmp_path: Path, simulator: tuple[str, int]
) -> None:
    _, lines = play(system(tmp_path), go_to(50), simulator)
    _, stopped = lines
    assert (stopped["event"], stopped["configuration"]) == ("do.Walk.aborted", ["Stuck"])
    assert stopped["at"] == [30, 20, 0]


@pytest.mark.parametrize(
    ("simulator", "said"),
    [
        ("ends", "has ended"),
        ("odd", "answers no JSON"),
        ("few", "does not give 1 places of three numbers"),
    ],
    indirect=["simulator"],
)
def test_a_simulator_that_answers_something_else(
    tmp_path: Path, simulator: tuple[str, int], said: str
) -> None:
    with pytest.raises(OutsideError, match=said):
        play(system(tmp_path), go_to(20), simulator)


def test_no_simulator(tmp_path: Path) -> None:
    model = system(tmp_path)
    (swarm,) = model.swarms
    setting = prepare_setting(Subject(swarm.name, model, swarm), Scenario(), Diagnostics())
    assert setting is not None
    with pytest.raises(OutsideError, match="no simulator at"):
        Stage(setting.layout, [0], partial(OutsideMotion, ("127.0.0.1", 1)))
