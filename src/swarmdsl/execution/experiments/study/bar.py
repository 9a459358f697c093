"""Progress of the runs of a study, on a terminal."""

from __future__ import annotations

import sys
from collections.abc import Sequence
from contextlib import ExitStack
from typing import TYPE_CHECKING

from swarmdsl.execution.experiments.running import Progress
from swarmdsl.execution.experiments.task import Row

if TYPE_CHECKING:
    from rich.progress import Progress as Shown


class Bar(Progress):
    """A bar with the number of runs, the time left and the failures; nothing without a terminal."""

    def __init__(self) -> None:
        self._stack = ExitStack()
        self._shown: Shown | None = None
        self._failed = 0

    def __enter__(self) -> Bar:
        if sys.stderr.isatty():
            from rich.console import Console
            from rich.progress import (
                BarColumn,
                MofNCompleteColumn,
                TextColumn,
                TimeRemainingColumn,
            )
            from rich.progress import Progress as Shown

            shown = Shown(
                TextColumn("runs"),
                BarColumn(),
                MofNCompleteColumn(),
                TimeRemainingColumn(),
                TextColumn("{task.description}"),
                console=Console(stderr=True),
                transient=True,
            )
            self._shown = self._stack.enter_context(shown)
        return self

    def __exit__(self, *_: object) -> None:
        self._stack.close()

    def begin(self, runs: int, known: int) -> None:
        """Begin so many runs, of which some are known."""
        if self._shown is not None:
            self._shown.add_task("", total=runs, completed=known)

    def add(self, rows: Sequence[Row]) -> None:
        """Note new rows."""
        self._failed += sum(row.failure is not None for row in rows)
        if self._shown is not None:
            task = self._shown.task_ids[-1]
            text = f"{self._failed} without a result" if self._failed else ""
            self._shown.update(task, advance=len(rows), description=text)
