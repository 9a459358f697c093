"""Bid for a task: the nearest robot gets it."""

from __future__ import annotations

import math

import numpy as np

from swarmdsl.execution.space.arrays import Rows, Small
from swarmdsl.execution.space.functions.base import Arguments, Finding, Model, Place, statuses
from swarmdsl.execution.space.stage import Stage


class Bid(Model):
    """Wait for the bids of others; done for the robot that is nearest to the task, else aborted.

    Bids for the same task of the same role count. A task with a name is given away once.
    """

    stops_on_contact = False

    def __init__(self, stage: Stage) -> None:
        super().__init__(stage)
        self._left = np.zeros(stage.rows)
        self._offers: dict[int, tuple[str, Place, float]] = {}
        """Task, its place and its distance, for each robot that bids."""
        self._given: set[tuple[int, int, str]] = set()

    def start(self, who: Rows, arguments: Arguments) -> None:
        """Note the task, and how far it is."""
        stage, task = self.stage, arguments["task_id"] or ""
        self._left[who] = arguments["time"]
        for row in who.tolist():
            here = float(stage.x[row]), float(stage.y[row])
            place = arguments["to"] or (*here, 0.0)
            dx, dy = place[0] - here[0], place[1] - here[1]
            self._offers[row] = task, place, math.sqrt(dx * dx + dy * dy)

    def step(self, who: Rows, dt: float) -> Small:
        """Wait; then the nearest robot gets the task, of equal ones that with the least number."""
        stage = self.stage
        stage.halt(who)
        self._left[who] -= dt
        over = self._left[who] < dt / 2
        done = np.zeros(len(who), dtype=np.bool_)
        for number in np.flatnonzero(over).tolist():
            row = int(who[number])
            task, _, way = self._offers[row]
            key = int(stage.run[row]), int(stage.role[row]), task
            if key not in self._given and (way, row) == min(self._rivals(row)):
                done[number] = True
                if task:
                    self._given.add(key)
        return statuses(done, over & ~done)

    def stop(self, who: Rows) -> None:
        """Take bids back."""
        for row in who.tolist():
            self._offers.pop(row, None)

    def result(self, row: int) -> Finding:
        """Return the task, and where it is."""
        task, place, _ = self._offers[row]
        return Finding(place, id=task)

    def _rivals(self, row: int) -> list[tuple[float, int]]:
        """Return how far all robots are that bid for the task of a robot, and which they are."""
        stage, task = self.stage, self._offers[row][0]
        return [
            (way, other)
            for other, (same, _, way) in self._offers.items()
            if same == task
            and stage.run[other] == stage.run[row]
            and stage.role[other] == stage.role[row]
        ]
