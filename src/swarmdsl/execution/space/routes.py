"""Ways around what is in the way: shortest paths along the corners of shapes.

Corners of a visibility graph are points around the ends of segments and around discs, as far away
as the body is wide. Its lines are made when a search comes to them, and kept.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from heapq import heappop, heappush

import numpy as np

from swarmdsl.execution.space.arrays import Flags, Floats
from swarmdsl.execution.space.shapes import Pair, Shapes
from swarmdsl.execution.space.turning import direction

Point = tuple[float, float]
Place = tuple[float, float, float]
_SIDES = 16
"""Number of corners around a disc."""
_MARGIN = 1e-3
"""Distance in metres that corners have from where a body would touch."""
_NOISE = 1e-6
"""Error in metres that places of robots can have."""


class Routes:
    """Ways of bodies with one radius, at heights at which the same shapes are in the way."""

    def __init__(
        self,
        shapes: Shapes,
        height: float,
        radius: float,
        margin: float,
        bounds: tuple[float, float, float, float] | None,
    ) -> None:
        self._shapes = shapes
        self._height = height
        self._radius = radius
        x, y = self._corners(radius + margin + _MARGIN)
        free = shapes.distances(x, y, np.full(len(x), height)) > radius + _NOISE
        if bounds is not None:
            low_x, low_y, high_x, high_y = bounds
            free &= (x >= low_x + radius) & (x <= high_x - radius)
            free &= (y >= low_y + radius) & (y <= high_y - radius)
        self._x, self._y = x[free], y[free]
        self._lines: dict[int, tuple[list[int], list[float]]] = {}
        """Corners that can be gone to from each one in a straight line, and how far they are."""

    def find(self, start: Point, goal: Point) -> list[Point] | None:
        """Return the corners of the shortest way, without its ends; None if there is no way."""
        ends = self._from(start)
        last, left = self._from(goal), self._lengths(goal)
        first, begun = self._lengths(start), np.flatnonzero(ends).tolist()
        best = {corner: float(first[corner]) for corner in begun}
        before: dict[int, int] = {}
        waiting: list[tuple[float, int]] = []
        for corner in begun:
            heappush(waiting, (best[corner] + float(left[corner]), corner))
        done: set[int] = set()
        while waiting:
            _, corner = heappop(waiting)
            if corner in done:
                continue
            done.add(corner)
            if last[corner]:
                return self._path(corner, before)
            for other, length in zip(*self._of(corner), strict=True):
                way = best[corner] + length
                if other not in done and way < best.get(other, math.inf):
                    best[other], before[other] = way, corner
                    heappush(waiting, (way + float(left[other]), other))
        return None

    # ---- internal

    def _corners(self, away: float) -> Pair:
        """Return the corners of octagons around ends of segments, and of polygons around discs."""
        (xs, ys), (cx, cy, radius) = self._shapes.corners(self._height)
        long, short = away, away * (math.sqrt(2) - 1)
        offsets = [(a * s, b * t) for a, b in ((long, short), (short, long)) for s, t in _SIGNS]
        dx, dy = np.array(offsets).T
        turns = np.array([number * math.tau / _SIDES for number in range(_SIDES)])
        cosine, sine = direction(turns)
        # The sides of a polygon are nearer than its corners.
        half_x, _ = direction(np.array([math.pi / _SIDES]))
        around = ((radius + away) / half_x)[:, None]
        x = np.concatenate([(xs[:, None] + dx).ravel(), (cx[:, None] + around * cosine).ravel()])
        y = np.concatenate([(ys[:, None] + dy).ravel(), (cy[:, None] + around * sine).ravel()])
        return x, y

    def _lengths(self, point: Point) -> Floats:
        dx, dy = self._x - point[0], self._y - point[1]
        return np.asarray(np.sqrt(dx * dx + dy * dy))

    def _from(self, point: Point) -> Flags:
        """Return which corners can be gone to from a point in a straight line."""
        count = len(self._x)
        start = np.full(count, point[0]), np.full(count, point[1])
        gap = self._shapes.clearances(start, (self._x, self._y), self._height, self._height)
        here = self._shapes.distances(start[0][:1], start[1][:1], np.array([self._height]))
        # A robot that stands too near to something may go away from it.
        enough = min(self._radius + _NOISE, float(here[0]) if count else 0.0)
        return np.asarray(gap >= enough)

    def _of(self, corner: int) -> tuple[list[int], list[float]]:
        found = self._lines.get(corner)
        if found is None:
            point = float(self._x[corner]), float(self._y[corner])
            others = np.flatnonzero(self._from(point))
            found = others.tolist(), self._lengths(point)[others].tolist()
            self._lines[corner] = found
        return found

    def _path(self, corner: int, before: dict[int, int]) -> list[Point]:
        path = [corner]
        while path[-1] in before:
            path.append(before[path[-1]])
        return [(float(self._x[each]), float(self._y[each])) for each in reversed(path)]


_SIGNS = ((1, 1), (1, -1), (-1, 1), (-1, -1))


class Router:
    """Finds ways for the robots of a stage."""

    def __init__(
        self, shapes: Shapes, bounds: tuple[float, float, float, float] | None, margin: float
    ) -> None:
        self._shapes = shapes
        self._bounds = bounds
        self._margin = margin
        self._routes: dict[tuple[float, bytes], Routes] = {}

    def plan(self, start: Place, goal: Place, radius: float) -> list[Place]:
        """Return the places to go to one after the other, of which the goal is the last one.

        It is the straight line if nothing at the heights between start and goal is in the way, or
        if there is no way. Else robots go at the greater height, or if that is not possible at the
        lower one.
        """
        low, high = min(start[2], goal[2]), max(start[2], goal[2])
        if self._is_free(start, goal, radius, low, high):
            return [goal]
        for height in dict.fromkeys((high, low)):
            if height != low and self._is_free(start, goal, radius, height, height):
                way: Sequence[Point] | None = ()
            else:
                way = self._at(height, radius).find(start[:2], goal[:2])
            if way is not None:
                return _at_height(way, height, start, goal)
        return [goal]

    def _is_free(self, start: Place, goal: Place, radius: float, low: float, high: float) -> bool:
        if self._shapes.is_empty:
            return True
        first, last = ((np.array([each[0]]), np.array([each[1]])) for each in (start, goal))
        return float(self._shapes.clearances(first, last, low, high)[0]) >= radius

    def _at(self, height: float, radius: float) -> Routes:
        key = radius, self._shapes.standing(height)
        found = self._routes.get(key)
        if found is None:
            found = Routes(self._shapes, height, radius, self._margin, self._bounds)
            self._routes[key] = found
        return found


def _at_height(way: Sequence[Point], height: float, start: Place, goal: Place) -> list[Place]:
    """Return the places of a way at a height, with those where the robot goes up and down."""
    places = [(x, y, height) for x, y in way]
    if start[2] != height:
        places.insert(0, (start[0], start[1], height))
    if goal[2] != height:
        places.append((goal[0], goal[1], height))
    return [*places, goal]
