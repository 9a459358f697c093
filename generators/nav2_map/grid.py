"""Grid of cells of an environment, each free or occupied.

A cell is occupied if anything reaches into it: a robot that keeps to free cells touches nothing.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from itertools import pairwise

from swarmdsl.ir import Box, Disc, Environment, Point, Shape

from ..environments.bounds import Bounds

# A shorter reach into a cell, in cells, does not count: sums of decimal numbers are not exact.
_SLACK = 1e-6
# Gray values of free and occupied cells, as map savers of ROS write them.
_VALUES = {0: "254 ", 1: "0 "}
# A line of a plain PGM has at most 70 characters.
_IN_A_LINE = 17

Range = tuple[float, float]


class Grid:
    """Cells in columns from the left and rows from the bottom."""

    def __init__(self, bounds: Bounds, resolution: float) -> None:
        self.resolution = resolution
        self.columns = max(1, math.ceil(bounds.width / resolution - _SLACK))
        self.rows = max(1, math.ceil(bounds.depth / resolution - _SLACK))
        self._left, self._bottom = bounds.left, bounds.bottom
        # Rows that are not all free, by number.
        self._cells: dict[int, bytearray] = {}

    @property
    def cells(self) -> int:
        """Number of cells."""
        return self.columns * self.rows

    def fill(
        self, environment: Environment, thickness: float, below: float | None, *, zones: bool
    ) -> None:
        """Occupy the cells of walls and of what begins not above a height."""
        for wall in environment.walls:
            for start, end in pairwise(wall.points):
                self._occupy(_Part(start, end, thickness / 2))
        shapes: list[Shape] = [each.shape for each in environment.obstacles]
        shapes += [each.box for each in environment.zones] if zones else []
        for shape in shapes:
            match shape:
                case Box(low=low, high=high, lowest=lowest):
                    if below is None or lowest < below:
                        self._occupy(_Rectangle(low, high))
                case Disc(centre=centre, radius=radius):
                    self._occupy(_Circle(centre, radius))

    def pgm(self) -> str:
        """Return the image as plain PGM, from the top row down."""
        texts: dict[bytes, str] = {}
        return "".join(self._lines(texts))

    def _lines(self, texts: dict[bytes, str]) -> Iterator[str]:
        yield f"P2\n{self.columns} {self.rows}\n255\n"
        free = bytes(self.columns)
        for row in reversed(range(self.rows)):
            cells = bytes(self._cells.get(row, free))
            if cells not in texts:
                texts[cells] = _row(cells)
            yield texts[cells]

    def _occupy(self, figure: _Figure) -> None:
        low, high = figure.heights
        for row in self._numbers((low, high), self._bottom, self.rows):
            strip = (
                self._bottom + row * self.resolution,
                self._bottom + (row + 1) * self.resolution,
            )
            found = figure.across(max(strip[0], low), min(strip[1], high))
            columns = self._numbers(found, self._left, self.columns)
            if columns:
                cells = self._cells.setdefault(row, bytearray(self.columns))
                cells[columns.start : columns.stop] = b"\1" * len(columns)

    def _numbers(self, reach: Range, origin: float, most: int) -> range:
        """Return the numbers of the rows or columns that a figure reaches into."""
        first = math.floor((reach[0] - origin) / self.resolution + _SLACK)
        last = math.ceil((reach[1] - origin) / self.resolution - _SLACK)
        return range(min(max(first, 0), most), max(min(last, most), 0))


class _Rectangle:
    """Rectangle along the axes."""

    def __init__(self, low: Point, high: Point) -> None:
        self.heights = (low.y, high.y)
        self._reach = (low.x, high.x)

    def across(self, low: float, high: float) -> Range:
        """Return the reach along x of what is between two heights inside `heights`."""
        return self._reach


class _Circle:
    """Circle with its inside."""

    def __init__(self, centre: Point, radius: float) -> None:
        self.heights = (centre.y - radius, centre.y + radius)
        self._centre, self._radius = centre, radius

    def across(self, low: float, high: float) -> Range:
        """Return the reach along x of what is between two heights inside `heights`."""
        nearest = min(max(self._centre.y, low), high) - self._centre.y
        half = math.sqrt(max(self._radius**2 - nearest**2, 0.0))
        return self._centre.x - half, self._centre.x + half


class _Part:
    """Part of a wall: all that is not farther than `radius` from a line, with round ends."""

    def __init__(self, start: Point, end: Point, radius: float) -> None:
        self.heights = (min(start.y, end.y) - radius, max(start.y, end.y) + radius)
        self._ends = (_Circle(start, radius), _Circle(end, radius))
        length = math.hypot(end.x - start.x, end.y - start.y) or 1.0
        x, y = -(end.y - start.y) / length * radius, (end.x - start.x) / length * radius
        self._corners = (
            (start.x + x, start.y + y),
            (end.x + x, end.y + y),
            (end.x - x, end.y - y),
            (start.x - x, start.y - y),
        )

    def across(self, low: float, high: float) -> Range:
        """Return the reach along x of what is between two heights inside `heights`."""
        found = list(self._in_strip(low, high))
        for circle in self._ends:
            bottom, top = circle.heights
            if bottom <= high and low <= top:
                found += circle.across(max(low, bottom), min(high, top))
        return min(found), max(found)

    def _in_strip(self, low: float, high: float) -> Iterator[float]:
        """Yield x of each corner in a strip, and of each side where it crosses its borders."""
        for (x, y), (next_x, next_y) in pairwise((*self._corners, self._corners[0])):
            if low <= y <= high:
                yield x
            for border in (low, high):
                if min(y, next_y) < border < max(y, next_y):
                    yield x + (next_x - x) * (border - y) / (next_y - y)


_Figure = _Rectangle | _Circle | _Part


def _row(cells: bytes) -> str:
    text = cells.decode("latin-1")
    parts = (text[at : at + _IN_A_LINE] for at in range(0, len(text), _IN_A_LINE))
    return "".join(f"{part.translate(_VALUES).rstrip()}\n" for part in parts)
