"""One robot with its machines, driven input by input: a world of the engine without time."""

from __future__ import annotations

from collections import deque
from collections.abc import Callable, Iterator, Mapping, Sequence
from functools import partial
from typing import Any

from swarmdsl import ir
from swarmdsl.codegen.shared.default_values import default_result
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
from swarmdsl.execution.simulate.machines.headers import signed
from swarmdsl.execution.simulate.network.members import DEPARTED, JOINED, Roster
from swarmdsl.execution.simulate.scenario.clock import Clock
from swarmdsl.execution.simulate.world.line import Line
from swarmdsl.execution.simulate.world.trace import Trace
from swarmdsl.execution.verify.robot.choices import Nearness
from swarmdsl.execution.verify.robot.membership import Crew
from swarmdsl.execution.verify.robot.tasks import Absence, Delay, Input, Task, Wait


class Body:
    """The machines of a robot; `lines` and `sent` are what the last input led to."""

    def __init__(
        self,
        cast: Sequence[Actor],
        system: ir.System | None,
        clock: Clock,
        crew: Crew | None = None,
        silent: frozenset[str] = frozenset(),
        others: int = 0,
        absences: Sequence[int] = (),
    ) -> None:
        self.seen: Callable[[Line], None] | None = None
        """Listener to the lines, called when the data are as after the line."""
        self.cast = cast
        self.clock = clock
        self.lines: list[Line] = []
        self.sent: list[Event] = []
        self.failures: list[str] = []
        self.loop: LoopError | None = None
        self.inside: deque[Event] = deque()
        self.runs: list[tuple[int, Run]] = []
        self.delays: list[Delay] = []
        self.every_delay: list[Delay] = []
        self.waits: list[Wait] = []
        """All calls and inner events."""
        self.steps = 0
        self._system = system
        self.trace = Trace(clock, [self._see])
        self.used: set[tuple[str, int]] = set()
        """Events from outside that have come, of those that come once."""
        self.is_lost = False
        self.absences: list[Absence] = []
        """Times in which the robot was lost, if it starts anew after each."""
        self._lengths = absences
        self.near = Nearness(others)
        self._silent = silent
        self.crew = crew
        self.roster: Roster | None = None
        """Robots that it takes for present; None if none of its machines asks."""
        if crew is not None and any(map(crew.observes, cast)):
            self.roster = Roster(crew.robots)
        self.instances = self._made()

    @property
    def missed(self) -> int:
        """Number of robots that it takes for lost."""
        return len(list(self.roster.missing)) if self.roster is not None else 0

    @property
    def running(self) -> bool:
        """True unless all machines have ended."""
        return any(instance.running for instance in self.instances)

    def start(self) -> None:
        """Start all machines."""
        for instance in self.instances:
            self.trace.begin(instance, None)
            self._guarded(instance.start)
        self._forget_ended()

    def inputs(self) -> Iterator[Input]:
        """Yield what can happen by itself: ends of activities and delays, inner events, returns."""
        if self._is_away:
            yield Input("return", -1, "")
        if not self.running:
            return
        for number, run in self.runs:
            yield Input("end", number, run.activity.name, run.state)
        seen: set[tuple[int, str]] = set()
        for delay in self.delays:
            key = (delay.actor, delay.timer.id)
            if key not in seen or delay.timer.message is not None:
                same = [d for d in self.delays if (d.actor, d.timer.id) == key]
                yield Input("time", delay.actor, delay.timer.id, same.index(delay))
            seen.add(key)
        if self.inside:
            yield Input("inside", -1, self.inside[0].name)

    def tasks(self) -> Iterator[tuple[Task, object]]:
        """Yield what is over some time, each with the object that stands for it.

        A function that may never answer is not among it.
        """
        for task, each in self.all_tasks():
            if not (isinstance(each, Run) and each.activity.name in self._silent):
                yield task, each

    def all_tasks(self) -> Iterator[tuple[Task, object]]:
        """Yield what is running or waits, also a function that may never answer."""
        if self._is_away:
            yield ("return", -1, ""), self.absences[-1]
        if not self.running:
            return
        for number, run in self.runs:
            yield ("end", number, run.state), run
        for delay in self.delays:
            yield ("time", delay.actor, delay.timer.id), delay
        for event in self.inside:
            yield ("inside", -1, ""), event

    def end(self, given: Input, outcome: str, result: Mapping[str, Any] | None) -> None:
        """End an activity."""
        self._begin()
        number, run = next(
            r for r in self.runs if r[0] == given.actor and r[1].state == given.choice
        )
        self.runs.remove((number, run))
        self._over(run, fired=True)
        data: Any = None
        if outcome == "succeeded":
            data = dict(result or {})
            call = self._call(run)
            if call is not None:
                data = {**default_result(call, self._system), **data} if self._system else data
                if data.get("success") is False and call.paradigm == "service":
                    outcome = run.activity.refused
        self._guarded(lambda: run.end(outcome, data))
        self._forget_ended()

    def fire(self, given: Input) -> None:
        """Let a delay end."""
        self._begin()
        same = [d for d in self.delays if (d.actor, d.timer.id) == (given.actor, given.name)]
        delay = same[given.choice]
        self.delays.remove(delay)
        delay.ended, delay.fired = self.steps, True
        self._guarded(delay.timer.fire)
        self._forget_ended()

    def deliver_inside(self) -> None:
        """Deliver the first event that the robot has sent to itself."""
        event = self.inside.popleft()
        self._deliver(event)
        self._over(event, fired=True)

    def receive(self, event: Event) -> None:
        """Receive an event from outside, or from another robot."""
        self._deliver(event)

    def lose(self) -> None:
        """Stop all machines; what is running stops with them."""
        self._begin()
        for instance in self.instances:
            if instance.running:
                self.trace.begin(instance, LOST)
                instance.running = False
                self.trace.flush()
        for delay in self.delays:
            delay.ended = self.steps
        for wait in self.waits:
            wait.ended = wait.ended if wait.ended is not None else self.steps
        self.is_lost = True
        self.runs.clear()
        self.delays.clear()
        self.inside.clear()
        if len(self.absences) < len(self._lengths):
            self.absences.append(Absence(self.steps, self._lengths[len(self.absences)]))
        if self.crew is not None and self.crew.tells:
            robot = self.cast[0].robot
            self.sent.append(Event(DEPARTED, {"id": robot.name or "", "role": robot.role}))

    def come_back(self) -> None:
        """Start all machines anew; the robot takes all others for present."""
        self._begin()
        self.is_lost = False
        self.absences[-1].ended = self.steps
        if self.roster is not None:
            self.roster.clear()
        self.instances = self._made()
        self.start()

    # ---- internal

    @property
    def _is_away(self) -> bool:
        return bool(self.absences) and self.absences[-1].ended is None

    def _made(self) -> list[Instance]:
        """Return new instances of the machines."""
        servers = Servers()
        made = []
        for number, actor in enumerate(self.cast):
            data = {**copied(actor.data), **self.near.functions}
            if self.roster is not None:
                data[PRESENT] = self.roster.count
            made.append(Instance(actor.machine, _Desk(self, number), data=data, servers=servers))
            self.trace.watch(made[-1], actor)
        return made

    def _see(self, line: Line) -> None:
        self.lines.append(line)
        if self.seen is not None:
            self.seen(line)

    def _begin(self) -> None:
        self.lines.clear()
        self.sent.clear()
        self.failures.clear()
        self.steps += 1

    def _deliver(self, event: Event) -> None:
        self._begin()
        is_about_member = event.name in (JOINED, DEPARTED)
        if is_about_member and self.roster is not None:
            self.roster.note(event.name, event.data)
        for instance, actor in zip(self.instances, self.cast, strict=True):
            observes = is_about_member and self.crew is not None and self.crew.observes(actor)
            if instance.running and (observes or actor.listens(event.name)):
                self.trace.begin(instance, event.name, event.data, event.envelope)
                self._guarded(partial(instance.receive, event))
        self._forget_ended()

    def _guarded(self, action: Callable[[], None]) -> None:
        self.near.begin_macrostep()
        try:
            action()
        except LoopError as error:
            self.loop = error
        self.trace.flush()

    def _over(self, task: object, *, fired: bool) -> None:
        wait = next(each for each in self.waits if each.task is task)
        wait.ended, wait.fired = self.steps, fired

    def _forget_ended(self) -> None:
        if not self.running:
            for event in self.inside:
                self._over(event, fired=False)
            self.inside.clear()

    def _call(self, run: Run) -> ir.Communication | None:
        if self._system is None:
            return None
        return self._system.function(run.activity.name).communication

    # ---- called by the engine, by way of the desks

    def schedule(self, actor: int, length: int, action: Callable[[], None]) -> Delay:
        """Keep a delay."""
        made = Delay(actor, action, length, self.steps)
        self.delays.append(made)
        self.every_delay.append(made)
        return made

    def unschedule(self, delay: Delay) -> None:
        """Cancel a delay."""
        self.delays.remove(delay)
        delay.ended = self.steps

    def call(self, actor: int, run: Run) -> None:
        """Keep the call of a function."""
        self.runs.append((actor, run))
        self.waits.append(Wait(run, run.activity.name, self.steps))

    def cancel(self, actor: int, run: Run) -> None:
        """Forget the call of a function."""
        self.runs.remove((actor, run))
        self._over(run, fired=False)

    def emit(self, actor: int, event: Event) -> None:
        """Take an event that a machine sends."""
        system = self._system
        if system is None:
            return
        robot, to = self.cast[actor].robot, event.envelope.to
        declared = system.event(event.name)
        data = signed(declared, event.data, system, robot.name or "", self.clock.now)
        heard = [each for each in system.events if each.incoming_topic == declared.topic]
        for each in heard if to is None else ():
            if any(one.listens(each.name) for one in self.cast):
                self.inside.append(Event(each.name, data))
                self.waits.append(Wait(self.inside[-1], None, self.steps))
        if declared.swarm:
            envelope = Envelope(robot.name or "", self.clock.now, to)
            self.sent.append(Event(event.name, data, envelope=envelope))


class _Desk:
    """`World` of one machine of a body."""

    def __init__(self, body: Body, actor: int) -> None:
        self._body = body
        self._actor = actor

    @property
    def time(self) -> int:
        """Return the time of the body in nanoseconds."""
        return self._body.clock.now

    def schedule(self, delay: int, action: Callable[[], None]) -> Delay:
        """Keep the delay; it ends at any time."""
        return self._body.schedule(self._actor, delay, action)

    def unschedule(self, handle: Delay) -> None:
        """Cancel the delay."""
        self._body.unschedule(handle)

    def start(self, run: Run) -> None:
        """Keep the run; it ends at any time."""
        self._body.call(self._actor, run)

    def cancel(self, run: Run) -> None:
        """Free the server at once: an activity that waits for it takes only longer."""
        self._body.cancel(self._actor, run)
        run.end("preempted")

    def send(self, instance: InstanceLike, event: Event) -> None:
        """Pass the event on."""
        self._body.emit(self._actor, event)

    def failed(self, instance: InstanceLike, error: Exception) -> None:
        """Keep the reason."""
        self._body.failures.append(str(error))
