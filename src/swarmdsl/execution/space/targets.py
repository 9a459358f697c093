"""Targets in a space: where they are, who carries them, and which have been seen."""

from __future__ import annotations

import numpy as np

from swarmdsl.execution.space.arrays import Flags, Floats, Whole
from swarmdsl.execution.space.hashing import key
from swarmdsl.execution.space.layout import Layout
from swarmdsl.execution.space.placing import places_in
from swarmdsl.execution.space.shapes import Shapes
from swarmdsl.ir.space import target_names

NOBODY = -1


class TargetsOfRuns:
    """All targets of all runs; those of a run are side by side, in the order of the model."""

    def __init__(self, layout: Layout, shapes: Shapes, seeds: tuple[int, ...]) -> None:
        self.kinds = list(dict.fromkeys(each.kind for each in layout.targets))
        kinds = [self.kinds.index(each.kind) for each in layout.targets for _ in range(each.count)]
        self.names = target_names(layout.targets)
        self.count = len(self.names)
        """Number of targets in a run."""
        total = self.count * len(seeds)
        self.run: Whole = np.repeat(np.arange(len(seeds)), self.count)
        self.kind: Whole = np.tile(np.array(kinds, dtype=np.int64), len(seeds))
        self.x: Floats = np.zeros(total)
        self.y: Floats = np.zeros(total)
        self.z: Floats = np.zeros(total)
        self.carrier: Whole = np.full(total, NOBODY)
        """Row of the robot that carries it."""
        self.taken: Flags = np.zeros(total, dtype=np.bool_)
        """True for one that is not there any more."""
        self.seen: Flags = np.zeros(total, dtype=np.bool_)
        """True for one that a robot has seen."""
        self._place(layout, shapes, seeds)

    def _place(self, layout: Layout, shapes: Shapes, seeds: tuple[int, ...]) -> None:
        first = 0
        for each in layout.targets:
            for number in range(each.count):
                here = np.arange(len(seeds)) * self.count + first
                if each.places:
                    point = each.places[number % len(each.places)]
                    self.x[here], self.y[here] = point.x, point.y
                else:
                    name = self.names[first]
                    keys = np.array([key(seed, "target", name) for seed in seeds], dtype=np.uint64)
                    bounds = layout.bounds(each.area) or (0.0, 0.0, 0.0, 0.0)
                    radius = np.zeros(len(seeds))
                    self.x[here], self.y[here] = places_in(bounds, keys, radius, shapes)
                first += 1

    def follow(self, x: Floats, y: Floats, z: Floats) -> None:
        """Let targets be where those who carry them are."""
        if not self.count:
            return
        carried = np.flatnonzero(self.carrier >= 0)
        if len(carried):
            by = self.carrier[carried]
            self.x[carried], self.y[carried], self.z[carried] = x[by], y[by], z[by]

    def release(self, row: int) -> None:
        """Leave all that a robot carries on the ground, where it is."""
        held = self.carrier == row
        self.carrier[held] = NOBODY
        self.z[held] = 0.0

    def of_run(self, run: int) -> list[tuple[str, tuple[float, float, float], bool]]:
        """Return name and place of the targets of a run, and whether somebody has seen each."""
        first = run * self.count
        return [
            (name, (float(self.x[at]), float(self.y[at]), float(self.z[at])), bool(self.seen[at]))
            for at, name in enumerate(self.names, first)
        ]

    def found(self, kind: str, run: int) -> int:
        """Return the number of targets of a kind that somebody has seen in a run."""
        if kind not in self.kinds:
            return 0
        of = (self.kind == self.kinds.index(kind)) & (self.run == run)
        return int(np.count_nonzero(self.seen & of))
