"""Ground that robots have covered, as a map of cells."""

from __future__ import annotations

import math

import numpy as np

from swarmdsl.execution.space.arrays import Flags, Floats, Part, Whole
from swarmdsl.execution.space.robots import Robots
from swarmdsl.execution.space.sensing import footprint, tangent_of

_MOST_CELLS = 200
"""Maximum number of cells in each direction."""
_CELLS_OF_REACH = 4
"""Number of cells from a robot to the edge of what it covers."""
_NOTES_OF_REACH = 3
"""Number of notes while a robot moves as far as what it covers."""
_NOBODY = -1


class Covering:
    """Cells of the environment that have been in the footprint of a robot of each role.

    The footprint of a robot is what its sensors see around it, or the width of its lanes, or at
    least its body. It is noted whenever the robot has moved by a part of that.
    """

    def __init__(self, stage: Robots) -> None:
        self.is_wanted = False
        """True if somebody asks for what has been covered."""
        self._stage = stage
        self.reach = np.array(stage.radius)
        """Distance up to which each robot covers the ground without its sensors."""
        units = stage.layout.units
        self.has_eyes: Flags = np.tile([bool(unit.eyes) for unit in units], len(stage.seeds))
        most = max((len(unit.eyes) for unit in units), default=0)
        self._eyes = [(self._ranges(number), self._tangents(number)) for number in range(most)]
        """Range and view of the sensors with each number."""
        self._rows: Whole = np.arange(stage.rows)
        self._squares: dict[int, tuple[Whole, Whole]] = {}
        """Cells around one, as columns and lines from it, by how far they reach."""
        self._noted_x = np.full(stage.rows, math.inf)
        """Place of each robot when it was noted last: x; likewise for y."""
        self._noted_y, self._noted_z = np.full((2, stage.rows), math.inf)
        self._side = 0.0

    @property
    def is_noted(self) -> bool:
        """True if something has been noted."""
        return bool(self._side)

    def _begin(self) -> None:
        """Make the map, when it is first needed."""
        stage = self._stage
        assert stage.bounds is not None
        low_x, low_y, high_x, high_y = stage.bounds
        # As in a run alone: what models say to some robots does not count.
        reaches = (
            max((eye.range for eye in u.eyes), default=u.body.radius) for u in stage.layout.units
        )
        reach = min(reaches, default=0.0) or 1.0
        longest = max(high_x - low_x, high_y - low_y)
        self._side = max(reach / _CELLS_OF_REACH, longest / _MOST_CELLS)
        self._columns = max(math.ceil((high_x - low_x) / self._side), 1)
        self._lines = max(math.ceil((high_y - low_y) / self._side), 1)
        self._cells = self._columns * self._lines
        runs = len(stage.seeds)
        self._covered: Flags = np.zeros(runs * len(stage.roles) * self._cells, dtype=np.bool_)
        self._first: Whole = np.full(runs * self._cells, _NOBODY, dtype=np.int32)

    def note(self, part: Part) -> None:
        """Note what robots in some rows cover, if they have moved enough."""
        stage = self._stage
        if not self.is_wanted or stage.bounds is None:
            return
        if not self._side:
            self._begin()
        rows = self._rows[part]
        dx, dy = stage.x[rows] - self._noted_x[rows], stage.y[rows] - self._noted_y[rows]
        dz = stage.z[rows] - self._noted_z[rows]
        reaches = self._reaches(rows)
        enough = np.maximum(reaches, self._side) / _NOTES_OF_REACH
        now = stage.alive[rows] & (dx * dx + dy * dy + dz * dz >= enough * enough)
        rows, reaches = rows[now], reaches[now]
        if not len(rows):
            return
        self._noted_x[rows], self._noted_y[rows] = stage.x[rows], stage.y[rows]
        self._noted_z[rows] = stage.z[rows]
        # Rounded to a quarter of a cell.
        reaches = np.rint(reaches / self._side * 4) * self._side / 4
        for reach in sorted(set(reaches.tolist())):
            self._mark(reach, rows[reaches == reach])

    def _reaches(self, rows: Whole) -> Floats:
        """Return the distance up to which robots cover the ground now."""
        found: Floats = self.reach[rows]
        for reach, tangent in self._eyes:
            found = np.maximum(found, footprint(self._stage, rows, reach[rows], tangent[rows]))
        return found

    def _ranges(self, number: int) -> Floats:
        """Return the range of the sensor of each robot with this number, 0 without one."""
        of = [unit.eyes[number : number + 1] for unit in self._stage.layout.units]
        return np.tile([eyes[0].range if eyes else 0.0 for eyes in of], len(self._stage.seeds))

    def _tangents(self, number: int) -> Floats:
        of = [unit.eyes[number : number + 1] for unit in self._stage.layout.units]
        views = [tangent_of(eyes[0].view) if eyes else 0.0 for eyes in of]
        return np.tile(views, len(self._stage.seeds))

    def _mark(self, reach: float, rows: Whole) -> None:
        stage, side = self._stage, self._side
        most = max(int(reach / side + 0.5), 0)
        across, along = self._around(most)
        low_x, low_y = stage.bounds[:2] if stage.bounds else (0.0, 0.0)
        column = ((stage.x[rows] - low_x) / side).astype(np.int64)[:, None] + across
        line = ((stage.y[rows] - low_y) / side).astype(np.int64)[:, None] + along
        dx = low_x + (column + 0.5) * side - stage.x[rows][:, None]
        dy = low_y + (line + 0.5) * side - stage.y[rows][:, None]
        near = (dx * dx + dy * dy <= reach * reach) | ((across == 0) & (along == 0))
        near &= (column >= 0) & (column < self._columns) & (line >= 0) & (line < self._lines)
        cell = (line * self._columns + column)[near]
        who = np.broadcast_to(rows[:, None], near.shape)[near]
        run = stage.run[who]
        self._covered[(run * len(stage.roles) + stage.role[who]) * self._cells + cell] = True
        places = run * self._cells + cell
        new = self._first[places] == _NOBODY
        # The robot with the least number, where several come to a cell at once.
        self._first[places[new][::-1]] = who[new][::-1]

    def _around(self, most: int) -> tuple[Whole, Whole]:
        """Return the columns and lines of a square of cells, from that in its middle."""
        found = self._squares.get(most)
        if found is None:
            offsets = np.arange(-most, most + 1)
            across, along = np.meshgrid(offsets, offsets)
            found = self._squares[most] = across.ravel(), along.ravel()
        return found

    def share(self, run: int, role: str | None = None) -> float:
        """Return the share of the environment that a role has covered in a run, or all."""
        if not self._side:
            return 0.0
        stage = self._stage
        cells = self._covered.reshape(len(stage.seeds), len(stage.roles), self._cells)[run]
        layers = cells if role is None else cells[stage.roles.index(role)][None]
        return float(np.count_nonzero(layers.any(axis=0))) / self._cells

    def first(self, row: int) -> float:
        """Return the share of the environment that a robot was the first to cover."""
        if not self._side:
            return 0.0
        return float(np.count_nonzero(self._first == row)) / self._cells
