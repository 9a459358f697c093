"""Where robots are, as the traces say that they write: of a simulation, or their own."""

from __future__ import annotations

import os
import stat
import sys
from collections.abc import Callable, Iterable, Iterator, Sequence
from pathlib import Path
from threading import Thread
from time import sleep
from typing import Any

from swarmdsl.base.diagnostics.collector import Diagnostics
from swarmdsl.execution.simulate.trace_line import read_line
from swarmdsl.ide.preview.pictures import Steps
from swarmdsl.ide.preview.serving import News

STDIN = "-"
_PAUSE = 0.1
"""Seconds between two looks at a file."""
_CHUNK = 1 << 20
_MOMENT = 1000
"""Milliseconds for which a transition counts as just taken."""
_ROOT = ""
"""The id of a machine itself, which is entered when it begins."""


def follow(names: Sequence[str], news: News, tell: Callable[[Diagnostics], None]) -> None:
    """Tell pages what is written in each trace, and what will be while the process lasts.

    The first line of each that is none of a trace is told.
    """
    for name in names:
        follower = Follower(name, len(names) > 1, news, tell)
        Thread(target=_read, args=(name, follower), daemon=True).start()


def _read(name: str, follower: Follower) -> None:
    """Follow a file to its end, if it has one."""
    for chunk in _stream() if name == STDIN else _chunks(Path(name)):
        if chunk is None:
            follower.forget()
        else:
            follower.hear(chunk)


class Follower:
    """Tells pages what the lines of one trace say, as they come.

    A machine alone is called as the machine that it must be, and is `one_of_several` also as its
    trace: `Guarding (dog.jsonl)`. The first line that is none of a trace is told.
    """

    def __init__(
        self, name: str, one_of_several: bool, news: News, tell: Callable[[Diagnostics], None]
    ) -> None:
        self._name = name
        self._one_of_several = one_of_several
        self._news = news
        self._tell = tell
        self._is_right = True
        self._lines = 0
        # Of a machine alone: the states that it was in, and what it was called at last.
        self._seen: set[str] = set()
        self._called: str | None = None

    def forget(self) -> None:
        """The trace begins anew."""
        self._lines = 0
        self._seen.clear()
        self._called = None
        self._news.forget(self._name)

    def hear(self, lines: Iterable[str | bytes]) -> None:
        """Some more lines, whole ones."""
        active: dict[str, Sequence[str] | None] = {}
        steps: list[tuple[int, str, dict[str, Any]]] = []
        for line in lines:
            self._lines += 1
            if not line.strip():
                continue
            value = read_line(line)
            if isinstance(value, str):
                self._complain(value)
                continue
            member = value.get("member")
            if member is None:
                member = self._machine(value)
                if self._called not in (None, member):
                    active[str(self._called)] = None
                self._called = member
            active[member] = value["configuration"]
            steps.append((value["t"], member, value))
        if active:
            self._news.move(self._name, active, _latest(steps))

    def _machine(self, value: dict[str, Any]) -> str:
        """What a machine alone is called: the only one that has all states that it was in."""
        self._seen.update(value["configuration"], value["entered"])
        states = self._news.pictures.states
        fitting = [name for name, ids in states.items() if self._seen <= ids]
        machine = fitting[0] if len(fitting) == 1 else ""
        if not self._one_of_several:
            return machine
        return f"{machine} ({self._name})" if machine else self._name

    def _complain(self, reason: str) -> None:
        if self._is_right:
            self._is_right = False
            report = Diagnostics()
            report.report(
                "bad-trace-line",
                reason=reason,
                notes=(f"line {self._lines} of {self._name}; others are passed over silently",),
                help="`swarmc simulate --trace json` writes such lines, "
                "and nodes of target `ros2` do",
            )
            self._tell(report)


def _latest(steps: Sequence[tuple[int, str, dict[str, Any]]]) -> Steps:
    """What members have done at the end of some steps: others are long past."""
    taken: dict[str, list[str]] = {}
    entered: dict[str, list[str]] = {}
    last = max((time for time, _, _ in steps), default=0)
    for time, member, step in steps:
        if time > last - _MOMENT:
            begun = [_ROOT] if step["event"] is None and step["entered"] else []
            if ids := step.get("taken"):
                taken.setdefault(member, []).extend(ids)
            if ids := [*begun, *step["entered"]]:
                entered.setdefault(member, []).extend(ids)
    return {"taken": taken, "entered": entered}


def _chunks(path: Path) -> Iterator[list[bytes] | None]:
    """The new whole lines of a file, again and again; None each time that it begins anew."""
    while True:
        try:
            about = path.stat()
        except OSError:
            sleep(_PAUSE)
            continue
        try:
            with path.open("rb", buffering=0) as file:
                yield None
                if not stat.S_ISREG(about.st_mode):
                    yield from _whole(lambda: os.read(file.fileno(), _CHUNK))
                else:
                    yield from _regular(path, file.fileno())
        except OSError:
            sleep(_PAUSE)


def _regular(path: Path, descriptor: int) -> Iterator[list[bytes]]:
    """The lines of a file while it only becomes longer."""
    rest, at = b"", 0
    while True:
        chunk = os.read(descriptor, _CHUNK)
        at += len(chunk)
        *lines, rest = (rest + chunk).split(b"\n")
        yield lines
        if not chunk:
            sleep(_PAUSE)
            there, here = path.stat(), os.fstat(descriptor)
            if here.st_size < at or (there.st_dev, there.st_ino) != (here.st_dev, here.st_ino):
                return


def _stream() -> Iterator[list[bytes] | None]:
    """The lines of standard input, as soon as they are there."""
    yield from _whole(lambda: os.read(sys.stdin.fileno(), _CHUNK))


def _whole(read: Callable[[], bytes]) -> Iterator[list[bytes]]:
    rest = b""
    while chunk := read():
        *lines, rest = (rest + chunk).split(b"\n")
        yield lines
    yield [rest]
