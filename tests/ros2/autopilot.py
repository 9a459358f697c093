"""Stand-in for an autopilot with PX4, without ROS: what it hears, and what it does and says."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass, field
from typing import Any

OFFBOARD, LOITER, POSITION, RETURN, LAND = 14, 4, 2, 5, 18
DO_RETURN, DO_LAND, SET_MODE, ARM = 20, 21, 176, 400
ACCEPTED, REJECTED_FOR_NOW, DENIED = 0, 1, 2
_GAP = 0.5  # PX4 wants setpoints at 2 Hz
_BEFORE = 1.0
_SPEED = 8.0
_SINKING = 4.0


@dataclass
class Autopilot:
    """A copter that flies at once where it is told; `say` gets the answers to commands."""

    say: Callable[[int, int], None]
    system: int = 1
    now: float = 0.0
    place: list[float] = field(default_factory=lambda: [0.0, 0.0, 0.0])
    speed: float = 0.0
    heading: float = 0.5
    mode: int = LOITER
    armed: bool = False
    failsafe: bool = False
    checks: bool = True
    knows_place: bool = True
    denies: tuple[int, ...] = ()
    is_deaf: bool = False
    commands: list[int] = field(default_factory=list)
    gaps: list[float] = field(default_factory=list)
    yaw: float = math.nan
    ground: float = 0.0
    jumps: int = 0
    jump: tuple[float, float, float, float] = (0.0, 0.0, 0.0, 0.0)
    _setpoint: Sequence[float] | None = None
    _first: float | None = None
    _last: float | None = None

    @property
    def landed(self) -> bool:
        """True on the ground."""
        return self.place[2] >= self.ground - 0.02

    def correct(self, north: float, east: float, down: float, turn: float) -> None:
        """Correct the estimate: the vehicle stays, and its numbers change."""
        self.jumps = (self.jumps + 1) % 256
        self.jump = (north, east, down, turn)
        moved = zip(self.place, self.jump, strict=False)
        self.place = [old + way for old, way in moved]
        if self._setpoint is not None:  # PX4 does so until it hears the next one
            moved = zip(self._setpoint, self.jump, strict=False)
            self._setpoint = [old + way for old, way in moved]
        self.ground += down
        self.heading += turn

    def hear_setpoint(self, position: Sequence[float], yaw: float) -> None:
        """Take a setpoint, with the message that says what of it counts."""
        if self._last is not None and self.now - self._last <= _GAP:
            self.gaps.append(self.now - self._last)
        else:
            self._first = self.now
        self._last = self.now
        self._setpoint, self.yaw = list(position), yaw

    def hear_command(self, command: Any) -> None:
        """Obey a command for this vehicle, and answer."""
        if command.target_system != self.system or self.is_deaf:
            return
        self.commands.append(command.command)
        self.say(command.command, self._obey(command))

    def _obey(self, command: Any) -> int:
        number = command.command
        if number in self.denies:
            return DENIED
        if number == SET_MODE:
            if (command.param1, command.param2) != (1.0, 6.0):
                return DENIED
            steady = self._first is not None and self.now - self._first >= _BEFORE
            if not steady or self._is_late():
                return REJECTED_FOR_NOW
            self.mode = OFFBOARD
        elif number == ARM and command.param1 == 1.0:
            if not self.checks:
                return DENIED
            self.armed = True
        elif number == ARM:
            if self.armed and not self.landed:
                return DENIED
            self.armed = False
        else:
            self.mode = {DO_LAND: LAND, DO_RETURN: RETURN}[number]
        return ACCEPTED

    def _is_late(self) -> bool:
        return self._last is None or self.now - self._last > _GAP

    def step(self, seconds: float) -> None:
        """Fly on."""
        self.now += seconds
        if self.mode == OFFBOARD and self._is_late():
            self.mode, self.failsafe = LAND, True
        before = list(self.place)
        if self.armed:
            self._move(seconds)
        self.speed = math.dist(before, self.place) / seconds

    def _move(self, seconds: float) -> None:
        north, east, down = self.place
        if self.mode == OFFBOARD:
            assert self._setpoint is not None
            self._toward(self._setpoint, seconds)
        elif self.mode == RETURN and math.hypot(north, east) > 0.01:
            self._toward([0.0, 0.0, down], seconds)
        elif self.mode in (LAND, RETURN):
            self.place[2] = min(down + _SINKING * seconds, self.ground)

    def _toward(self, goal: Sequence[float], seconds: float) -> None:
        way = math.dist(self.place, goal)
        share = 1.0 if way <= _SPEED * seconds else _SPEED * seconds / way
        moved = [a + (b - a) * share for a, b in zip(self.place, goal, strict=True)]
        self.place = [*moved[:2], min(moved[2], self.ground)]

    def status(self) -> dict[str, Any]:
        """Return the fields of a VehicleStatus."""
        return {
            "arming_state": 2 if self.armed else 1,
            "nav_state": self.mode,
            "failsafe": self.failsafe,
            "system_id": self.system,
            "pre_flight_checks_pass": self.checks,
        }

    def position(self) -> dict[str, Any]:
        """Return the fields of a VehicleLocalPosition."""
        return {
            "xy_valid": self.knows_place,
            "z_valid": self.knows_place,
            "x": self.place[0],
            "y": self.place[1],
            "z": self.place[2],
            "vx": self.speed,
            "heading": self.heading,
            "delta_xy": list(self.jump[:2]),
            "delta_z": self.jump[2],
            "delta_heading": self.jump[3],
            "xy_reset_counter": self.jumps,
            "z_reset_counter": self.jumps,
            "heading_reset_counter": self.jumps,
        }
