"""Child processes of tests: signals end them, and so does the timeout of their test."""

from __future__ import annotations

import contextlib
import os
import signal
from collections.abc import Iterator
from pathlib import Path
from types import FrameType
from typing import Any

import pytest

_TASKS = Path("/proc/self/task")


def restore_interrupts() -> None:
    """Handle SIGINT even if the shell ignores it, which it does for what scripts run with `&`.

    Child processes inherit ignored signals: no test could interrupt its child.
    """
    if signal.getsignal(signal.SIGINT) == signal.SIG_IGN:
        signal.signal(signal.SIGINT, signal.default_int_handler)


def children(tasks: Path = _TASKS) -> set[int]:
    """Process ids of the direct children of a process; empty where there is no /proc."""
    found: set[int] = set()
    for file in tasks.glob("*/children"):
        with contextlib.suppress(OSError):  # the thread or the process has just ended
            found.update(map(int, file.read_text().split()))
    return found


def kill(processes: set[int]) -> None:
    """Kill processes and all that they have started."""
    for process in processes:
        below = children(Path(f"/proc/{process}/task"))
        with contextlib.suppress(ProcessLookupError):
            os.kill(process, signal.SIGKILL)
        kill(below)


@pytest.hookimpl(wrapper=True, optionalhook=True)
def pytest_timeout_set_timer(settings: Any) -> Iterator[Any]:
    """Kill the child processes of a test that takes too long, before it fails.

    Its cleanup would wait for them otherwise.
    """
    before = children()
    result = yield
    fail = signal.getsignal(signal.SIGALRM)
    if settings.method == "signal" and callable(fail):

        def end(number: int, frame: FrameType | None) -> None:
            kill(children() - before)
            fail(number, frame)

        signal.signal(signal.SIGALRM, end)
    return result
