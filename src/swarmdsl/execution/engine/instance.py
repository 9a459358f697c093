"""Interpreter of a state machine: SCXML 1.0, Appendix D."""

from __future__ import annotations

from collections import deque
from typing import Any

from .activity import Run, Servers, Timer
from .configuration import Configuration, Step, before_start
from .table import Effect, Event, Guard, Machine, Origin
from .world import FAILURES, LoopError, Observer, World

_LOOP_STEPS = 100
"""Number of last steps that are searched for the states of a loop."""


class Instance:
    """A machine that runs in a world.

    Call `start` once, then `receive` for each event, which is processed to completion before the
    call returns. `final` is the id of the final state in which the machine ended.

    Guards and effects use `data`; `observer` may be set at any time. Instances of one robot share
    `servers`.
    """

    __slots__ = (
        "_busy",
        "_deferred",
        "_during",
        "_entries",
        "_external",
        "_internal",
        "_is_deferred",
        "_pending",
        "_runs",
        "_timers",
        "configuration",
        "data",
        "final",
        "machine",
        "observer",
        "running",
        "servers",
        "world",
    )

    def __init__(
        self,
        machine: Machine,
        world: World,
        *,
        data: Any = None,
        observer: Observer | None = None,
        servers: Servers | None = None,
    ) -> None:
        self.machine = machine
        self.world = world
        self.data = machine.data() if data is None else data
        self.observer = observer
        self.servers = servers
        self.configuration = before_start(machine)
        self.running = False
        self.final: str | None = None
        self._busy = False
        # Active states during a step.
        self._during: int | None = None
        self._external: deque[Event] | None = None
        self._deferred: deque[Event] | None = None
        # True if the last selection found that the event is deferred.
        self._is_deferred = False
        self._internal: deque[Event] | None = None
        # Times at which timed states were entered.
        self._entries: dict[str, int] = {}
        self._pending: list[int] | None = None
        self._runs: dict[int, Run] | None = None
        self._timers: list[Timer] | None = None

    # ---- called by a host

    def start(self) -> None:
        """Enter the machine; raise LoopError if it does not reach a stable configuration."""
        if self.running or self.final is not None:
            raise RuntimeError(f"an instance of `{self.machine.name}` can only be started once")
        self.running = self._busy = True
        try:
            event = Event("")
            for effect in self.machine.setup:
                self._do(effect, event)
            entry = self.machine.entries[0]
            assert entry is not None
            self._take(self.configuration.step((entry,)), event)
            self._settle(event)
            self._receive_waiting()
        finally:
            self._busy = False
            self._during = None

    def receive(self, event: Event) -> None:
        """Process an event from outside; during another one, queue it.

        Ignored before the start and after the end. Raises LoopError if the machine does not reach
        a stable configuration, which ends it.
        """
        if self._busy:
            if self._external is None:
                self._external = deque()
            self._external.append(event)
        elif self.running:
            self._busy = True
            try:
                self._run(event)
                if self._external:
                    self._receive_waiting()
            finally:
                self._busy = False
                self._during = None

    def stop(self) -> None:
        """End the machine: exit all states, cancel delays and activities."""
        if self.running:
            self.running = False
            if not self._busy:
                self._end(Event(""))

    # ---- called by guards and effects

    def active(self, state: str) -> bool:
        """Return True if a state is active: `In` of SCXML."""
        active = self.configuration.active if self._during is None else self._during
        return bool(active >> self.machine.numbers[state] & 1)

    def elapsed(self, state: str) -> int:
        """Return for how long an active, timed state has been active, in nanoseconds."""
        return self.world.time - self._entries[state]

    @property
    def time(self) -> int:
        """Return the time of the world in nanoseconds."""
        return self.world.time

    def raise_event(self, event: Event) -> None:
        """Append an event to the internal queue, which precedes events from outside."""
        if self._internal is None:
            self._internal = deque()
        self._internal.append(event)

    def send_after(self, event: Event, delay: int, id_: str = "") -> None:
        """Send an event to this instance after a delay in nanoseconds."""
        self._begin_timer(Timer(self, event, id_), delay)

    def emit_after(self, event: Event, delay: int, id_: str = "") -> None:
        """Send an event to the world after a delay in nanoseconds; its id is `send.<name>`."""
        name = f"send.{event.name}"
        if self.observer is not None:
            self.observer.scheduled(self, event, max(delay, 0))
        self._begin_timer(Timer(self, Event(name), id_ or name, event), delay)

    def cancel(self, id_: str) -> None:
        """Cancel the delayed events with an id."""
        for timer in [each for each in self._timers or () if each.id == id_]:
            self._unschedule(timer)
            if timer.message is not None and self.observer is not None:
                self.observer.withdrawn(self, timer.message)

    def fail(self, error: Exception) -> None:
        """Report an error to the world and raise `error.execution`."""
        self.world.failed(self, error)
        self.raise_event(Event("error.execution", str(error)))

    def emit(self, event: Event) -> None:
        """Send an event to the world."""
        if self.observer is not None:
            self.observer.sent(self, event)
        self.world.send(self, event)

    def note_entry(self, state: str) -> None:
        """Note the time at which a timed state is entered."""
        self._entries[state] = self.world.time

    def stop_activity(self, state: int) -> None:
        """Cancel the activity of an exited state."""
        if self._pending and state in self._pending:
            self._pending.remove(state)
        run = self._runs.pop(state, None) if self._runs is not None else None
        if run is not None:
            run.over = True
            if not run.ended:
                if self.observer is not None:
                    self.observer.cancelled(self, run)
                assert self.servers is not None
                self.servers.cancel(run)

    # ---- the algorithm

    def _run(self, event: Event) -> None:
        """Run the macrostep of an event from outside."""
        origin = event.origin
        if origin is not None and not self._accept(origin, event):
            return
        if self.observer is not None:
            self.observer.received(self, event)
        if isinstance(origin, Timer) and origin.message is not None:
            self._do(_emission(origin.message), event)
            if self._internal:
                self._settle(event)
            return
        before = self.configuration
        step = self._select(event.name, event)
        if step is None and self._is_deferred:
            self._defer(event)
        self._finish(step, event)
        if self._deferred and self.configuration is not before:
            self._recall()

    def _finish(self, step: Step | None, event: Event) -> None:
        """Finish the macrostep of an event, given the step that it enables."""
        if step is not None:
            self._take(step, event)
            if step.quiet and self.running and not self._internal:
                return
        else:
            if not self._is_deferred and self.observer is not None:
                self.observer.ignored(self, event)
            if self.running and not self._internal and not self.configuration.restless:
                return
        self._settle(event)

    def _defer(self, event: Event) -> None:
        """Keep an event that the active states defer; forget the oldest of too many."""
        if self._deferred is None:
            self._deferred = deque()
        if len(self._deferred) >= self.machine.most_deferred:
            oldest = self._deferred.popleft()
            if self.observer is not None:
                self.observer.dropped(self, oldest)
        self._deferred.append(event)
        if self.observer is not None:
            self.observer.deferred(self, event)

    def _recall(self) -> None:
        """Process the events that are no longer deferred, in order of arrival.

        After one that changed the configuration, the examination begins again.
        """
        number = 0
        while self.running and self._deferred and number < len(self._deferred):
            before, event = self.configuration, self._deferred[number]
            step = self._select(event.name, event)
            if step is None and self._is_deferred:
                number += 1
                # A guard that failed has raised an error.
                if self._internal:
                    self._settle(event)
            else:
                del self._deferred[number]
                if self.observer is not None:
                    self.observer.recalled(self, event)
                    self.observer.received(self, event)
                self._finish(step, event)
            if self.configuration is not before:
                number = 0

    def _settle(self, event: Event) -> None:
        """Take steps without an event or with an internal one, until none is enabled."""
        steps = 0
        passed: list[Configuration] = []
        while self.running:
            steps += 1
            if steps > self.machine.limit - _LOOP_STEPS:
                passed.append(self.configuration)
                if steps > self.machine.limit:
                    self._give_up(passed)
            step = self._select("", event) if self.configuration.restless else None
            if step is None:
                if self._internal:
                    event = self._internal.popleft()
                    if self.observer is not None:
                        self.observer.received(self, event)
                    step = self._select(event.name, event)
                elif self._pending:
                    self._start_activities()
                elif self.running:
                    return
            if step is not None:
                self._take(step, event)
        self._end(event)

    def _select(self, name: str, event: Event) -> Step | None:
        """selectTransitions: return the step that an event, or no event, enables."""
        self._is_deferred = False
        decision = self.configuration.decide(name)
        if not decision.candidates:
            return decision.step
        enabled, self._is_deferred = decision.choose(self, event)
        return self.configuration.step(enabled) if enabled else None

    def holds(self, guard: Guard, event: Event) -> bool:
        """Return True if a guard holds; False if it fails."""
        try:
            return bool(guard(self, event))
        except FAILURES as error:
            self.fail(error)
            return False

    def _take(self, step: Step, event: Event) -> None:
        """microstep: execute the program, then enter the next configuration."""
        program = step.program if self.observer is None else step.traced
        if program:
            for active, operation in program:
                self._during = active
                try:
                    operation(self, event)
                except FAILURES as error:
                    self.fail(error)
            self._during = None
        self.configuration = step.target
        if step.starts:
            self._pending = [*(self._pending or ()), *step.starts]
        if step.final:
            self.final = self.machine.states[step.final].id
            self.running = False

    def _do(self, effect: Effect, event: Event) -> None:
        try:
            effect(self, event)
        except FAILURES as error:
            self.fail(error)

    def _accept(self, origin: Origin, event: Event) -> bool:
        """Return True if an event of this instance is still valid: its state is active."""
        if origin.over:
            return False
        origin.over = True
        if isinstance(origin, Timer):
            assert self._timers is not None
            self._timers.remove(origin)
        elif isinstance(origin, Run):
            assert self._runs is not None
            del self._runs[origin.state]
            activity = origin.activity
            if activity.finalize is not None and event.name == activity.events["succeeded"]:
                self._do(activity.finalize, event)
        return True

    def _start_activities(self) -> None:
        """Start the activities of the states entered in this macrostep."""
        pending, self._pending = sorted(self._pending or ()), None
        if self.servers is None:
            self.servers = Servers()
        if self._runs is None:
            self._runs = {}
        for state in pending:
            activity = self.machine.states[state].activity
            assert activity is not None
            run = self._runs[state] = Run(self, state, activity)
            try:
                run.goal = activity.goal(self) if activity.goal is not None else None
            except FAILURES as error:
                self.fail(error)
                run.end("aborted")
                continue
            if self.observer is not None:
                self.observer.started(self, run)
            self.servers.start(run)

    def _receive_waiting(self) -> None:
        """Process the events received during another one, such as delays of zero."""
        events = 0
        passed: list[Configuration] = []
        while self._external:
            event = self._external.popleft()
            if self.running:
                events += 1
                if events > self.machine.limit - _LOOP_STEPS:
                    passed.append(self.configuration)
                    if events > self.machine.limit:
                        self._give_up(passed)
                self._run(event)
        self._external = None

    def _begin_timer(self, timer: Timer, delay: int) -> None:
        if self._timers is None:
            self._timers = []
        self._timers.append(timer)
        if delay > 0:
            timer.handle = self.world.schedule(delay, timer.fire)
        else:
            self.receive(timer.event)

    def _unschedule(self, timer: Timer) -> None:
        assert self._timers is not None
        self._timers.remove(timer)
        timer.over = True
        if timer.handle is not None:
            self.world.unschedule(timer.handle)

    def _end(self, event: Event) -> None:
        """Procedure exitInterpreter."""
        self._take(self.configuration.end(), event)
        self._forget()

    def _forget(self) -> None:
        """Drop all pending events of an ended machine."""
        for timer in list(self._timers or ()):
            self._unschedule(timer)
        self._internal = self._external = self._deferred = self._pending = None

    def _give_up(self, passed: list[Configuration]) -> None:
        """End a machine in an endless loop, without the exit effects."""
        self.running = False
        for state in list(self._runs or ()):
            self.stop_activity(state)
        self._forget()
        sets = [set(each.ids) for each in passed]
        states = {
            state for each in sets for state in each if not all(state in other for other in sets)
        } or set(passed[-1].innermost)
        raise LoopError(self.machine.name, sorted(states, key=self.machine.numbers.__getitem__))


def _emission(message: Event) -> Effect:
    """Return the effect that sends an event to the world."""
    return lambda instance, event: instance.emit(message)
