"""Walls, obstacles and zones: contact of robots with them, and lines of sight past them.

All are made of segments and discs. A box is four segments: what starts outside of it and comes to
its inside comes through one of them.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import NamedTuple, TypeAlias

import numpy as np

from swarmdsl.execution.space.arrays import Flags, Floats, Rows, Whole

UNBOUNDED = math.inf
Pair: TypeAlias = tuple[Floats, Floats]
"""Coordinates x and y of places, or heights at both ends of lines."""
_MOST_CELLS = 256
"""Maximum number of cells of the clearance map in each direction."""
_LEAST_SIDE = 0.25
"""Minimum length of a cell of that map, in metres."""
_FEW = 500
"""Number of distances that take no longer than to look at the map."""


class Edge(NamedTuple):
    """Segment of a shape, between two heights; `opaque` if it is in the way of light and radio."""

    x1: float
    y1: float
    x2: float
    y2: float
    low: float
    high: float
    opaque: bool
    shape: int


class Round(NamedTuple):
    """Disc on the ground, up to a height."""

    x: float
    y: float
    radius: float
    high: float


class Shapes:
    """All shapes of an environment."""

    def __init__(
        self,
        edges: Sequence[Edge],
        rounds: Sequence[Round],
        boxes: Sequence[tuple[float, float, float, float]] = (),
    ) -> None:
        self._boxes = boxes
        self.is_empty = not (edges or rounds)
        """True if there is nothing to run into."""
        columns = np.array([each[:6] for each in edges], dtype=np.float64).reshape(-1, 6).T
        self._x1, self._y1, self._x2, self._y2, self._low, self._high = columns
        self._dx, self._dy = self._x2 - self._x1, self._y2 - self._y1
        square = self._dx * self._dx + self._dy * self._dy
        self._square = np.where(square > 0, square, 1.0)
        self._opaque = np.array([each.opaque for each in edges], dtype=np.bool_)
        shapes = [each.shape for each in edges]
        self._firsts = np.flatnonzero(np.diff(shapes, prepend=-1))
        """Index of the first segment of each shape; those of a shape are side by side."""
        discs = np.array([each[:4] for each in rounds], dtype=np.float64).reshape(-1, 4).T
        self._cx, self._cy, self._radius, self._top = discs
        highs = np.concatenate((self._high, self._top))
        self._endless = bool(np.all(self._low <= 0) and np.all(highs == UNBOUNDED))
        """True if all shapes are at all heights."""
        self.count = len(edges) + len(rounds)
        """Number of segments and discs."""
        self._map: _Clearance | None = None

    @property
    def bounds(self) -> tuple[float, float, float, float]:
        """Least and greatest coordinates of all shapes."""
        xs = (*self._x1, *self._x2, *(self._cx - self._radius), *(self._cx + self._radius))
        ys = (*self._y1, *self._y2, *(self._cy - self._radius), *(self._cy + self._radius))
        return min(xs), min(ys), max(xs), max(ys)

    def distances(self, x: Floats, y: Floats, z: Floats | None) -> Floats:
        """Return the distance of each place from the nearest shape at its height, or at any."""
        found: Floats | None = None
        if len(self._x1):
            distance = self._from_edges(x, y)
            if z is not None:
                beside = (z[:, None] < self._low) | (z[:, None] >= self._high)
                distance = np.where(beside, UNBOUNDED, distance)
            found = distance.min(axis=1)
        if len(self._cx):
            ox, oy = x[:, None] - self._cx, y[:, None] - self._cy
            distance = np.sqrt(ox * ox + oy * oy) - self._radius
            if z is not None:
                distance = np.where(z[:, None] >= self._top, UNBOUNDED, distance)
            nearest = distance.min(axis=1)
            found = nearest if found is None else np.minimum(found, nearest)
        return np.full(len(x), UNBOUNDED) if found is None else found

    def clearances(self, start: Pair, end: Pair, low: float, high: float) -> Floats:
        """Return the least distance of each line from shapes that reach in between two heights."""
        found = np.full(len(start[0]), UNBOUNDED)
        dx, dy = (end[0] - start[0])[:, None], (end[1] - start[1])[:, None]
        square = dx * dx + dy * dy
        safe = np.where(square > 0, square, 1.0)

        def of_points(x: Floats, y: Floats) -> Floats:
            """Return the distance of each point from each line."""
            px, py = x - start[0][:, None], y - start[1][:, None]
            along = np.clip((px * dx + py * dy) / safe, 0.0, 1.0)
            ox, oy = px - along * dx, py - along * dy
            return np.asarray(np.sqrt(ox * ox + oy * oy))

        there = (high >= self._low) & (low < self._high)
        if there.any():
            gaps = np.minimum(
                of_points(self._x1[there], self._y1[there]),
                of_points(self._x2[there], self._y2[there]),
            ).min(axis=1)
            for x, y in (start, end):
                gaps = np.minimum(gaps, self._from_edges(x, y)[:, there].min(axis=1))
            met = (self._meets_lines(start, end)[0] & there).any(axis=1)
            found = np.where(met, 0.0, gaps)
        tall = low < self._top
        if tall.any():
            gaps = of_points(self._cx[tall], self._cy[tall]) - self._radius[tall]
            found = np.minimum(found, gaps.min(axis=1))
        return found

    def corners(self, height: float) -> tuple[Pair, tuple[Floats, Floats, Floats]]:
        """Return the ends of segments at a height, and the discs: x, y and radius."""
        there = (height >= self._low) & (height < self._high)
        x = np.concatenate([self._x1[there], self._x2[there]])
        y = np.concatenate([self._y1[there], self._y2[there]])
        ends = np.unique(np.stack([x, y], axis=1), axis=0)
        tall = height < self._top
        return (ends[:, 0], ends[:, 1]), (self._cx[tall], self._cy[tall], self._radius[tall])

    def standing(self, height: float) -> bytes:
        """Return a key for the shapes that are in the way at a height."""
        there = (height >= self._low) & (height < self._high)
        return there.tobytes() + (height < self._top).tobytes()

    def inside(self, x: Floats, y: Floats) -> Flags:
        """Return True for places in a box or a disc."""
        found = np.zeros(len(x), dtype=np.bool_)
        for low_x, low_y, high_x, high_y in self._boxes:
            found |= (x > low_x) & (x < high_x) & (y > low_y) & (y < high_y)
        if len(self._cx):
            ox, oy = x[:, None] - self._cx, y[:, None] - self._cy
            found |= (ox * ox + oy * oy < self._radius * self._radius).any(axis=1)
        return found

    def touched(self, start: Pair, end: Pair, z: Floats, radius: Floats, reach: Floats) -> Rows:
        """Return the indices of bodies that touch a shape when they go from a place to another one.

        One that is too near already may go away from it. `reach` is at least the radius of a body
        and the length of its way.
        """
        near = self._near(end[0], end[1], reach)
        if not len(near):
            return near
        count, height = len(near), z[near]
        x = np.concatenate((start[0][near], end[0][near]))
        y = np.concatenate((start[1][near], end[1][near]))
        level = None if self._endless else np.concatenate((height, height))
        gaps = self.distances(x, y, level)
        before, after = gaps[:count], gaps[count:]
        found = (after < radius[near]) & (after < before)
        # A way that goes through a shape is at least as long as both of its ends are away from it.
        if np.count_nonzero(before + after <= reach[near] - radius[near]):
            first, last = (x[:count], y[:count]), (x[count:], y[count:])
            found |= self._meets_edges(first, last, (height, height)).any(axis=1)
        touched: Rows = near[found]
        return touched

    def crossings(self, start: Pair, end: Pair, heights: Pair) -> Whole:
        """Return how many opaque shapes are in the way of each line."""
        count = len(start[0])
        if self.is_empty or not count:
            return np.zeros(count, dtype=np.int64)
        found = np.zeros(count, dtype=np.int64)
        if len(self._x1):
            met = self._meets_edges(start, end, heights) & self._opaque
            found += np.logical_or.reduceat(met, self._firsts, axis=1).sum(axis=1)
        if len(self._cx):
            found += self._meets_discs(start, end, heights).sum(axis=1)
        return found

    def _from_edges(self, x: Floats, y: Floats) -> Floats:
        """Return the distance of each place from each segment."""
        px, py = x[:, None] - self._x1, y[:, None] - self._y1
        along = (px * self._dx + py * self._dy) / self._square
        along = np.minimum(np.maximum(along, 0.0), 1.0)
        ox, oy = px - along * self._dx, py - along * self._dy
        return np.asarray(np.sqrt(ox * ox + oy * oy))

    def _meets_edges(self, start: Pair, end: Pair, heights: Pair) -> Flags:
        """Return True where a line goes through a segment, at a height at which it is."""
        met, along = self._meets_lines(start, end)
        level = heights[0][:, None] + along * (heights[1] - heights[0])[:, None]
        return met & (level >= self._low) & (level < self._high)

    def _meets_lines(self, start: Pair, end: Pair) -> tuple[Flags, Floats]:
        """Return True where a line goes through a segment, and at which share of the line."""
        dx, dy = (end[0] - start[0])[:, None], (end[1] - start[1])[:, None]
        fx, fy = self._x1 - start[0][:, None], self._y1 - start[1][:, None]
        across = dx * self._dy - dy * self._dx
        parallel = across == 0
        safe = np.where(parallel, 1.0, across)
        along = (fx * self._dy - fy * self._dx) / safe
        beside = (fx * dy - fy * dx) / safe
        met: Flags = ~parallel & (along >= 0) & (along <= 1) & (beside >= 0) & (beside <= 1)
        return met, along

    def _meets_discs(self, start: Pair, end: Pair, heights: Pair) -> Flags:
        """Return True where a line goes through a disc, below its top."""
        dx, dy = (end[0] - start[0])[:, None], (end[1] - start[1])[:, None]
        square = dx * dx + dy * dy
        fx, fy = self._cx - start[0][:, None], self._cy - start[1][:, None]
        along = np.clip((fx * dx + fy * dy) / np.where(square > 0, square, 1.0), 0.0, 1.0)
        ox, oy = fx - along * dx, fy - along * dy
        level = heights[0][:, None] + along * (heights[1] - heights[0])[:, None]
        met: Flags = (ox * ox + oy * oy < self._radius * self._radius) & (level < self._top)
        return met

    def _near(self, x: Floats, y: Floats, reach: Floats) -> Rows:
        """Return the indices of all places with a shape within reach, and of some others."""
        if self._map is None:
            self._map = _Clearance(self)
        return self._map.below(x, y, reach)


class _Clearance:
    """Map of the distance that each place has at least from the nearest shape."""

    def __init__(self, shapes: Shapes) -> None:
        low_x, low_y, high_x, high_y = shapes.bounds
        self._bounds = low_x, low_y, high_x, high_y
        self._shapes = shapes.count
        side = max(high_x - low_x, high_y - low_y) / _MOST_CELLS
        self._side = max(side, _LEAST_SIDE)
        self._columns = int((high_x - low_x) / self._side) + 1
        self._lines = int((high_y - low_y) / self._side) + 1
        middles = np.arange(self._columns, dtype=np.float64) + 0.5
        centres: Floats = np.asarray(low_x + middles * self._side, dtype=np.float64)
        half = self._side * 0.75  # more than half a diagonal
        self._least = np.empty((self._lines, self._columns))
        for line in range(self._lines):
            y = np.full(self._columns, low_y + (line + 0.5) * self._side)
            self._least[line] = shapes.distances(centres, y, None) - half

    def below(self, x: Floats, y: Floats, reach: Floats) -> Rows:
        """Return the indices of places from which a shape may be nearer than a distance."""
        low_x, low_y, high_x, high_y = self._bounds
        away_x, away_y = np.maximum(low_x - x, x - high_x), np.maximum(low_y - y, y - high_y)
        near: Rows = (np.maximum(away_x, away_y) <= reach).nonzero()[0]
        if len(near) * self._shapes <= _FEW:
            return near
        x, y, reach = x[near], y[near], reach[near]
        inner_x = np.minimum(np.maximum(x, low_x), high_x)
        inner_y = np.minimum(np.maximum(y, low_y), high_y)
        column = ((inner_x - low_x) / self._side).astype(np.int64)
        line = ((inner_y - low_y) / self._side).astype(np.int64)
        # The way to the map is at most this much longer than the distance.
        reach = reach + np.abs(x - inner_x) + np.abs(y - inner_y)
        return near[self._least[line, column] <= reach]
