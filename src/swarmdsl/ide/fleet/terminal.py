"""Fleet in a terminal: a table that is drawn again, or lines of what has changed."""

from __future__ import annotations

import os
import re
import select
import sys
from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from importlib.util import find_spec
from queue import Empty, SimpleQueue
from typing import Any, TextIO

from rich.console import Console, Group
from rich.live import Live
from rich.table import Table
from rich.text import Text

from swarmdsl.base import interrupts
from swarmdsl.base.diagnostics.render.printable import printable
from swarmdsl.ide.fleet.watch import RECORDED, Head, NotSentError, Watch

_NAP = 0.25
"""Seconds between two looks."""
_STYLES = {"there": "green", "lost": "bold red", "ended": "dim", "expected": "dim"}
_COLUMNS = ("robot", "status", "states", "last event", "battery")
_QUIT = ("q", "\x04")
_MOST = 1024
"""Number of bytes of a terminal that are read at once."""
_SEQUENCE = re.compile(r"\x1b+(\[[0-?]*[ -/]*[@-~]|O?.?)")
"""Bytes that a key without a character sends."""
_HAS_KEYS = find_spec("termios") is not None  # not so on Windows


def has_screen(out: TextIO) -> bool:
    """Return True if a table can be drawn again, and keys can be read."""
    return out.isatty() and sys.stdin.isatty() and _HAS_KEYS


def show(watch: Watch, out: TextIO) -> None:
    """Show the fleet until Ctrl-C, or `q`; each change is a line if the watch tells each.

    Of a recording, these are only the last ones.
    """
    if watch.changes is not None:
        if watch.no_sending == RECORDED:
            print(*lines_of(watch.head()).values(), sep="\n", file=out)
        else:
            _write_changes(watch, watch.changes, out)
        return
    said = ""
    console = Console(file=out)
    with _keys(), Live(console=console, screen=True, auto_refresh=False) as live:
        while True:
            live.update(_drawing(watch, said), refresh=True)
            for key in pressed(sys.stdin.fileno(), _NAP):
                if key in _QUIT:
                    return
                if key.isdecimal() and 0 < int(key) <= len(watch.events):
                    said = send(watch, watch.events[int(key) - 1].name)
            interrupts.raise_lost()


def send(watch: Watch, name: str) -> str:
    """Send an event without data; return what became of it."""
    try:
        heard, lost = watch.send(name, {})
    except NotSentError as error:
        return f"{name} is not sent: {error}"
    but = f"; lost: {', '.join(lost)}" if lost else ""
    return f"{name} is sent to {heard} node{'s' if heard != 1 else ''}{but}"


def lines_of(head: Mapping[str, Any]) -> dict[str, str]:
    """Return what is told of each robot, property and alarm, by its key."""
    found = {}
    for row in head["robots"]:
        cells = (each for each in _cells(row)[1:] if each)
        found[row["robot"]] = printable(" ".join((row["robot"], *cells)))
    for name, verdict in head["verdicts"].items():
        found[f"property {name}"] = printable(f"property {name}: {verdict}")
    for each in head["alarms"]:
        found[f"alarm {each}"] = printable(f"alarm: {each}")
    return found


def _write_changes(watch: Watch, changes: SimpleQueue[Head | None], out: TextIO) -> None:
    """Write a line for each thing that has changed, to the end of the trace or forever."""
    told: dict[str, str] = {}
    while True:
        interrupts.raise_lost()
        try:
            head = changes.get(timeout=_NAP)
        except Empty:
            head = watch.head()  # time alone makes robots late
        if head is None:
            return
        now = lines_of(head)
        for key, line in now.items():
            if told.get(key) != line:
                print(line, file=out, flush=True)
        told = now


def _drawing(watch: Watch, said: str) -> Group:
    head = watch.head()
    table = Table(box=None)
    for each in _COLUMNS:
        table.add_column(each)
    for row in head["robots"]:
        cells = [Text(printable(each)) for each in _cells(row)]
        cells[1].stylize(_STYLES.get(row["status"], ""))
        table.add_row(*cells)
    alarms = [Text(printable(each), "bold red") for each in head["alarms"]]
    verdicts = [Text(printable(f"{name}: {each}")) for name, each in head["verdicts"].items()]
    keys = [f"{number} {each.name}" for number, each in enumerate(watch.events, 1)]
    can = f" ({watch.no_sending})" if watch.no_sending and keys else ""
    foot = Text(printable("   ".join([*keys, "q quit"]) + can), "bold")
    return Group(*alarms, table, *verdicts, Text(printable(said or watch.waiting)), foot)


def _cells(row: Mapping[str, Any]) -> tuple[str, ...]:
    machines = row["machines"]
    latest = max(machines, key=lambda each: each["t"], default=None)
    battery = row["battery"]
    return (
        row["robot"],
        row["status"],
        "; ".join(", ".join(each["states"]) for each in machines),
        latest["event"] if latest is not None else "",
        f"{battery:.0%}" if battery is not None else "",
    )


@contextmanager
def _keys() -> Iterator[None]:
    """Let keys be read one by one, without waiting for the end of a line."""
    import termios
    import tty

    before = termios.tcgetattr(sys.stdin)
    tty.setcbreak(sys.stdin)
    try:
        yield
    finally:
        termios.tcsetattr(sys.stdin, termios.TCSADRAIN, before)


def pressed(terminal: int, patience: float) -> str:
    """Return the keys that were pressed, or an empty text after a while.

    Keys without a character, such as arrows and `Delete`, are none: what they send has digits.
    """
    ready, _, _ = select.select([terminal], [], [], patience)
    if not ready:
        return ""
    # Not from `sys.stdin`, which would keep what it does not return.
    read = os.read(terminal, _MOST).decode(errors="replace")
    return _SEQUENCE.sub("", read) if read else _QUIT[0]
