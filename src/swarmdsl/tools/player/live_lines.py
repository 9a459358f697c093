"""Lines of a trace that is still written, as a page gets them one after the other."""

from __future__ import annotations

from collections.abc import Iterable
from typing import Any

from swarmdsl.base.diagnostics.collector import Diagnostics
from swarmdsl.execution.simulate.machines.json_numbers import named_numbers
from swarmdsl.execution.simulate.scenario.durations import MILLISECOND, format_duration
from swarmdsl.execution.simulate.world.trace_line import is_beside_steps, read_line
from swarmdsl.tools.player.model import Model
from swarmdsl.tools.player.record import member_of, named, note_of
from swarmdsl.tools.player.recording import Machine, Step
from swarmdsl.tools.player.trace_lines import plain

_MOST_TOLD = 20
"""Number of diagnostics that are told."""
_HELP = "`swarmc simulate --trace json` and nodes of target `ros2` write trace lines"
_OTHER_MODEL = "the robot was built from another model: build it again, or follow it with its own"

Message = dict[str, Any]


class LiveLines:
    """Reads more and more lines of one trace, of a model if it is known.

    A message to the page has some of `members`, `machines` with the states of theirs, `lines`, and
    `notes`. Times never go back: a line that would is shown at the time of the one before, and
    told if it is by more milliseconds than `patience`.
    """

    def __init__(
        self, name: str, model: Model | None, machines: Iterable[Machine], patience: int = 0
    ) -> None:
        self._name = name
        self._patience = patience
        self._model = model
        self._machines = {each.name: each for each in machines}
        self._of_model = frozenset(self._machines)
        self._of: dict[str, str] = {}
        self._number = 0
        self._told = 0
        self._time = 0
        self._zero: int | None = None
        self._is_late = False

    def read(self, lines: Iterable[str | bytes], report: Diagnostics) -> Message:
        """Return the message of more complete lines; empty if nothing is to be shown."""
        shown: list[Step] = []
        members: list[Message] = []
        machines: dict[str, Machine] = {}
        found = Diagnostics()
        for text in lines:
            self._number += 1
            if text.strip() and (line := self._line(text, found)) is not None:
                if not is_beside_steps(line):
                    members += self._joined(line["member"], found)
                    machines |= self._with_states(line, found)
                shown.append(line)
        told = list(found)[: _MOST_TOLD - self._told]
        self._told += len(told)
        report.include(told)
        message = {
            "members": members,
            "machines": {name: each.head() for name, each in machines.items()},
            "lines": shown,
            "notes": [note_of(each).head() for each in told],
        }
        return {key: value for key, value in message.items() if value}

    def _line(self, text: str | bytes, found: Diagnostics) -> Step | None:
        """Return the line as a page shows it; None if it cannot."""
        value = read_line(text)
        if isinstance(value, str):
            reason = f"line {self._number} of {self._name}: {value}"
            found.report("bad-trace-line", reason=reason, help=_HELP)
            return None
        if self._zero is None:
            self._zero = value.get("began")
        step = plain(value, self._zero)
        if step is None:
            return None
        self._keep_time(step, found)
        return named(named_numbers(step), self._model.alone if self._model is not None else None)

    def _keep_time(self, step: Message, found: Diagnostics) -> None:
        if step["t"] < self._time:
            is_much = self._time - step["t"] > self._patience
            if is_much and not self._is_late:
                self._is_late = True
                behind = format_duration((self._time - step["t"]) * MILLISECOND)
                found.report(
                    "clocks-differ",
                    who=f"`{step.get('member') or self._name}`",
                    reason=f"the time of line {self._number} goes back by {behind}",
                    help="set the clocks of the robots by NTP or PTP: their order is not certain",
                )
            step["t"] = self._time
        self._time = step["t"]

    def _joined(self, name: str, found: Diagnostics) -> list[Message]:
        """Return the member of a name, if it is new."""
        if name in self._of:
            return []
        member = member_of(name, None, self._model, found)
        self._of[name] = member.machine
        return [member.head()]

    def _with_states(self, line: Step, found: Diagnostics) -> dict[str, Machine]:
        """Return the machine of a line if it has states that were not known, which is told."""
        name = self._of[line["member"]]
        known = self._machines.get(name, Machine(name, ()))
        new = [each for each in line["configuration"] if each not in known.states]
        if name in self._machines and not new:
            return {}
        if name in self._of_model:
            states = ", ".join(f"`{each}`" for each in new)
            reason = f"line {self._number} of {self._name}: `{name}` has no state {states}"
            found.report("bad-trace-line", reason=reason, help=_OTHER_MODEL)
        self._machines[name] = known.with_states(new)
        return {name: self._machines[name]}
