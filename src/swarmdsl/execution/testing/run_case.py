"""Run one test with one seed, in virtual time."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from itertools import cycle

from swarmdsl.base.diagnostics.collector import Diagnostics, Label, listed
from swarmdsl.base.source import Span
from swarmdsl.execution.engine import LoopError
from swarmdsl.execution.monitor import FALSE, Verdict, Violation, Watch
from swarmdsl.execution.simulate.evaluation.measures import evaluate, fitness_of, measures_of
from swarmdsl.execution.simulate.evaluation.properties import plan, watch
from swarmdsl.execution.simulate.evaluation.verdicts import violation_fields
from swarmdsl.execution.simulate.machines.actors import Actor, actors
from swarmdsl.execution.simulate.recording.run_lines import Recorder as Recording
from swarmdsl.execution.simulate.recording.run_lines import RunLines
from swarmdsl.execution.simulate.scenario.durations import format_duration
from swarmdsl.execution.simulate.scenario.space import ModelError
from swarmdsl.execution.simulate.world.line import Line
from swarmdsl.execution.simulate.world.runner import Pace
from swarmdsl.execution.simulate.world.world import World
from swarmdsl.execution.testing.case import (
    Arrive,
    Case,
    Claim,
    End,
    Expect,
    Lose,
    Pass,
    Send,
    Step,
    actions,
)
from swarmdsl.execution.testing.recorder import Recorder
from swarmdsl.execution.testing.run_result import Failure, RunResult, endless_reaction

_NOBODY = "nobody handles it"


class _FailedError(Exception):
    """A step or claim failed."""

    def __init__(self, place: Span, expected: str, actual: str) -> None:
        super().__init__(expected)
        self.place = place
        self.expected = expected
        self.actual = actual


class _ViolatedError(Exception):
    """A property is violated that must hold."""

    def __init__(self, place: Span, violation: Violation) -> None:
        super().__init__(violation.property.name)
        self.place = place
        self.violation = violation


def run_case(
    case: Case,
    seed: int,
    listener: Callable[[Line], None],
    recorder: Recording | None = None,
    pace: Pace | None = None,
    reached: Callable[[Span], None] = lambda place: None,
) -> RunResult:
    """Run a test until its end or first failure; the recorder keeps the lines of the run.

    A pace waits before time passes; `reached` gets the place of each step.
    """
    run = _CaseRun(case, seed, listener, pace, reached)
    if recorder is not None:
        run.tell(recorder)
    return run.run_case()


class _CaseRun:
    def __init__(
        self,
        case: Case,
        seed: int,
        listener: Callable[[Line], None],
        pace: Pace | None,
        reached: Callable[[Span], None],
    ) -> None:
        self._case = case
        self._pace = pace
        self._reached = reached
        robots = case.subject.create_robots(case.scenario.counts, case.scenario.alone)
        # Actors are not reusable: a run changes their data.
        self._cast = actors(case.subject, robots, case.scenario, Diagnostics())
        self._recorder = Recorder(self._cast, lambda actor: self._world.data(actor), self._verdict)
        self._listeners = [self._recorder.see, listener]
        watched = case.watched
        self._watch: Watch | None = None
        self._remarks: dict[str, str] = {}
        self._skipped = 0
        self._recording: Recording | None = None
        self._arrivals: dict[tuple[str, str | None], int] = {}
        """Events and receivers that steps name, with the last of these steps."""
        for number, step in enumerate(case.steps):
            for each in actions(step):
                if isinstance(each, Arrive):
                    self._arrivals.update({(each.event, robot): number for robot in each.robots})
        self._fitness = fitness_of(case.subject) if case.measures else None
        if watched or self._fitness is not None:
            planned = plan(watched, measures_of(self._fitness))
            self._watch = watch(planned, lambda actor: self._world.data(actor))
            self._listeners.append(self._watch.see)
        self._world = World(
            case.subject.system,
            self._cast,
            case.scenario,
            seed,
            self._listeners,
            case.subject.heartbeat,
            case.spaces.alone(seed),
        )

    def tell(self, recorder: Recording) -> None:
        """Let a recorder keep the lines of the run."""
        lines = RunLines(self._world, recorder.write)
        recorder.begin(self._case.subject, self._cast, None, self._world)
        self._listeners.append(lines.step)
        self._world.network.transmitted = lines.transmitted
        self._recording = recorder

    def run_case(self) -> RunResult:
        failure = self._failed()
        if self._recording is not None:
            self._recording.end(self._world.clock.now)
        return RunResult(failure, tuple(self._world.failures), self._remarks, self._skipped)

    def _failed(self) -> Failure | None:
        place = self._case.place
        for event, robot in self._arrivals:
            self._world.network.hold(event, robot)
        try:
            self._world.begin()
            self._pass(0)
            for number, step in enumerate(self._case.steps):
                place = step.place
                self._reached(place)
                self._do(step)
                self._release(number)
            self._judge_properties()
            self._judge_measures()
        except _FailedError as failed:
            now = self._world.clock.now
            when = f"after {format_duration(now)}" if now else "at the start"
            fields = {"expected": failed.expected}
            label = f"{when}: {failed.actual}"
            self._world.trace.flush()
            return self._failure("failed-expectation", failed.place, fields, label)
        except _ViolatedError as violated:
            return self._violation(violated.place, violated.violation)
        except LoopError as error:
            now, last = self._world.clock.now, self._recorder.last
            self._world.trace.flush()
            return endless_reaction(error, place, self._case.subject.name, now, last)
        except ModelError as error:
            time = format_duration(self._world.clock.now)
            fields = {"function": error.function, "time": time, "reason": error.reason}
            return self._failure("failed-model", place, fields, "the test ends here")
        return None

    def _verdict(self, name: str, robot: str | None) -> Verdict:
        """Return the verdict so far on a property that a claim names."""
        assert self._watch is not None
        return self._watch.verdict(name, robot, self._world.clock.now)

    def _check_properties(self) -> None:
        """Fail when a property is violated that must hold."""
        if self._watch is not None and self._watch.violations:
            places = {each.name: place for each, place in self._case.properties}
            for violation in self._watch.violations:
                if violation.property.name in places:
                    raise _ViolatedError(places[violation.property.name], violation)

    def _judge_properties(self) -> None:
        """Check the verdicts at the end."""
        if self._watch is None:
            return
        self._world.trace.flush()
        results = self._watch.results(self._world.clock.now, ended=self._world.over)
        self._check_properties()
        self._remarks = {each.property.name: each.remark for each in results if each.remark}
        verdicts = {each.property.name: each.verdict for each in results}
        for each, place in self._case.violates:
            if verdicts[each.name] != FALSE:
                raise _FailedError(
                    place,
                    f"property `{each.name}` to be violated",
                    f"its verdict is {verdicts[each.name]}",
                )

    def _judge_measures(self) -> None:
        """Compare the measures and the fitness in the end."""
        if self._watch is None or self._fitness is None:
            return
        readings = self._watch.readings(self._world.clock.now)
        result = evaluate(self._fitness, readings, self._world.space)
        for each in self._case.measures:
            actual = each.differs(result)
            if actual:
                raise _FailedError(each.place, each.text, actual)

    def _violation(self, place: Span, violation: Violation) -> Failure:
        self._world.trace.flush()
        origin = violation.property.origin
        related = (Label(origin, "the property"),) if origin is not None else ()
        label = "this property must hold"
        return self._failure(
            "violated-property", place, violation_fields(violation), label, *related
        )

    def _do(self, step: Step) -> None:
        if isinstance(step, Expect):
            self._expect(step)
            return
        self._recorder.mark()
        match step:
            case Send(event=event, data=data, to=to, sender=sender):
                self._world.deliver(event, data, [self._cast[number] for number in to], sender)
            case End():
                self._end(step)
            case Arrive():
                self._arrive(step)
            case Pass(length=length):
                self._pass(length)
            case Lose(robots=names):
                for robot in self._world.robots:
                    if robot.name in names:
                        self._world.lose(robot)
        self._pass(0)

    def _pass(self, length: int) -> None:
        """Let time pass; with 0, process everything that happens now."""
        self._check_always()
        for _ in self._moments(length):
            self._check_always()

    def _end(self, step: End) -> None:
        called = (self._cast[number] for number in step.of)
        running = [actor for actor in called if self._events(actor, step)]
        if not running:
            expected = f"`{step.function}` to be running"
            self._impossible(step.place, expected, "it is not running")
        for actor in running:
            for event in self._events(actor, step):
                self._world.deliver(event, step.result, [actor])

    def _arrive(self, step: Arrive) -> None:
        network = self._world.network
        reasons = [
            network.take(step.event, robot, step.sender, arrives=not step.lost)
            for robot in step.robots
        ]
        if all(reasons):
            sender = f" of `{step.sender}`" if step.sender is not None else ""
            who = listed([str(robot) for robot in step.robots], "or")
            expected = f"`{step.event}`{sender} to be on its way to {who}"
            self._impossible(step.place, expected, (reasons or [_NOBODY])[0] or "")

    def _impossible(self, place: Span, expected: str, actual: str) -> None:
        """Fail, unless impossible actions are skipped."""
        if not self._case.skips:
            raise _FailedError(place, expected, actual)
        self._skipped += 1

    def _release(self, number: int) -> None:
        """Let events arrive by themselves after the last step that names them."""
        for (event, robot), last in self._arrivals.items():
            if last == number:
                self._world.network.release(event, robot)
                self._pass(0)

    def _events(self, actor: Actor, step: End) -> list[str]:
        """Return the events that end a running function of a machine."""
        runs = [run for run in self._world.runs(actor) if run.activity.name == step.function]
        return [run.activity.events[step.outcome] for run in runs]

    # ---- expectations

    def _expect(self, step: Expect) -> None:
        claim = step.claim
        if step.lasting is not None:
            self._check(claim)
            for _ in self._moments(step.lasting):
                self._check_always()
                self._check(claim)
            return
        if not self._recorder.holds(claim) and step.within is not None:
            for _ in self._wait(step, step.within):
                self._check_always()
                if self._recorder.holds(claim):
                    break
        self._check(claim)
        self._pass(0)

    def _wait(self, step: Expect, length: int) -> Iterator[None]:
        """Let time pass, and what happens meanwhile; yield after each action."""
        if not step.meanwhile:
            yield from self._moments(length)
            return
        clock = self._world.clock
        end = clock.now + length
        for each in cycle(step.meanwhile):
            if clock.now >= end:
                break
            self._reached(each.place)
            if isinstance(each, Pass):
                yield from self._moments(min(each.length, end - clock.now))
            else:
                self._do(each)
            yield
        self._reached(step.place)

    def _check(self, claim: Claim) -> None:
        if not self._recorder.holds(claim):
            raise _FailedError(claim.place, claim.text, self._recorder.describe_actual(claim))

    def _check_always(self) -> None:
        self._check_properties()
        for claim in self._case.always:
            if not self._recorder.holds(claim):
                raise _FailedError(
                    claim.place, f"always {claim.text}", self._recorder.describe_actual(claim)
                )

    def _moments(self, length: int) -> Iterator[None]:
        """Let time pass, and yield after each action."""
        clock = self._world.clock
        end = clock.now + length
        while (due := clock.next) is not None and due <= end:
            if self._pace is not None:
                self._pace.wait(due)
            self._world.step()
            yield
        if self._pace is not None:
            self._pace.wait(end)
        clock.advance(end - clock.now)

    # ---- failures

    def _failure(
        self, code: str, place: Span, fields: dict[str, str], label: str, *related: Label
    ) -> Failure:
        return Failure(code, place, fields, label, related, tuple(self._recorder.last))
