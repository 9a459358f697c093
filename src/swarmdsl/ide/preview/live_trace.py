"""Live states of robots, read from traces of a simulation or of the robots."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence
from pathlib import Path
from threading import Thread
from typing import Any

from swarmdsl.base.diagnostics.collector import Diagnostics
from swarmdsl.base.read_files import OddFileError
from swarmdsl.execution.simulate.world.trace_line import is_beside_steps, read_line
from swarmdsl.ide.preview.pictures import Steps
from swarmdsl.ide.preview.serving import Snapshot
from swarmdsl.ide.preview.trace_file import Turn, read_growing
from swarmdsl.project.read_source import report_unreadable

_RECENT = 1000
"""Milliseconds for which a transition counts as just taken."""
_ROOT = ""
"""Id of the machine itself, which is entered at its start."""


def follow(names: Sequence[str], snapshot: Snapshot, tell: Callable[[Diagnostics], None]) -> None:
    """Publish each trace, from its beginning and as it grows, in background threads.

    `tell` reports the first invalid line of each trace.
    """
    for name in names:
        reader = TraceReader(name, len(names) > 1, snapshot, tell)
        Thread(target=_read, args=(name, reader), daemon=True).start()


def _read(name: str, reader: TraceReader) -> None:
    """Follow a file to its end, or forever if it has none."""
    try:
        for chunk in read_growing(name):
            if chunk is Turn.BEGUN:
                reader.forget()
            elif not isinstance(chunk, Turn):
                reader.read(chunk)
    except OddFileError as error:
        reader.report_odd(error)


class TraceReader:
    """Publishes the lines of one trace.

    A machine outside of a swarm is named after the only machine that fits; if it is
    `one_of_several`, also after its trace: `Guarding (dog.jsonl)`. Only the first invalid line is
    reported.
    """

    def __init__(
        self,
        name: str,
        one_of_several: bool,
        snapshot: Snapshot,
        tell: Callable[[Diagnostics], None],
    ) -> None:
        self._name = name
        self._one_of_several = one_of_several
        self._snapshot = snapshot
        self._tell = tell
        self._is_valid = True
        self._lines = 0
        # For a machine outside of a swarm: its states so far, and its last name.
        self._seen: set[str] = set()
        self._machine_name: str | None = None

    def forget(self) -> None:
        """Restart with an empty trace."""
        self._lines = 0
        self._seen.clear()
        self._machine_name = None
        self._snapshot.forget(self._name)

    def read(self, lines: Iterable[str | bytes]) -> None:
        """Publish more complete lines."""
        active: dict[str, Sequence[str] | None] = {}
        steps: list[tuple[int, str, dict[str, Any]]] = []
        for line in lines:
            self._lines += 1
            if not line.strip():
                continue
            value = read_line(line)
            if isinstance(value, str):
                self._report_invalid(value)
                continue
            if is_beside_steps(value):
                continue
            member = value.get("member")
            if member is None:
                member = self._machine(value)
                if self._machine_name not in (None, member):
                    active[str(self._machine_name)] = None
                self._machine_name = member
            active[member] = value["configuration"]
            steps.append((value["t"], member, value))
        if active:
            self._snapshot.move(self._name, active, _latest(steps))

    def _machine(self, value: dict[str, Any]) -> str:
        """Return the name of a machine outside of a swarm, found by its states so far."""
        self._seen.update(value["configuration"], value["entered"])
        states = self._snapshot.pictures.states
        fitting = [name for name, ids in states.items() if self._seen <= ids]
        machine = fitting[0] if len(fitting) == 1 else ""
        if not self._one_of_several:
            return machine
        return f"{machine} ({self._name})" if machine else self._name

    def report_odd(self, error: OddFileError) -> None:
        """Report a pipe or device, which is not followed."""
        report = Diagnostics()
        report_unreadable(Path(self._name), error, None, report, "a trace")
        self._tell(report)

    def _report_invalid(self, reason: str) -> None:
        if self._is_valid:
            self._is_valid = False
            report = Diagnostics()
            report.report(
                "bad-trace-line",
                reason=reason,
                notes=(
                    f"line {self._lines} of {self._name}; further invalid lines are not reported",
                ),
                help="`swarmc simulate --trace json` writes such lines, "
                "and nodes of target `ros2` do",
            )
            self._tell(report)


def _latest(steps: Sequence[tuple[int, str, dict[str, Any]]]) -> Steps:
    """Return the recent steps of members; earlier ones are dropped."""
    taken: dict[str, list[str]] = {}
    entered: dict[str, list[str]] = {}
    last = max((time for time, _, _ in steps), default=0)
    for time, member, step in steps:
        if time > last - _RECENT:
            begun = [_ROOT] if step["event"] is None and step["entered"] else []
            if ids := step.get("taken"):
                taken.setdefault(member, []).extend(ids)
            if ids := [*begun, *step["entered"]]:
                entered.setdefault(member, []).extend(ids)
    return {"taken": taken, "entered": entered}
