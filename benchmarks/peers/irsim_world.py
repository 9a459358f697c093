"""Robots in ir-sim that drive to random goals, one after the other, in a hall with a wall."""

from __future__ import annotations

from pathlib import Path
from time import process_time

_WORLD = """
world:
  height: 50
  width: 50
  step_time: {step}
  collision_mode: 'stop'
robot:
  - number: {robots}
    distribution: {{name: 'random', range_low: [2, 2, -3.14], range_high: [20, 48, 3.14]}}
    kinematics: {{name: 'omni'}}
    shape: {{name: 'circle', radius: 0.15}}
    behavior: {{name: 'dash', wander: True, range_low: [2, 2, -3.14], range_high: [48, 48, 3.14]}}
    vel_min: [-2, -2]
    vel_max: [2, 2]
obstacle:
  - shape: {{name: 'linestring', vertices: [[25, 0], [25, 20]]}}
"""


def seconds(folder: Path, robots: int, steps: int, step: float) -> float:
    """Return the CPU time of the steps, without that of the start."""
    import irsim

    file = folder / "world.yaml"
    file.write_text(_WORLD.format(robots=robots, step=step), encoding="utf-8")
    env = irsim.make(str(file), display=False, disable_all_plot=True, log_level="ERROR")
    start = process_time()
    for _ in range(steps):
        env.step()
    spent = process_time() - start
    moved = sum(abs(float(robot.state[0, 0])) > 0 for robot in env.robot_list)
    assert moved == robots
    env.end()
    return spent
