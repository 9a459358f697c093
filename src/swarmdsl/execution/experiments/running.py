"""Run tasks on an engine: rows in the order of the tasks, whoever does them."""

from __future__ import annotations

import os
from collections.abc import Iterator, Mapping, Sequence
from concurrent.futures import (
    FIRST_COMPLETED,
    BrokenExecutor,
    CancelledError,
    Future,
    wait,
)
from contextlib import suppress
from typing import Any

from swarmdsl import __version__
from swarmdsl.base.errors import describe_exception
from swarmdsl.base.records import replace
from swarmdsl.execution.experiments.blocks import Pace
from swarmdsl.execution.experiments.engines import Engine
from swarmdsl.execution.experiments.failures import StoppedError
from swarmdsl.execution.experiments.shipment import Shipment
from swarmdsl.execution.experiments.store import Key, Store
from swarmdsl.execution.experiments.task import Row, Task, row_of
from swarmdsl.execution.experiments.waiting import Block, Waiting
from swarmdsl.execution.experiments.worker import LIMIT, failed, work

_MOST_LOSSES = 3
"""Losses of workers, one after the other without a result between, before the runs end."""
_AHEAD = 2
"""Tasks that wait for each worker, so that none of them waits for this process."""

_SAME = "install the same version of swarmdsl on all computers"


class Progress:
    """Progress of the runs as a user sees it; this one shows nothing."""

    def begin(self, runs: int, known: int) -> None:
        """Begin so many runs, of which some are known."""

    def add(self, rows: Sequence[Row]) -> None:
        """Note new rows, in the order in which they come."""


class Runs:
    """Runs of some models, by digest, on an engine; what the store has is not run again."""

    def __init__(
        self,
        shipments: Mapping[str, Shipment],
        engine: Engine,
        store: Store,
        progress: Progress | None = None,
        limit: float | None = None,
    ) -> None:
        self._shipments = {digest: each.as_data() for digest, each in shipments.items()}
        self._texts = {
            (digest, name): each.scenario_digest(name)
            for digest, each in shipments.items()
            for name in (*each.scenarios, "")
        }
        self._engine = engine
        self._store = store
        self._progress = progress or Progress()
        self._limit = limit
        self._pace = Pace()
        self._is_beginning = engine.is_slow
        self.ran = 0
        """Number of runs that were not in the store."""

    def run(self, tasks: Sequence[Task]) -> list[list[Row]]:
        """Return the rows of each task, in the order of its seeds. Raises StoppedError."""
        wanted: dict[Task, dict[int, None]] = {}
        for task in tasks:
            wanted.setdefault(replace(task, seeds=()), {}).update(dict.fromkeys(task.seeds))
        whole = [replace(task, seeds=tuple(seeds)) for task, seeds in wanted.items()]
        found = {
            runs: self._store.rows(task, self._key(task))
            for runs, task in zip(wanted, whole, strict=True)
        }
        known = sum(map(len, found.values()))
        total = sum(map(len, wanted.values()))
        self._progress.begin(total, known)
        missing = [
            replace(task, seeds=tuple(seed for seed in task.seeds if seed not in rows))
            for task, rows in zip(whole, found.values(), strict=True)
        ]
        for task, rows in self._work(missing):
            found[replace(task, seeds=())].update((row.seed, row) for row in rows)
        return [[found[replace(task, seeds=())][seed] for seed in task.seeds] for task in tasks]

    def known(self, tasks: Sequence[Task]) -> list[list[Row]]:
        """Return the rows of each task that the store has, after an interruption for instance."""
        found = [self._store.rows(task, self._key(task)) for task in tasks]
        return [[rows[seed] for seed in sorted(rows)] for rows in found]

    def _work(self, tasks: Sequence[Task]) -> Iterator[tuple[Task, list[Row]]]:
        """Yield rows as workers bring them."""
        workers = self._engine.workers
        waiting = Waiting(tasks, self._pace, workers)
        running: dict[Future[Any], Block] = {}
        losses = 0
        while waiting or running:
            most = workers * (1 if self._is_beginning else 1 + _AHEAD)
            while block := waiting.next(len(running), most):
                try:
                    running[self._submit(tasks[block.number], block.seeds)] = block
                except BrokenExecutor:
                    waiting.put_back([block])
                    break
            # Workers take a while to begin; first results are here sooner.
            while self._is_beginning and not any(each.done() for each in running):
                block = waiting.next(0, 1)
                if block is None:
                    break
                task = tasks[block.number]
                yield task, self._rows(task, work(*self._work_of(task, block.seeds)))
            self._is_beginning = False
            done, _ = wait(running, return_when=FIRST_COMPLETED)
            lost: list[Block] = []
            is_lost = not running
            for future in sorted(done, key=lambda each: running[each]):
                block = running.pop(future)
                task = tasks[block.number]
                try:
                    answer = future.result()
                except (BrokenExecutor, CancelledError):
                    lost.append(block)
                    continue
                # Of the executor: a task that was given to lost workers too often, for instance.
                except Exception as error:
                    _refuse_import(error)
                    waiting.put_back([block])
                    losses = self._lose(losses, describe_exception("a task", error))
                    continue
                losses = 0
                yield task, self._rows(task, answer)
            if lost or is_lost:
                blamed = waiting.lost([*lost, *running.values()])
                running.clear()
                self._renew()
                if blamed is not None:
                    task = tasks[blamed.number]
                    yield task, self._rows(task, self._ended(blamed.seeds))

    def _renew(self) -> None:
        """Start the workers again. Raises StoppedError if they end without a run too."""
        losses = 0
        while True:
            losses = self._lose(losses, "a process ended by itself")
            self._engine.stop(is_hurried=True)
            with suppress(BrokenExecutor, CancelledError):
                try:
                    self._engine.executor.submit(os.getpid).result()
                except StoppedError as stopped:
                    help_ = "what was kept is safe: start the engine, and go on with `--resume`"
                    raise StoppedError(stopped.name, help_, **stopped.fields) from stopped
                return

    def _ended(self, seeds: Sequence[int]) -> dict[str, Any]:
        """Return the answer of a worker about runs that end it."""
        limit = self._limit if self._limit is not None else LIMIT
        reason = f"its process ends, or it does not return within {limit:g} s"
        return {
            "rows": [failed(seed, reason) for seed in seeds],
            "seconds": 0.0,
            "batch": 1,
            "worker": "",
        }

    def _submit(self, task: Task, seeds: Sequence[int]) -> Future[Any]:
        return self._engine.executor.submit(work, *self._work_of(task, seeds))

    def _work_of(self, task: Task, seeds: Sequence[int]) -> tuple[dict[str, Any], dict[str, Any]]:
        """Return the arguments of `work`."""
        data: dict[str, Any] = {
            "scenario": task.scenario,
            "candidate": task.candidate.values,
            "seeds": list(seeds),
            "main": os.getpid(),
        }
        if self._limit is not None:
            data["limit"] = self._limit
        return self._shipments[task.digest], data

    def _rows(self, task: Task, answer: Mapping[str, Any]) -> list[Row]:
        """Keep the rows of an answer, and return them."""
        if "refused" in answer:
            raise StoppedError("worker-refuses", _SAME, reason=answer["refused"])
        data, seconds = answer["rows"], answer["seconds"]
        rows = [row_of(task, each, seconds / len(data)) for each in data]
        self._pace.note(f"{task.digest} {task.scenario}", len(rows), seconds, answer["batch"])
        self._store.add(self._key(task), rows, str(answer["worker"]))
        self.ran += len(rows)
        self._progress.add(rows)
        return rows

    def _key(self, task: Task) -> Key:
        text = self._texts[task.digest, task.scenario]
        return Key(task.digest, task.scenario, text, task.candidate)

    def _lose(self, losses: int, reason: str) -> int:
        """Return the new number of losses; raise StoppedError if there are too many."""
        if losses >= _MOST_LOSSES:
            help_ = (
                "the runs that are done are kept: try fewer `--jobs`, so that each has more "
                "memory, and `--resume`"
            )
            raise StoppedError("lost-workers", help_, reason=reason, times=losses + 1)
        return losses + 1


def _refuse_import(error: BaseException) -> None:
    """Raise StoppedError if a task failed because a computer has not this package, or an old one.

    A scheduler of Dask reads tasks too, and gives what it fails with as a cause.
    """
    cause: BaseException | None = error
    while cause is not None:
        if isinstance(cause, ImportError) and (cause.name or "").partition(".")[0] == "swarmdsl":
            reason = f"one of the cluster has no swarmdsl {__version__}: {cause}"
            raise StoppedError("worker-refuses", _SAME, reason=reason) from error
        cause = cause.__cause__
