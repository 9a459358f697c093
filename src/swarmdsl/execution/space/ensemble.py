"""Flat spaces of some runs that move on together, step by step."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from swarmdsl.execution.engine import LoopError
from swarmdsl.execution.space.arrays import Whole
from swarmdsl.execution.space.flat import NOTHING, FlatSpace, Happened
from swarmdsl.execution.space.setting import Setting
from swarmdsl.execution.space.shared_stage import Key, SharedStage


class Ensemble(SharedStage):
    """Spaces of some runs with the same setting.

    Alone, a space moves on when its time has come. Together, it is `due` then, and waits until
    somebody calls `advance`: one step of NumPy for all that are due.
    """

    def __init__(self, setting: Setting, seeds: Sequence[int], *, together: bool = False) -> None:
        super().__init__(setting, seeds)
        self.together = together
        self._links: Whole | None = None
        """Radio links after the step before."""
        advance = None if together else self.advance
        self.spaces = [FlatSpace(self, run, advance) for run in range(len(seeds))]

    def advance(self) -> None:
        """Move on all spaces that are due, and let their worlds know what happens.

        Go on while nothing else can happen in any of them.
        """
        due = [space for space in self.spaces if space.due]
        while due:
            self._step(due)
            if not all(space.due for space in due):
                return

    def _step(self, due: Sequence[FlatSpace]) -> None:
        """Do one step of some spaces, which stay due if they must do nothing but the next one."""
        stage = self.stage
        numbers = [space.number for space in due]
        stage.ticks[numbers] = [space.step_number for space in due]
        part = stage.rows_of(numbers)
        ended: list[tuple[int, Key, int]] = []
        functions = list(self.functions.items())
        for key, running in functions:
            ended += [(row, key, status) for row, status in running.step(part)]
        empty = stage.move(part)
        self.links.moved()
        for space in due:
            for viewer in space.viewers:
                viewer.moved(space.step_number * stage.step_length)
        for key, running in functions:
            ended += [(row, key, status) for row, status in running.contacts()]
        seen = stage.eyes.look(part) if stage.eyes.is_needed else []
        links = self._changed_links() if any(space.follows_links for space in due) else None
        first: dict[tuple[int, Key], int] = {}
        for row, key, status in ended:
            first.setdefault((row, key), status)
        happened: dict[int, Happened] = {}
        for row in empty.tolist():
            _in_run(happened, row // stage.robots).empty.append(row)
        for sighting in seen:
            _in_run(happened, sighting.row // stage.robots).seen.append(sighting)
        for (row, key), status in sorted(first.items()):
            _in_run(happened, row // stage.robots).ended.append((row, key, status))
        for space in due:
            if space.number not in happened and links is None and space.goes_on():
                continue
            space.due = False
            try:
                space.react(happened.get(space.number, NOTHING), links)
            except LoopError as error:
                if not self.together:
                    raise
                space.failure = error

    def _changed_links(self) -> Whole | None:
        """Return who reaches whom, or None if that is as after the step before."""
        links = self.links.within()
        if self._links is not None and np.array_equal(links, self._links):
            return None
        self._links = links
        return links


def _in_run(happened: dict[int, Happened], run: int) -> Happened:
    found = happened.get(run)
    if found is None:
        found = happened[run] = Happened([], [], [])
    return found
