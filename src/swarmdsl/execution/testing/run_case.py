"""Runs one test with one seed, in virtual time."""

from __future__ import annotations

from collections.abc import Callable, Iterator

from swarmdsl.base.diagnostics.collector import Diagnostics, Label, listed
from swarmdsl.base.records import dataclass
from swarmdsl.base.source import Span
from swarmdsl.execution.engine import LoopError
from swarmdsl.execution.simulate.actors import Actor, actors
from swarmdsl.execution.simulate.durations import shown
from swarmdsl.execution.simulate.trace import Line
from swarmdsl.execution.simulate.world import World
from swarmdsl.execution.testing.case import Case, Claim, End, Expect, Lose, Pass, Send, Step
from swarmdsl.execution.testing.recorder import Witness


@dataclass(frozen=True)
class Played:
    """What came of a run; `faults` are what guards and effects had no value for, by machine."""

    failure: Failure | None
    faults: tuple[tuple[str, str], ...]


@dataclass(frozen=True)
class Failure:
    """What a run failed at: the diagnostic that says so, in its parts, and what came before."""

    code: str
    place: Span
    fields: dict[str, str]
    label: str
    related: tuple[Label, ...]
    last: tuple[Line, ...]


class _FailedError(Exception):
    """The run has failed at a step."""

    def __init__(self, place: Span, expected: str, told: str) -> None:
        super().__init__(expected)
        self.place = place
        self.expected = expected
        self.told = told


def play(case: Case, seed: int, listener: Callable[[Line], None]) -> Played:
    """Run a test to its end, or to what it fails at."""
    return _Play(case, seed, listener).play()


class _Play:
    def __init__(self, case: Case, seed: int, listener: Callable[[Line], None]) -> None:
        self._case = case
        robots = case.subject.crew(case.scenario.counts)
        # Those of another run are no longer as they began.
        self._cast = actors(case.subject, robots, case.scenario, Diagnostics())
        self._witness = Witness(self._cast, lambda actor: self._world.data(actor))
        listeners = [self._witness.see, listener]
        self._world = World(case.subject.system, self._cast, case.scenario, seed, listeners)

    def play(self) -> Played:
        failure = self._failed()
        return Played(failure, tuple(self._world.failures))

    def _failed(self) -> Failure | None:
        place = self._case.place
        try:
            self._world.begin()
            self._pass(0)
            for step in self._case.steps:
                place = step.place
                self._do(step)
        except _FailedError as failed:
            now = self._world.clock.now
            when = f"after {shown(now)}" if now else "at the start"
            fields = {"expected": failed.expected}
            label = f"{when}: {failed.told}"
            self._world.trace.flush()
            return self._failure("failed-expectation", failed.place, fields, label)
        except LoopError as error:
            return self._loop(error, place)
        return None

    def _do(self, step: Step) -> None:
        if isinstance(step, Expect):
            self._expect(step)
            return
        self._witness.mark()
        match step:
            case Send(event=event, data=data, to=to):
                self._world.deliver(event, data, [self._cast[number] for number in to])
            case End():
                self._end(step)
            case Pass(length=length):
                self._pass(length)
            case Lose(robots=names):
                for robot in self._world.robots:
                    if robot.name in names:
                        self._world.lose(robot)
        self._pass(0)

    def _pass(self, length: int) -> None:
        """Let time pass; none, for all that happens at this moment."""
        self._check_always()
        for _ in self._moments(length):
            self._check_always()

    def _end(self, step: End) -> None:
        running = [actor for actor in self._actors(step.of) if self._events(actor, step)]
        if not running:
            raise _FailedError(step.place, f"`{step.function}` to be running", "nobody runs it")
        for actor in running:
            for event in self._events(actor, step):
                self._world.deliver(event, step.result, [actor])

    def _events(self, actor: Actor, step: End) -> list[str]:
        """The events that are the ends of a function that a machine is running."""
        runs = [run for run in self._world.runs(actor) if run.activity.name == step.function]
        return [run.activity.events[step.outcome] for run in runs]

    def _actors(self, numbers: tuple[int, ...]) -> list[Actor]:
        return [self._cast[number] for number in numbers]

    # ---- what is expected

    def _expect(self, step: Expect) -> None:
        claim = step.claim
        if step.lasting is not None:
            self._check(claim)
            for _ in self._moments(step.lasting):
                self._check_always()
                self._check(claim)
            return
        if not self._witness.holds(claim) and step.within is not None:
            for _ in self._moments(step.within):
                self._check_always()
                if self._witness.holds(claim):
                    break
        self._check(claim)
        self._pass(0)

    def _check(self, claim: Claim) -> None:
        if not self._witness.holds(claim):
            raise _FailedError(claim.place, claim.text, self._witness.told(claim))

    def _check_always(self) -> None:
        for claim in self._case.always:
            if not self._witness.holds(claim):
                raise _FailedError(claim.place, f"always {claim.text}", self._witness.told(claim))

    def _moments(self, length: int) -> Iterator[None]:
        """Let time pass, and stop after all that happens on the way."""
        clock = self._world.clock
        end = clock.now + length
        while (due := clock.next) is not None and due <= end:
            self._world.step()
            yield
        clock.advance(end - clock.now)

    # ---- failures

    def _loop(self, error: LoopError, place: Span) -> Failure:
        self._world.trace.flush()
        states = set(error.states)
        actors = [line.actor for line in self._witness.last]
        going = [actor for actor in actors if states <= actor.machine.numbers.keys()]
        who = going[-1].name or self._case.subject.name if going else self._case.subject.name
        related = []
        for state in error.states if going else ():
            machine = going[-1].machine
            origin = getattr(machine.states[machine.numbers[state]].origin, "origin", None)
            if isinstance(origin, Span):
                related.append(Label(origin, "part of the loop"))
        fields = {"who": f"`{who}`", "time": shown(self._world.clock.now)}
        label = f"it loops through {listed(error.states, 'and')}"
        return self._failure("never-settles", place, fields, label, tuple(related))

    def _failure(
        self,
        code: str,
        place: Span,
        fields: dict[str, str],
        label: str,
        related: tuple[Label, ...] = (),
    ) -> Failure:
        return Failure(code, place, fields, label, related, tuple(self._witness.last))
