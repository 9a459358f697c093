"""Models with a space, made from text and from plain data of the IR."""

from __future__ import annotations

import json
from collections.abc import Mapping
from dataclasses import replace
from pathlib import Path
from typing import Any

from swarmdsl.base.diagnostics.collector import Diagnostics
from swarmdsl.driver import pipeline
from swarmdsl.execution.simulate.inputs.choose_space import choose_space
from swarmdsl.execution.simulate.machines.actors import actors
from swarmdsl.execution.simulate.machines.subject import Subject
from swarmdsl.execution.simulate.scenario.durations import SECOND
from swarmdsl.execution.simulate.scenario.scenario import Robot, Scenario
from swarmdsl.execution.simulate.world.line import as_json
from swarmdsl.execution.simulate.world.runner import run
from swarmdsl.execution.simulate.world.world import World
from swarmdsl.ir import FLOAT, Expression, Literal, ModelUse, System

TEXT = """
action demo_msgs/Go {
  goal   { altitude : float64 }
  result { target_id : string, target_pose : geometry_msgs/PoseStamped }
}
function walk : swarm { action "walk" : demo_msgs/Go }

event Low : sensor_msgs/BatteryState on "battery/state"
swarm event Found : cpswarm_msgs/TargetPositionEvent on "target_found"
swarm event Hello : std_msgs/String

endless statemachine Walking {
  initial Walk
  state Walk {
    do walk(altitude = 0)
    on succeeded -> Done
    on aborted   -> Stuck
    on Low [event.percentage < 0.5] -> Tired
    on Found -> Told
    on Hello -> Told
  }
  state Done  { on Hello -> Told }
  state Stuck { }
  state Tired { }
  state Told  { }
}

sensor Camera { out target : cpswarm_msgs/TargetPositionEvent on "target_found" }

message cpswarm_msgs/TargetPositionEvent {
  header : std_msgs/Header
  id     : string
  pose   : geometry_msgs/PoseStamped
}

environment Field { size 100 m x 80 m x 30 m }
member Rover {
  behavior Walking
  camera : Camera
}
swarm S {
  rover : Rover[ROBOTS]
  environment Field
}
"""


def numbers(**values: float) -> tuple[tuple[str, Expression], ...]:
    return tuple((name, Literal(float(value), FLOAT)) for name, value in values.items())


def system_of(folder: Path, text: str = TEXT, robots: int = 2) -> System:
    path = folder / "demo.swarm"
    path.write_text(text.replace("ROBOTS", str(robots)), encoding="utf-8")
    checked = pipeline.check([path])
    assert checked.system is not None, [each.message for each in checked.report]
    return checked.system


def changed(
    system: System,
    *,
    environment: Mapping[str, Any] | None = None,
    member: Mapping[str, Any] | None = None,
    role: Mapping[str, Any] | None = None,
    camera: Mapping[str, Any] | None = None,
    model: ModelUse | None = None,
) -> System:
    """The same system with a space."""
    (swarm,) = system.swarms
    return replace(
        system,
        environments=tuple(replace(each, **environment or {}) for each in system.environments),
        members=tuple(replace(each, **member or {}) for each in system.members),
        components=tuple(replace(each, **camera or {}) for each in system.components),
        functions=tuple(replace(each, model=model) for each in system.functions),
        swarms=(replace(swarm, roles=tuple(replace(r, **role or {}) for r in swarm.roles)),),
    )


class Played:
    """A run with its trace as JSON lines."""

    def __init__(
        self,
        system: System,
        seed: int = 0,
        until: float = 60,
        scenario: Scenario | None = None,
        kind: str | None = None,
    ) -> None:
        (swarm,) = system.swarms
        self.report = Diagnostics()
        self.subject = Subject(swarm.name, system, swarm)
        scenario = scenario or Scenario()
        self.spaces = choose_space(kind, self.subject, scenario, self.report)
        assert not self.report.has_errors, [each.message for each in self.report]
        robots = self.subject.create_robots(scenario.counts)
        cast = actors(self.subject, robots, scenario, self.report)
        self.lines: list[dict[str, Any]] = []
        space = self.spaces.alone(seed)
        self.world = World(
            system,
            cast,
            scenario,
            seed,
            [lambda line: self.lines.append(json.loads(as_json(line)))],
            self.subject.heartbeat,
            space,
        )
        self.ending = run(self.world, [], round(until * SECOND))
        self.space = space

    def robot(self, index: int = 0) -> Robot:
        return self.world.robots[index]

    def events(self, name: str | None = None) -> list[dict[str, Any]]:
        return [line for line in self.lines if name is None or line["event"] == name]
