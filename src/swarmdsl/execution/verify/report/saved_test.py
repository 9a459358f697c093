"""Runs that show what is wrong as behaviour tests, which fail until the model is mended.

A test replays the inputs of a run: ends of functions, events from outside, and the arrival or loss
of each event between robots. Delays end by themselves while time passes.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from typing import Any

from swarmdsl.base.records import dataclass, field
from swarmdsl.codegen.shared.default_values import default_result, default_value, result_fields
from swarmdsl.execution.simulate.inputs.choose_space import has_geometry
from swarmdsl.execution.simulate.machines.subject import Subject
from swarmdsl.execution.simulate.scenario.durations import SECOND
from swarmdsl.execution.simulate.scenario.scenario import Scenario
from swarmdsl.execution.simulate.world.line import Line
from swarmdsl.execution.verify.report.shown import LONGEST, Shown
from swarmdsl.execution.verify.report.toml_text import (
    fields_with_times,
    step_text,
    time_text,
    toml_text,
    with_times,
)

_MOST_LAPS = 1000
"""Number of repetitions after which a test ends."""
_ACTIVITY = "do."
_PASS = "pass"


@dataclass(frozen=True)
class Setting:
    """Setting of all tests: params as a scenario gives them, and functions that may not answer."""

    params: Mapping[str, Any] = field(default_factory=dict)
    silent: tuple[str, ...] = ()


class ReplayedTest:
    """A test that replays a run.

    Inputs are given `early`, in nanoseconds, to come before delays that end at the same time.
    """

    def __init__(self, subject: Subject, shown: Shown, setting: Setting, early: int) -> None:
        assert subject.system is not None
        self._subject = subject
        self._system = subject.system
        self._shown = shown
        self._setting = setting
        self._early = early
        self._robots = list(dict.fromkeys(line.actor.robot for line in shown.run.lines))
        self._actors = list(dict.fromkeys(line.actor for line in shown.run.lines))
        self._on_way: list[tuple[str, str | None, str | None]] = []
        """Events that were sent, each with its sender and receiver."""
        self._inside: list[tuple[str | None, str]] = []
        """Events of a robot for itself."""
        self._lost: set[str | None] = set()
        self._now = 0

    def lines(self) -> Iterator[str]:
        """Yield the lines of the test."""
        shown = self._shown
        steps = list(self._steps()) or [step_text(**{_PASS: "1 s"})]
        yield "[[test]]"
        yield f"name = {toml_text(shown.name)}"
        if shown.property is not None:
            yield f"properties = {toml_text([shown.property])}"
        yield f"scenario = {toml_text(self._scenario())}"
        yield "steps = ["
        yield from (f"  {step}," for step in steps)
        yield "]"

    def _scenario(self) -> dict[str, Any]:
        """Return a scenario in which no function ends by itself during the run.

        Where robots have places, functions that move them would do so.
        """
        length = time_text(self._shown.run.lines[-1].time + SECOND)
        counts = dict(self._shown.counts)
        functions: dict[str, Any] = {"*": {"duration": length}}
        functions.update({name: {"never": 1} for name in self._setting.silent})
        found = {"count": counts, "params": self._setting.params, "functions": functions}
        if has_geometry(self._subject, Scenario()):
            found["world"] = {"kind": "abstract"}
        return {key: values for key, values in found.items() if values}

    def _steps(self) -> Iterator[str]:
        run, claim = self._shown.run, self._shown.claim
        end = len(run.lines)
        first = end - run.loop if run.loop and run.period else end
        yield from self._replay(0, first, run.lost[: run.lost_before] if first < end else run.lost)
        now, wait, lap = self._now, [], []
        if first < end:
            wait = [*self._pass(run.lines[first].time - self._early)]
            over = self._now + run.period - self._early
            lap = [*self._replay(first, end, run.lost[run.lost_before :]), *self._pass(over)]
        if all(step.startswith(f"{{ {_PASS} ") for step in lap):
            # What only takes time goes on by itself.
            self._now, wait, lap = now, [], []
            yield from self._pass(run.lines[-1].time)
            for event, sender, robot in self._on_way:
                yield step_text(hear=event, by=robot, **{"from": sender})
        yield from wait
        if claim is not None and lap and run.period < LONGEST // _MOST_LAPS:
            claim = {**claim, "within": time_text(run.period * _MOST_LAPS)}
        if claim is not None:
            yield _expectation(claim, lap, self._shown.note)

    def _replay(self, begin: int, end: int, lost: Sequence[tuple[int, str, str]]) -> Iterator[str]:
        """Yield the inputs of some lines, and losses of messages."""
        lines = self._shown.run.lines
        for number in range(begin, end + 1):
            for _, event, robot in (each for each in lost if each[0] == number):
                yield self._arrival("drop", event, robot, None)
            yield from self._gone(number)
            if number == end:
                return
            line = lines[number]
            if not (line.recalled or (number and _is_one(lines[number - 1], line))):
                step = self._input(line)
                if step is not None:
                    yield from self._pass(line.time - self._early)
                    yield step
            self._send(line)

    def _pass(self, time: int) -> Iterator[str]:
        """Let time pass until a time of the run; delays end then."""
        if time > self._now:
            yield step_text(**{_PASS: time_text(time - self._now)})
            self._now = time

    def _gone(self, number: int) -> Iterator[str]:
        """Yield the losses of robots, with what is on its way to them."""
        for loss in self._shown.run.gone:
            if loss.at == number and loss.robot not in self._lost:
                yield from self._pass(loss.time - self._early)
                for event, sender, _ in [each for each in self._on_way if each[2] == loss.robot]:
                    yield self._arrival("drop", event, loss.robot, sender)
                yield step_text(lose=loss.robot)
                self._lost.add(loss.robot)

    def _arrival(self, verb: str, event: str, robot: str | None, sender: str | None) -> str:
        """Take an event from its way."""
        found = next(
            (
                each
                for each in self._on_way
                if each[0] == event and each[2] == robot and sender in (None, each[1])
            ),
            None,
        )
        if found is not None:
            self._on_way.remove(found)
            sender = found[1]
        return step_text(**{verb: event, "by": robot, "from": sender})

    def _input(self, line: Line) -> str | None:
        """Return the step of what a line begins with, None for what happens by itself."""
        event, robot = line.event, line.actor.robot.name
        if event is None:
            return None
        if event.startswith(_ACTIVITY):
            return self._end(line, event)
        declared = self._system.events_by_name.get(event)
        if declared is None or declared.predefined:
            return None  # the end of a delay, a loss, or what heartbeats tell
        if line.envelope.sender:
            return self._arrival("hear", event, robot, line.envelope.sender)
        if (robot, event) in self._inside:
            self._inside.remove((robot, event))
            return None
        return step_text(send=event, to=robot, data=self._data(event, line.data))

    def _end(self, line: Line, event: str) -> str:
        activities = [each.activity for each in line.actor.machine.states if each.activity]
        activity = next(each for each in activities if event in each.events.values())
        outcome = next(word for word, name in activity.events.items() if name == event)
        result = line.data if isinstance(line.data, Mapping) else None
        if result is not None and result.get("success") is False:
            outcome = "succeeded"
        call = self._system.function(activity.name).communication
        if outcome != "succeeded" or result == default_result(call, self._system):
            result = None
        if result is not None:
            result = fields_with_times(result_fields(call, self._system), result, self._system)
        as_ = outcome if outcome != "succeeded" else None
        who = line.actor.robot.name
        return step_text(end=activity.name, of=who, **{"as": as_}, result=result)

    def _data(self, event: str, data: Any) -> Any:
        type_ = self._system.event(event).type
        is_told = data and data != default_value(type_, self._system)
        return with_times(type_, data, self._system) if is_told else None

    def _send(self, line: Line) -> None:
        """Put the events that a line sends on their way."""
        source = line.actor.robot
        for event, to in zip(line.sent, line.addresses, strict=True):
            declared = self._system.event(event)
            if to is None:
                here = [e.name for e in self._system.events if e.incoming_topic == declared.topic]
                self._inside += [(source.name, name) for name in here]
            for robot in self._robots if declared.swarm else ():
                listens = any(a.robot is robot and a.listens(event) for a in self._actors)
                is_there = robot is not source and robot.name not in self._lost
                if is_there and listens and robot.is_meant_by(to):
                    self._on_way.append((event, source.name, robot.name))


def _expectation(claim: Mapping[str, Any], meanwhile: Sequence[str], note: str) -> str:
    """Return the step of what is expected at last, in vain, after a note."""
    text = step_text(**claim)
    if meanwhile:
        laps = "".join(f"    {step},\n" for step in meanwhile)
        text = f"{text.removesuffix(' }')}, meanwhile = [\n{laps}  ] }}"
    return f"# {note}\n  {text}" if note else text


def _is_one(one: Line, other: Line) -> bool:
    """Return True if an event arrives at two machines of a robot."""
    return (
        one.actor is not other.actor
        and one.actor.robot is other.actor.robot
        and (one.event, one.time, one.envelope) == (other.event, other.time, other.envelope)
        and not (one.event or "").startswith(_ACTIVITY)
    )
