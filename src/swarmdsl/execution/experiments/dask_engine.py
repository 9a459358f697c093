"""Executor of a Dask cluster."""

from __future__ import annotations

import logging
from collections.abc import Callable
from concurrent.futures import Executor, Future
from typing import Any

from distributed import Client

from swarmdsl.base.errors import describe_exception
from swarmdsl.execution.experiments.failures import StoppedError

_RETRIES = 5
"""Times that the scheduler gives a task to another worker, after errors of the network."""


class DaskExecutor(Executor):
    """Tasks go to the scheduler at an address; its workers may come and go."""

    def __init__(self, address: str, wait: int) -> None:
        # What a user can do about a lost connection is said once, as a diagnostic.
        for name in ("core", "client", "comm", "utils"):
            logging.getLogger(f"distributed.{name}").setLevel(logging.CRITICAL)
        for name in ("tornado", "tornado.application"):
            logging.getLogger(name).setLevel(logging.CRITICAL)
        try:
            connect: Any = Client
            self._client = connect(address, timeout=wait, set_as_default=False)
            self._client.wait_for_workers(1, timeout=wait)
        # Dask has no class of its own for this: OSError, TimeoutError, ValueError.
        except Exception as error:
            reason = describe_exception(f"connecting to {address}", error)
            help_ = "start a scheduler with `dask scheduler`, and workers with `dask worker`"
            raise StoppedError("no-engine", help_, address=address, reason=reason) from error
        self._inner = self._client.get_executor(pure=False, retries=_RETRIES)

    @property
    def workers(self) -> int:
        """Number of tasks that the workers of this moment run at a time."""
        return sum(self._client.nthreads().values())

    def submit(self, fn: Callable[..., Any], /, *args: Any, **named: Any) -> Future[Any]:
        """Send a task to the cluster."""
        future: Future[Any] = self._inner.submit(fn, *args, **named)
        return future

    def shutdown(self, wait: bool = True, *, cancel_futures: bool = False) -> None:
        """Leave the cluster, which goes on without this program."""
        self._inner.shutdown(wait=wait and not cancel_futures)
        self._client.close()
