"""Motion of robots in a simulator outside: a skeleton for Gazebo, ARGoS, Webots and others.

The simulator has a plugin that listens on a TCP port; each run has a connection of its own. Each
line is a JSON object. The first one says who is there:

    {"seed": 4, "step": 0.1, "robots": [{"name": "uav[0]", "radius": 0.3, "mass": 1.5,
     "speed": 5.0, "climb": 2.0, "place": [3.0, 4.0, 0.0]}]}

and then there is a line for each step, with the velocities over ground that robots want:

    {"time": 0.1, "velocities": [[5.0, 0.0, 0.0]], "alive": [true], "wind": [0.0, 0.0]}

The plugin answers each line, the first one too, when it has simulated the step:

    {"places": [[3.4, 4.0, 0.0]], "touched": [false]}

with the places of all robots, in order, and perhaps with the robots that something stopped.
"""

from __future__ import annotations

import json
import math
import socket
from collections.abc import Mapping
from typing import Any

import numpy as np

from swarmdsl.execution.simulate.scenario.durations import SECOND
from swarmdsl.execution.space.arrays import Floats, Part
from swarmdsl.execution.space.motion import Motion
from swarmdsl.execution.space.robots import Robots

PATIENCE = 30.0
"""Longest time in seconds to wait for an answer."""
_LONGEST = 1 << 24
"""Longest answer, in bytes."""
_LEAST_SPEED = 1e-3
"""Speed in m/s from which on robots look where they go."""


class OutsideError(Exception):
    """A simulator outside is not there, or answers something else than places."""


class OutsideMotion(Motion):
    """Let a simulator move the robots: velocities go out to it, places come in.

    `Setting.motion` takes it as `partial(OutsideMotion, ("127.0.0.1", 9000))`.
    """

    arrival = 0.1

    def __init__(self, address: tuple[str, int], robots: Robots) -> None:
        super().__init__(robots)
        self._through_air: Floats = np.zeros(robots.rows)
        self._peers: list[_Peer] = []
        try:
            for run, seed in enumerate(robots.seeds):
                self._peers.append(_Peer(address))
                self._take(run, self._peers[run].ask(self._introduction(run, seed)), first=True)
        except OutsideError:
            self.close()
            raise

    def move(self, part: Part) -> None:
        """Let the simulator do a step of some runs."""
        robots = self.robots
        count = robots.robots
        runs = range(len(self._peers)) if isinstance(part, slice) else part[::count] // count
        for run in runs:
            rows = self._rows(run)
            alive = robots.alive[rows]
            wanted = np.column_stack(
                (robots.wanted_x[rows], robots.wanted_y[rows], robots.wanted_z[rows])
            )
            time = robots.ticks[run : run + 1] * robots.step_length
            wind_x, wind_y = robots.weather.wind(time)
            question = {
                "time": int(time[0]) / SECOND,
                "velocities": (wanted * alive[:, None]).tolist(),
                "alive": alive.tolist(),
                "wind": [float(wind_x[0]), float(wind_y[0])],
            }
            self._take(run, self._peers[run].ask(question))
        robots.air_speed = self._through_air[part]

    def rests(self, run: int) -> bool:
        """Return False: only the simulator knows what still moves."""
        return False

    def lose(self, row: int) -> None:
        """Do nothing: the simulator knows from `alive`, and lets the robot fall."""

    def pace(self, gap: Floats, fastest: Floats) -> Floats:
        """Return speeds that get less near a place: a robot with a mass needs time to brake."""
        return np.minimum(fastest, 2 * gap)

    def close(self) -> None:
        """Close the connections."""
        for peer in self._peers:
            peer.close()

    # ---- internal

    def _rows(self, run: int) -> slice:
        return slice(run * self.robots.robots, (run + 1) * self.robots.robots)

    def _introduction(self, run: int, seed: int) -> dict[str, Any]:
        robots = self.robots
        told = []
        for row, unit in enumerate(robots.layout.units, self._rows(run).start):
            body = unit.body
            place = [float(robots.x[row]), float(robots.y[row]), float(robots.z[row])]
            told.append(
                {
                    "name": unit.robot.name or "",
                    "radius": body.radius,
                    "mass": body.mass,
                    "speed": body.speed,
                    "climb": body.climb,
                    "place": place,
                }
            )
        return {"seed": seed, "step": robots.dt, "robots": told}

    def _take(self, run: int, answer: Mapping[str, Any], *, first: bool = False) -> None:
        """Write to the arrays what the simulator says."""
        robots, rows = self.robots, self._rows(run)
        place = _numbers(answer.get("places"), robots.robots)
        touched = answer.get("touched", [False] * robots.robots)
        if not isinstance(touched, list) or len(touched) != robots.robots:
            raise OutsideError("the simulator outside does not say of each robot if it touches")
        before = np.column_stack((robots.x[rows], robots.y[rows], robots.z[rows]))
        robots.x[rows], robots.y[rows], robots.z[rows] = place.T
        if first:
            return
        way = place - before
        velocity = way / robots.dt
        robots.vx[rows], robots.vy[rows], robots.vz[rows] = velocity.T
        speed = np.hypot(velocity[:, 0], velocity[:, 1])
        goes = speed > _LEAST_SPEED
        robots.heading_x[rows][goes] = velocity[goes, 0] / speed[goes]
        robots.heading_y[rows][goes] = velocity[goes, 1] / speed[goes]
        robots.distance[rows] += np.sqrt((way * way).sum(axis=1))
        robots.touched[rows] = [bool(each) for each in touched]
        self._through_air[rows] = speed


class _Peer:
    """Connection of a run to the simulator."""

    def __init__(self, address: tuple[str, int]) -> None:
        try:
            self._socket = socket.create_connection(address, PATIENCE)
        except OSError as error:
            host, port = address
            raise OutsideError(f"no simulator at {host}:{port}: {error}") from error
        self._lines = self._socket.makefile("rb")

    def ask(self, question: Mapping[str, Any]) -> Mapping[str, Any]:
        """Send a line, and return the answer."""
        try:
            self._socket.sendall(json.dumps(question).encode() + b"\n")
            line = self._lines.readline(_LONGEST)
        except OSError as error:
            raise OutsideError(f"the simulator outside does not answer: {error}") from error
        if not line.endswith(b"\n"):
            raise OutsideError("the simulator outside has ended")
        try:
            answer = json.loads(line)
        except ValueError as error:
            raise OutsideError(f"the simulator outside answers no JSON: {error}") from error
        if not isinstance(answer, dict):
            raise OutsideError("the simulator outside answers no JSON object")
        return answer

    def close(self) -> None:
        self._lines.close()
        self._socket.close()


def _numbers(value: Any, count: int) -> Floats:
    """Return places as an array."""
    fits = isinstance(value, list) and len(value) == count
    if not fits or not all(isinstance(each, list) and _is_place(each) for each in value):
        raise OutsideError(f"the simulator outside does not give {count} places of three numbers")
    return np.array(value, dtype=np.float64).reshape(count, 3)


def _is_place(value: list[Any]) -> bool:
    return len(value) == 3 and all(
        isinstance(each, (int, float)) and not isinstance(each, bool) and math.isfinite(each)
        for each in value
    )
