"""Lines that nodes tell of their state machines, as traces of a run."""

from __future__ import annotations

import json
from collections.abc import Callable, Sequence
from typing import Any

from swarmdsl.base.diagnostics.collector import Diagnostics
from swarmdsl.base.source import Source
from swarmdsl.execution.monitor import LOST, PropertyResult
from swarmdsl.execution.simulate.evaluation.measures import FitnessResult
from swarmdsl.execution.simulate.evaluation.verdicts import Recording
from swarmdsl.execution.simulate.machines.actors import Actor
from swarmdsl.execution.simulate.machines.subject import Subject
from swarmdsl.execution.simulate.replay.replay import replay
from swarmdsl.execution.simulate.scenario.durations import MILLISECOND
from swarmdsl.execution.simulate.scenario.space import Place, Space
from swarmdsl.execution.simulate.world.trace_line import read_line

_NOTHING: tuple[str, ...] = ("entered", "exited", "taken", "started", "cancelled", "sent")


class Recorded:
    """Lines of all nodes in the order in which they came, with where the robot was then."""

    def __init__(self, members: Sequence[str]) -> None:
        self.lines: list[dict[str, Any]] = []
        self.listeners: list[Callable[[str], None]] = []
        """Called with each line, as JSON."""
        self._last: dict[str, dict[str, Any]] = {}
        self._waiting = dict.fromkeys(members)
        self._lost: set[str] = set()

    @property
    def missing(self) -> list[str]:
        """Members of which no node has told anything yet."""
        return [name for name in self._waiting if name not in self._last]

    @property
    def is_over(self) -> bool:
        """True if all machines have ended, or their robots are lost."""
        ended = (name for name, line in self._last.items() if line.get("ended"))
        return not set(self._waiting).difference(ended, self._lost)

    def ended(self, member: str) -> bool:
        """Return True if the machine of a member has ended."""
        return bool(self._last.get(member, {}).get("ended"))

    def add(self, text: str, at: Callable[[str], Place | None]) -> dict[str, Any] | None:
        """Add a line; return it, or None for one that is invalid or of nobody here."""
        line = read_line(text)
        if isinstance(line, str) or line.get("member") not in self._waiting:
            return None
        member = line["member"]
        if member in self._lost:
            return None
        self._add(member, line, at)
        return line

    def lose(self, member: str, now: int, reason: str, at: Callable[[str], Place | None]) -> None:
        """Note that the robot of a member is lost; its node may go on, but is not heard here."""
        last = self._last.get(member)
        if last is None or last.get("ended") or member in self._lost:
            return
        line: dict[str, Any] = {"t": now // MILLISECOND, "member": member, "event": LOST}
        line["configuration"] = last["configuration"]
        line.update({name: [] for name in _NOTHING})
        if reason:
            line["data"] = {"reason": reason}
        self._add(member, line, at)
        self._lost.add(member)

    def judge(
        self,
        subject: Subject,
        cast: Sequence[Actor],
        recording: Recording,
        now: int,
        space: Space,
        report: Diagnostics,
    ) -> tuple[list[PropertyResult], FitnessResult | None]:
        """Return verdicts and fitness of the lines, as those of a replayed trace."""
        source = Source("trace of the nodes", "".join(f"{_json(line)}\n" for line in self.lines))
        found = replay(source, subject, cast, report, recording.see)
        is_sure = self.is_over and not found.left_out
        return recording.results(now, 0 if is_sure else None, space)

    def _add(self, member: str, line: dict[str, Any], at: Callable[[str], Place | None]) -> None:
        place = at(member)
        if place is not None:
            line["at"] = [round(each, 3) for each in place]
        self._last[member] = line
        self.lines.append(line)
        for listener in self.listeners:
            listener(_json(line))


def _json(line: dict[str, Any]) -> str:
    return json.dumps(line, ensure_ascii=False)
