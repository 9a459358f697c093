"""Blocks of runs that wait for a worker, and those whose worker ended by itself.

A process of a pool does not say which of its tasks ended it. The runs of all tasks that were lost
with it run again one at a time: the one that ends its process then is to blame.
"""

from __future__ import annotations

from collections import deque
from collections.abc import Iterable, Sequence
from typing import NamedTuple

from swarmdsl.execution.experiments.blocks import Pace, cut
from swarmdsl.execution.experiments.task import Task


class Block(NamedTuple):
    """A part of a task, by the number of this. A suspect is a run that was lost before."""

    number: int
    seeds: list[int]
    is_suspect: bool = False


class Waiting:
    """Parts of tasks that are to be run."""

    def __init__(self, tasks: Sequence[Task], pace: Pace, workers: int) -> None:
        self._tasks = tasks
        self._pace = pace
        self._workers = workers
        self._rest = deque(
            Block(number, list(task.seeds)) for number, task in enumerate(tasks) if task.seeds
        )
        self._left = sum(len(task.seeds) for task in tasks)
        self._suspects: deque[Block] = deque()

    def __bool__(self) -> bool:
        return bool(self._rest or self._suspects)

    def next(self, running: int, most: int) -> Block | None:
        """Return a block to run beside so many others; None if they are as many as can be."""
        if self._suspects:
            return None if running else self._suspects.popleft()
        return self._next() if running < most and self._rest else None

    def put_back(self, blocks: Iterable[Block]) -> None:
        """Take back blocks that are not to blame, to be run first."""
        for each in reversed(list(blocks)):
            self._left += len(each.seeds)
            self._rest.appendleft(each)

    def lost(self, blocks: Sequence[Block]) -> Block | None:
        """Take back blocks that were lost together; return the run to blame if it is known."""
        if len(blocks) == 1 and blocks[0].is_suspect:
            return blocks[0]
        self._suspects.extend(
            Block(each.number, [seed], True) for each in sorted(blocks) for seed in each.seeds
        )
        return None

    def _next(self) -> Block:
        """Cut the next block; at the end, each worker gets a share."""
        number, seeds, _ = self._rest.popleft()
        share = max(self._left // (self._workers * 2), 1)
        task = self._tasks[number]
        size = self._pace.size(f"{task.digest} {task.scenario}")
        first, rest = cut(seeds, size if self._rest else min(size, share))
        if rest:
            self._rest.appendleft(Block(number, rest))
        self._left -= len(first)
        return Block(number, first)
