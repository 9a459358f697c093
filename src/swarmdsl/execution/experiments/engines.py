"""Engines: what runs tasks, as executors of `concurrent.futures`.

Packages add engines as entry points of the group `swarmdsl.executors`: a function from the address
behind `NAME://` to an executor.
"""

from __future__ import annotations

import os
import signal
from collections.abc import Callable
from concurrent.futures import Executor, Future, ProcessPoolExecutor
from importlib.metadata import entry_points
from importlib.util import find_spec
from multiprocessing import get_context, parent_process
from threading import Thread
from typing import Any

from swarmdsl.base.errors import describe_exception
from swarmdsl.base.suggest import suggest
from swarmdsl.execution.experiments.failures import StoppedError

GROUP = "swarmdsl.executors"
_DASK = ("tcp", "tls", "ucx")
_FOREIGN_WORKERS = 8
"""Tasks at a time, for executors that do not have a number of `workers`."""
_PIPE = getattr(signal, "SIGPIPE", None)
_WAIT = 10
"""Seconds to look for a scheduler and for a worker."""


class Engine:
    """An executor that is started when it is needed, and again after its processes were lost.

    In its block, a process or a connection that has gone is an error, and does not end this process
    by SIGPIPE.
    """

    def __init__(
        self, name: str, start: Callable[[], Executor], workers: int, *, is_slow: bool = False
    ) -> None:
        self.name = name
        self.is_slow = is_slow
        """True if this process could do some tasks before the workers have begun."""
        self._start = start
        self._workers = workers
        self._executor: Executor | None = None
        self._on_pipe: Any = None

    def __enter__(self) -> Engine:
        if _PIPE is not None:
            self._on_pipe = signal.signal(_PIPE, signal.SIG_IGN)
        return self

    def __exit__(self, kind: type[BaseException] | None, *_: object) -> None:
        self.stop(is_hurried=kind is not None)
        if _PIPE is not None:
            signal.signal(_PIPE, self._on_pipe)

    @property
    def workers(self) -> int:
        """Number of tasks that run at a time."""
        return max(int(getattr(self.executor, "workers", self._workers)), 1)

    @property
    def executor(self) -> Executor:
        """The executor."""
        if self._executor is None:
            self._executor = self._start()
        return self._executor

    def stop(self, *, is_hurried: bool = False) -> None:
        """End the workers; without waiting for their tasks if `is_hurried`."""
        executor, self._executor = self._executor, None
        if executor is None:
            return
        processes = list((getattr(executor, "_processes", None) or {}).values())
        if is_hurried:
            for process in processes:
                process.terminate()
        executor.shutdown(wait=True, cancel_futures=True)


def engine_of(address: str | None, jobs: int, *, is_apart: bool) -> Engine:
    """Return the engine of a cluster at an address; without one, that of this computer."""
    return cluster(address) if address is not None else local(jobs, is_apart=is_apart)


def local(jobs: int, *, is_apart: bool = False) -> Engine:
    """Return the engine with processes of this computer; one job is this process.

    With `is_apart`, nothing runs in this process: runs may end theirs.
    """
    if jobs == 1 and not is_apart:
        return Engine("this process", Inline, 1)
    # Processes that are not copies of this one are the same on each platform.
    return Engine(
        f"{jobs} processes" if jobs > 1 else "1 process",
        lambda: ProcessPoolExecutor(jobs, get_context("spawn"), _begin_worker),
        jobs,
        is_slow=not is_apart,
    )


def cluster(address: str) -> Engine:
    """Return the engine of a cluster at an address."""
    kind, _, rest = address.partition("://")
    points = {point.name: point for point in entry_points(group=GROUP)}
    if kind in points:
        return Engine(
            address, lambda: _foreign(points[kind].load(), address, rest), _FOREIGN_WORKERS
        )
    if not rest or kind not in _DASK:
        help_ = suggest(kind, (*_DASK, *points), "kinds")
        reason = "it begins with no kind of engine"
        raise StoppedError("no-engine", help_, address=address, reason=reason)
    if find_spec("distributed") is None:
        help_ = "`pip install 'swarmdsl[cluster]'` installs it"
        raise StoppedError("no-engine", help_, address=address, reason="there is no Dask here")
    from swarmdsl.execution.experiments.dask_engine import DaskExecutor

    return Engine(address, lambda: DaskExecutor(address, _WAIT), 1)


class Inline(Executor):
    """Executor that runs each task at once, in this process."""

    workers = 1

    def submit(self, fn: Callable[..., Any], /, *args: Any, **named: Any) -> Future[Any]:
        """Run a task; return its result."""
        future: Future[Any] = Future()
        try:
            future.set_result(fn(*args, **named))
        except Exception as error:
            future.set_exception(error)
        return future


def _foreign(make: Callable[[str], Executor], address: str, rest: str) -> Executor:
    try:
        return make(rest)
    # The code of a third-party package.
    except Exception as error:
        reason = describe_exception(f"starting the engine {address}", error)
        raise StoppedError("no-engine", None, address=address, reason=reason) from error


def _begin_worker() -> None:
    """Leave interrupts to the main process, and end with it."""
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    Thread(target=_end_with_parent, daemon=True).start()


def _end_with_parent() -> None:
    parent = parent_process()
    assert parent is not None
    parent.join()
    # Killed: there is nobody to give the results to.
    os._exit(1)
