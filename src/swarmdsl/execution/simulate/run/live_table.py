"""Live table of member states on a terminal."""

from __future__ import annotations

from collections.abc import Iterable

from rich.console import Console, Group
from rich.live import Live
from rich.progress_bar import ProgressBar
from rich.table import Table
from rich.text import Text

from swarmdsl.base.diagnostics.render.printable import printable
from swarmdsl.execution.simulate.machines.actors import Actor
from swarmdsl.execution.simulate.scenario.clock import Clock
from swarmdsl.execution.simulate.scenario.durations import format_duration
from swarmdsl.execution.simulate.world.line import Line

_REFRESHED = 8
"""Refresh rate per second."""


class Board:
    """Table of members and states, with a progress bar of virtual time."""

    def __init__(self, cast: Iterable[Actor], clock: Clock, until: int, console: Console) -> None:
        self._last: dict[Actor, Line | None] = dict.fromkeys(cast)
        self._clock = clock
        self._until = until
        self._console = console

    def note(self, line: Line) -> None:
        """Keep the last line of each machine."""
        self._last[line.actor] = line

    def display(self) -> Live:
        """Return the live display, which is removed at the end."""
        return Live(
            console=self._console,
            get_renderable=self.drawn,
            refresh_per_second=_REFRESHED,
            transient=True,
        )

    def drawn(self) -> Group:
        """Render the current table and progress bar."""
        table = Table("member", "is in", "since", box=None, pad_edge=False, header_style="bold")
        rows = max(self._console.height - 5, 1)
        lines = list(self._last.items())
        for actor, line in lines[:rows]:
            who = printable(actor.name or actor.machine.name)
            where = printable(", ".join(line.configuration)) if line is not None else ""
            since = format_duration(line.time) if line is not None else ""
            table.add_row(Text(who), Text(where, style="cyan"), since)
        if len(lines) > rows:
            table.add_row(f"and {len(lines) - rows} more", "", "")
        now = min(self._clock.now, self._until)
        bar = ProgressBar(total=max(self._until, 1), completed=now, width=50)
        return Group(
            table, Text(), bar, Text(f" {format_duration(now)} of {format_duration(self._until)}")
        )
