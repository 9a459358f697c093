"""Progress of many runs: a bar on a terminal, and lines of JSON for other programs."""

from __future__ import annotations

import json
import sys
import time
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from typing import Any, TextIO

from swarmdsl.execution.experiments.running import Progress
from swarmdsl.execution.experiments.task import Row

Word = Callable[[], str]
"""Says what is best so far."""


class Bar(Progress):
    """A bar with what is done, the best so far, the workers and the time that is left."""

    def __init__(self, bar: Any, expected: int, workers: str, word: Word) -> None:
        self._bar = bar
        self._word = word
        self._workers = workers
        self._task = bar.add_task("", total=expected)

    def begin(self, runs: int, known: int) -> None:
        """Count runs that are known as done."""
        self._show(known)

    def add(self, rows: Sequence[Row]) -> None:
        """Count new runs."""
        self._show(len(rows))

    def _show(self, runs: int) -> None:
        best = self._word()
        said = f"{self._workers}; best so far {best}" if best else self._workers
        self._bar.update(self._task, advance=runs, description=said)


class Feed(Progress):
    """Lines of JSON, each of them complete when it is written; another progress may go on."""

    def __init__(self, stream: TextIO | None, expected: int, inner: Progress) -> None:
        self._stream = stream
        self._expected = expected
        self._inner = inner
        self._done = 0
        self._start = time.monotonic()

    def begin(self, runs: int, known: int) -> None:
        """Tell of runs that are known."""
        self._inner.begin(runs, known)
        self._tell(known)

    def add(self, rows: Sequence[Row]) -> None:
        """Tell of new runs."""
        self._inner.add(rows)
        self._tell(len(rows))

    def say(self, event: str, **data: Any) -> None:
        """Write a line."""
        if self._stream is not None:
            self._stream.write(f"{json.dumps({'event': event, **data})}\n")
            self._stream.flush()

    def _tell(self, runs: int) -> None:
        self._done += runs
        if runs:
            seconds = round(time.monotonic() - self._start, 3)
            self.say("runs", done=self._done, expected=self._expected, seconds=seconds)


@contextmanager
def shown(expected: int, workers: str, word: Word) -> Iterator[Progress]:
    """Show a bar on a terminal, and nothing elsewhere."""
    if not sys.stderr.isatty():
        yield Progress()
        return
    from rich.console import Console
    from rich.progress import BarColumn, MofNCompleteColumn, TextColumn, TimeRemainingColumn
    from rich.progress import Progress as RichProgress

    columns = (BarColumn(20), MofNCompleteColumn(), TimeRemainingColumn())
    text = TextColumn("{task.description}", markup=False)
    with RichProgress(*columns, text, console=Console(stderr=True), transient=True) as bar:
        yield Bar(bar, expected, workers, word)
