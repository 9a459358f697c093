"""Ends of links on the sides of cells: their order, and where they may be."""

from __future__ import annotations

from bisect import bisect_left
from collections.abc import Iterator, Sequence

from swarmdsl.tools.diagram.layout.layered_graph import Cell, End, Layers, Side

END_GAP = 12
"""Preferred distance between two ends on one side of a cell."""
_CORNER = 5
_BEYOND, _SMALL = 2, 14
"""Distance that an end may go beyond its bounds, and the size of the bend that this avoids."""
_NARROW = 24
"""Extent of a side without corners that ends must avoid."""
_LEAST_ZONE = 4
"""Extent below which ends do not go between two barred parts."""


class CellSide:
    """Ends of links on one side of a cell, in order, with their possible positions."""

    def __init__(self, cell: Cell, side: Side, found: Sequence[tuple[End, End, int]]) -> None:
        fixed = [each for each in found if each[0].at is not None]
        fixed.sort(key=lambda each: each[0].at or 0)
        free = [each for each in found if each[0].at is None]
        free.sort(key=lambda each: _order(each[1], each[0]))
        merged = list(fixed)
        orders = sorted(_order(other, end) for end, other, _ in fixed)
        for number, each in enumerate(free):
            # Insert it between fixed ends so that it crosses none.
            merged.insert(bisect_left(orders, _order(each[1], each[0])) + number, each)
        self.ends = [end for end, _, _ in merged]
        self.others = [other for _, other, _ in merged]
        self.links = [link for _, _, link in merged]
        self._movable = [end.at is None for end in self.ends]
        self._cell = cell
        self._barred = sorted(
            (low, high) for low, high, where in cell.barred if where in (None, side)
        )
        self.runs: list[tuple[range, int, int, int]] = []
        """Ranges of ends that can move, with their bounds and their least distance."""

    def spread(self) -> None:
        """Space the ends evenly where they may be."""
        for run, bottom, top in self._between_fixed():
            for part, low, high in self._zones(run, bottom, top):
                count, room = len(part), high - low
                for number, at in enumerate(part, 1):
                    self.ends[at].at = low + room * number // (count + 1)
                gap = min(END_GAP, room // (count + 1))
                corner = min(_CORNER, room // (count + 1))
                corners = [corner if at in (bottom, top) else 0 for at in (low, high)]
                if self._cell.high - self._cell.low < _NARROW:
                    gap = min(END_GAP, room // max(count - 1, 1))
                    corners = [0, 0]
                    slack = (room - gap * (count - 1)) // 2
                    for number, at in enumerate(part):
                        self.ends[at].at = low + slack + gap * number
                if room:
                    self.runs.append((part, low + corners[0], high - corners[1], gap))

    def straighten(self) -> None:
        """Move ends slightly beyond what is preferred if that avoids a small bend."""
        for run, low, high, gap in self.runs:
            least = min(gap, END_GAP * 2 // 3)
            narrow = self._cell.high - self._cell.low < _NARROW
            beyond = 0 if narrow else _BEYOND
            for at in run:
                end, other = self.ends[at], self.others[at]
                assert end.at is not None
                straight = other.across - end.vertex.across
                if not 0 < abs(straight - end.at) < _SMALL:
                    continue
                below = self.ends[at - 1].at if at > run.start else None
                above = self.ends[at + 1].at if at + 1 < run.stop else None
                bottom = low - beyond if below is None else below + least
                top = high + beyond if above is None else above - least
                if bottom <= straight <= top:
                    end.at = straight

    def _between_fixed(self) -> Iterator[tuple[range, int, int]]:
        """Ranges of adjacent movable ends, with their lower and upper bounds."""
        start = 0
        bottom = self._cell.low
        for at in range(len(self.ends) + 1):
            if at < len(self.ends) and self._movable[at]:
                continue
            top = self._cell.high if at == len(self.ends) else (self.ends[at].at or 0)
            if start < at:
                yield range(start, at), bottom, max(top, bottom)
            start = at + 1
            bottom = max(top, bottom)

    def _zones(self, run: range, bottom: int, top: int) -> Iterator[tuple[range, int, int]]:
        """Divide a range of ends between the zones that are not barred, in order."""
        zones = []
        low = bottom
        for barred, free in (*self._barred, (top, top)):
            if min(barred, top) - low >= _LEAST_ZONE:
                zones.append((low, min(barred, top)))
            low = max(low, free)
        if len(zones) < 2:
            yield run, *(zones[0] if zones else (bottom, top))
            return
        even = [bottom + (top - bottom) * at // (len(run) + 1) for at in range(1, len(run) + 1)]
        start = 0
        for number, (low, high) in enumerate(zones):
            limit = (high + zones[number + 1][0]) // 2 if number + 1 < len(zones) else top
            most = (high - low) // (END_GAP // 2)
            stop = start
            while stop < len(run) and (
                number + 1 == len(zones) or (even[stop] <= limit and stop - start < most)
            ):
                stop += 1
            if stop > start:
                yield run[start:stop], low, high
            start = stop


def _order(end: End, here: End) -> tuple[int, int, int]:
    """Place of the other end of a segment among those that begin here.

    Segments that turn go around all others on their side, those to far places around the rest.
    """
    if end.side != here.side:
        return 0, end.vertex.order, end.at or 0
    beyond = 1 if end.vertex.order > here.vertex.order else -1
    return beyond, -end.vertex.order, -(end.at or 0)


def cell_sides(layers: Layers, cells: Sequence[Cell]) -> list[CellSide]:
    """Return the ends of links for each side of each cell."""
    found: dict[tuple[int, Side], list[tuple[End, End, int]]] = {}
    for segment in layers.segments:
        for end, other in ((segment.start, segment.end), (segment.end, segment.start)):
            if end.vertex.cell is not None:
                key = (end.vertex.cell, end.side)
                found.setdefault(key, []).append((end, other, segment.link))
    return [CellSide(cells[cell], side, ends) for (cell, side), ends in found.items()]
