"""Preview of a run while it goes on: its map, and diagrams with the active states."""

from __future__ import annotations

from collections.abc import Callable, Collection, Iterator
from contextlib import contextmanager

from swarmdsl.base import interrupts
from swarmdsl.ide.preview.editors import Editor
from swarmdsl.ide.preview.live_trace import TraceReader
from swarmdsl.ide.preview.pictures import Message, Pictures
from swarmdsl.ide.preview.serving import Snapshot, serving
from swarmdsl.ir import System

_MAP = "run"
"""Id of the map among the diagrams."""
_NAP = 0.2
"""Seconds between two looks for an interrupt."""
_GRACE = 2.0
"""Seconds that a page has to take the last picture."""


class LivePage:
    """Diagrams of a model, and the map of a run of it, if robots have places."""

    def __init__(self, system: System | None, title: str, map_: str | None) -> None:
        self.snapshot = Snapshot()
        self._pictures = _RunPictures(system, title, map_)
        self._reader = TraceReader(title, False, self.snapshot, lambda report: None)
        self.snapshot.tell(self._pictures)

    def step(self, line: str) -> None:
        """Show the states after a line of the trace."""
        self._reader.read([line])

    def redraw(self, svg: str) -> None:
        """Show another picture of the map, to those who look at it."""
        self._pictures.map = svg
        self.snapshot.tell({"redrawn": {"id": _MAP, "svg": svg}})


class _RunPictures(Pictures):
    """Diagrams of a model, after the map of the run."""

    def __init__(self, system: System | None, title: str, map_: str | None) -> None:
        super().__init__(system)
        self._title = title
        self.map = map_

    def listed(self) -> Message:
        found = super().listed()
        if self.map is not None:
            # All robots are on it: the page shows the first diagram on which somebody is.
            robots = {who for runs in found["runs"].values() for who, _ in runs}
            found["titles"] = {_MAP: f"{self._title} (map of the run)", **found["titles"]}
            found["runs"] = {_MAP: [(who, "") for who in sorted(robots)], **found["runs"]}
        return found

    def drawn(self, id_: str | None, hidden: Collection[str] = ()) -> Message:
        if self.map is not None and (id_ == _MAP or id_ not in super().listed()["titles"]):
            return {"id": _MAP, "svg": self.map}
        return super().drawn(id_, hidden)


@contextmanager
def live_page(
    system: System | None,
    title: str,
    map_: str | None,
    port: int,
    tell: Callable[[str], None],
    editor: Editor | None = None,
) -> Iterator[LivePage]:
    """Serve a page while the context lasts, which begins when somebody opens it.

    `map_` is its first picture, None if there are none. `tell` is called with its address. Raises
    OSError if the port is taken.
    """
    page = LivePage(system, title, map_)
    with serving(page.snapshot, port, editor) as address:
        tell(address)
        while not page.snapshot.wait_for_page(_NAP):
            interrupts.raise_lost()
        yield page
        page.snapshot.wait_for_delivery(_GRACE)
