"""Replay of one robot: its machine alone, with the events of its trace."""

from __future__ import annotations

from collections import deque
from collections.abc import Callable, Mapping, Sequence
from copy import deepcopy
from typing import Any

from swarmdsl.base.diagnostics.collector import Diagnostics, Label
from swarmdsl.codegen.shared.default_values import result_fields
from swarmdsl.execution.engine import (
    Envelope,
    Event,
    Instance,
    InstanceLike,
    LoopError,
    Run,
    Servers,
)
from swarmdsl.execution.monitor import LOST
from swarmdsl.execution.simulate.machines.actors import Actor
from swarmdsl.execution.simulate.machines.copying import copied
from swarmdsl.execution.simulate.machines.expressions import PRESENT
from swarmdsl.execution.simulate.machines.json_numbers import numbers
from swarmdsl.execution.simulate.machines.subject import Subject
from swarmdsl.execution.simulate.network.members import Roster, following
from swarmdsl.execution.simulate.replay.robot_data import convert, with_fields
from swarmdsl.execution.simulate.replay.trace_records import Record
from swarmdsl.execution.simulate.scenario.clock import Clock
from swarmdsl.execution.simulate.scenario.durations import MILLISECOND, format_duration
from swarmdsl.execution.simulate.world.line import LATE, Line
from swarmdsl.execution.simulate.world.trace import Trace
from swarmdsl.execution.simulate.world.trace_line import NAMES

SHUTDOWN = "node.shutdown"
"""Trace event of a machine that was stopped from outside."""
_EARLY = 5 * MILLISECOND
"""Tolerance for the end of delays: traces have whole milliseconds."""

Seen = Callable[[Line, Mapping[str, Any], int], None]
"""Listener to a line of the model, the data of its machine after it, and its place in the trace."""


class _Delay:
    """Pending delay with its due time and action."""

    def __init__(self, due: int, action: Callable[[], None]) -> None:
        self.due = due
        self.action = action


class MachineReplay:
    """`World` of a single machine that reproduces the events of a trace."""

    def __init__(
        self,
        actor: Actor,
        subject: Subject,
        report: Diagnostics,
        seen: Seen | None,
        roster: Roster,
    ) -> None:
        self._roster = roster
        self._seen = seen
        self._actor = actor
        self._subject = subject
        self._report = report
        self._clock = Clock()
        self._lines: deque[tuple[Line, Any]] = deque()
        """Lines of the model that were not compared yet, each with the data after it."""
        self._trace = Trace(self._clock, [self._keep])
        self._delays: list[_Delay] = []
        self._runs: list[Run] = []
        self._last: list[str] = []
        if actor.machine.name in following(subject.system):
            actor.data[PRESENT] = roster.count
        self._first_data = deepcopy(actor.data)
        self._last_event: str | None = None
        self._instance = Instance(actor.machine, self, data=actor.data, servers=Servers())
        self._trace.watch(self._instance, actor)

    def replay(self, records: Sequence[Record]) -> int:
        """Return the number of conforming records; report the first difference."""
        for number, record in enumerate(records):
            self._clock.advance(max(record.time - self._clock.now, 0))
            if not self._lines:
                wrong = self._apply(record)
                if wrong:
                    self._report_difference(record, wrong)
                    return number
            if not self._lines:
                self._report_difference(record, "the model ignores it")
                return number
            line, data = self._lines.popleft()
            wrong = _difference(line, record)
            if wrong:
                self._report_difference(record, wrong)
                return number
            self._last = line.configuration
            if self._seen is not None:
                self._seen(line, data, record.place.start)
        return len(records)

    @property
    def has_ended(self) -> bool:
        """True if the machine is in its final state; one of a lost robot may come back."""
        return self._instance.final is not None and self._last_event != LOST

    # ---- called by the engine

    @property
    def time(self) -> int:
        """Return the time of the trace in nanoseconds."""
        return self._clock.now

    def schedule(self, delay: int, action: Callable[[], None]) -> _Delay:
        """Keep the delay until the trace says that it is over."""
        made = _Delay(self._clock.now + delay, action)
        self._delays.append(made)
        return made

    def unschedule(self, handle: _Delay) -> None:
        """Remove the delay."""
        self._delays.remove(handle)

    def start(self, run: Run) -> None:
        """Keep the run until the trace says how it ends."""
        self._runs.append(run)

    def cancel(self, run: Run) -> None:
        """Free the server at once: traces do not contain the time of that."""
        self._runs.remove(run)
        run.end("preempted")

    def send(self, instance: InstanceLike, event: Event) -> None:
        """Do nothing: other members have their own lines."""

    def failed(self, instance: InstanceLike, error: Exception) -> None:
        """Do nothing: the line shows the effect."""

    # ---- internal

    def _keep(self, line: Line) -> None:
        """Keep a line with a copy of the data: effects of later lines change parts of them."""
        data = self._instance.data
        if self._seen is not None and self._subject.system is not None:
            data = copied(data)
        self._lines.append((line, data))

    def _apply(self, record: Record) -> str:
        """Reproduce the event of a record; return the reason if that is impossible."""
        name, instance = record.event, self._instance
        try:
            if name is None:
                if self._last_event == LOST or instance.final is not None:
                    # The loss of a robot whose machine has ended has no line.
                    instance = self._start_anew()
                elif instance.running:
                    return "it starts a second time"
                self._trace.begin(instance, None)
                instance.start()
            elif name == LOST:
                # Of a machine that has ended, too: its robot is gone, or starts again.
                self._trace.begin(instance, name)
                instance.running = False
            elif name.startswith(LATE) and instance.running:
                self._trace.begin(instance, name)
            elif not instance.running:
                return "it is active after its end" if instance.final else "it has not started"
            elif name == SHUTDOWN:
                self._trace.begin(instance, name)
                instance.stop()
            elif name.startswith(("after.", "send.")):
                return self._end_delay(name)
            elif name.startswith("do."):
                return self._end_run(name, record.data)
            else:
                envelope = Envelope(**record.done.get("envelope", {}))
                data = self._message(name, record.data)
                self._trace.begin(instance, name, data, envelope)
                self._roster.note(name, data)
                instance.receive(Event(name, data, envelope=envelope))
        except LoopError as error:
            return str(error)
        finally:
            self._last_event = name
            self._trace.flush()
        return ""

    def _start_anew(self) -> Instance:
        """Replace the machine of a robot that was lost and comes back."""
        self._delays.clear()
        self._runs.clear()
        data = deepcopy(self._first_data)
        self._roster.clear()
        if PRESENT in data:
            data[PRESENT] = self._roster.count
        self._instance = Instance(self._actor.machine, self, data=data, servers=Servers())
        self._trace.watch(self._instance, self._actor)
        return self._instance

    def _end_delay(self, name: str) -> str:
        found = next((each for each in self._delays if _event_of(each.action) == name), None)
        if found is None:
            return f"delay `{name}` is not running"
        if self._clock.now < found.due - _EARLY:
            return f"in the model it ends at {format_duration(found.due)}, not before"
        self._delays.remove(found)
        found.action()
        return ""

    def _end_run(self, name: str, data: Any) -> str:
        for run in self._runs:
            for outcome, event in run.activity.events.items():
                if event == name:
                    self._runs.remove(run)
                    run.end(outcome, self._result(run, data) if outcome == "succeeded" else data)
                    return ""
        return f"no running activity can end with `{name}`"

    def _message(self, name: str, data: Any) -> Any:
        system = self._subject.system
        declared = next((e.type for e in system.events if e.name == name), None) if system else None
        return convert(declared, data, system) if declared is not None and system else numbers(data)

    def _result(self, run: Run, data: Any) -> Any:
        system = self._subject.system
        if system is None:
            return data
        fields = result_fields(system.function(run.activity.name).communication, system)
        if fields is not None:
            return with_fields(fields, data, system)
        return numbers(data) if isinstance(data, dict) else {}

    def _report_difference(self, record: Record, wrong: str) -> None:
        """Report a difference, with the states of the machine."""
        machine = self._actor.machine
        origins = [machine.states[machine.numbers[state]].origin for state in self._last]
        places = [place for place in map(self._subject.place, origins) if place is not None]
        self._report.report(
            "trace-departs",
            record.place,
            who=f"`{self._actor.name or machine.name}`",
            event=f"`{record.event}`" if record.event is not None else "its start",
            time=format_duration(record.time),
            label=wrong,
            related=tuple(Label(place, "it was in this state") for place in places),
        )


def _event_of(action: Callable[[], None]) -> str | None:
    """Return the event of a delay: its action is a method of the engine's timer."""
    timer = getattr(action, "__self__", None)
    return str(timer.event.name) if timer is not None else None


def _difference(line: Line, record: Record) -> str:
    """Return the difference between a line of the model and a record, or ""."""
    if line.event != record.event:
        return f"the model first processes `{line.event}`"
    for key in NAMES:
        expected, found = getattr(line, key), record.done[key]
        if expected != found:
            return f"`{key}` is {_list(expected)} in the model, {_list(found)} here"
    found = record.done.get("to", [None] * len(line.addresses))
    if line.addresses != found:
        return f"`to` is {_list(line.addresses)} in the model, {_list(found)} here"
    return ""


def _list(names: Sequence[str | None]) -> str:
    words = (f"`{name}`" if name is not None else "all others" for name in names)
    return ", ".join(words) or "nothing"
