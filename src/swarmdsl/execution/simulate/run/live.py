"""Show a run while it goes on, on a page that somebody else serves."""

from __future__ import annotations

import time
from collections.abc import Callable
from contextlib import AbstractContextManager, ExitStack
from typing import Protocol

from swarmdsl.execution.simulate.machines.subject import Subject
from swarmdsl.execution.simulate.pictures.run_map import Filmed, RunMap
from swarmdsl.execution.simulate.scenario.scenario import Robot
from swarmdsl.ir import System

_INTERVAL = 0.1
"""Least time between two pictures, in seconds."""
_SHARE = 0.2
"""Greatest share of the time that drawing takes."""


class Page(Protocol):
    """Page that shows a run."""

    def step(self, line: str) -> None:
        """Show the states after a line of the trace, which is JSON."""

    def redraw(self, svg: str) -> None:
        """Show another picture of the map."""


Opened = Callable[[System | None, str, "str | None"], AbstractContextManager[Page]]
"""Opens a page for a run of a model, with a title and the first picture of the map, if there is a
map, and waits until somebody looks at it."""


class LiveMap:
    """Map of a run that a page shows, drawn again while robots move."""

    def __init__(self, recorded: RunMap, world: Filmed, page: Page) -> None:
        self._recorded = recorded
        self._page = page
        self._next = 0.0
        world.space.viewers += (self,)

    def moved(self, now: int) -> None:
        """Draw the map, unless that has been done a moment ago."""
        start = time.monotonic()
        if start >= self._next:
            self.draw()
            end = time.monotonic()
            self._next = max(start + _INTERVAL, end + (end - start) / _SHARE)

    def saw(self, robot: Robot, what: str) -> None:
        """Wait for the next picture."""

    def draw(self) -> None:
        """Draw the map of now."""
        self._page.redraw(self._recorded.svg())


def show(
    opened: Opened, subject: Subject, world: Filmed, *, is_flat: bool, stack: ExitStack
) -> tuple[Page, Callable[[], None]]:
    """Open the page of a run; return it, and what draws the end."""
    recorded = RunMap(subject, world) if is_flat else None
    first = recorded.svg() if recorded is not None else None
    page = stack.enter_context(opened(subject.system, subject.name, first))
    if recorded is None:
        return page, lambda: None
    return page, LiveMap(recorded, world, page).draw
