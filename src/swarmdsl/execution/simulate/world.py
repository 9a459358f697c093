"""Simulated world: servers with response times, a network, and faults."""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Iterable, Mapping, Sequence
from copy import deepcopy
from typing import Any

from swarmdsl.codegen.shared.default_values import default_result
from swarmdsl.execution.engine import (
    NO_ENVELOPE,
    Envelope,
    Event,
    Instance,
    InstanceLike,
    Run,
    Servers,
)
from swarmdsl.execution.monitor import LOST
from swarmdsl.execution.simulate.actors import Actor
from swarmdsl.execution.simulate.clock import Alarm, Clock
from swarmdsl.execution.simulate.durations import draw
from swarmdsl.execution.simulate.expressions import PRESENT
from swarmdsl.execution.simulate.headers import signed
from swarmdsl.execution.simulate.members import Members, following
from swarmdsl.execution.simulate.network import Network
from swarmdsl.execution.simulate.random_source import RandomSource
from swarmdsl.execution.simulate.scenario import (
    EVERY_FUNCTION,
    Fault,
    FunctionBehavior,
    Message,
    Robot,
    Scenario,
    is_selected,
)
from swarmdsl.execution.simulate.statistics import Life
from swarmdsl.execution.simulate.trace import Line, Trace
from swarmdsl.ir import Heartbeat, System

_OF_ACTIVITIES = "do."
"""Prefix of activity events, in tables of models and in our SCXML."""


class World:
    """All machines in virtual time; a `World` of the engine.

    Events between machines go through the clock, so that no machine is in a step when an event
    arrives.
    """

    def __init__(
        self,
        system: System | None,
        actors: Iterable[Actor],
        scenario: Scenario,
        seed: int,
        listeners: Sequence[Callable[[Line], None]],
        heartbeat: Heartbeat | None = None,
    ) -> None:
        self.clock = Clock()
        self.trace = Trace(self.clock, listeners)
        self.failures: Counter[tuple[str, str]] = Counter()
        """Failures of guards and effects, by machine and reason."""
        self.outcomes: Counter[tuple[str, str]] = Counter()
        """Outcomes of activities, by function and outcome."""
        self.nobody: Counter[str] = Counter()
        """Numbers of swarm events with an address that no other robot has."""
        self._system = system
        self._scenario = scenario
        self._chance = RandomSource(seed)
        self.network = Network(
            self.clock,
            scenario,
            self._chance,
            lambda event, robot: self._deliver(event, self.listeners(event.name, robot)),
            lambda event, robot: bool(self.listeners(event, robot)),
            self._miss,
        )
        self._calls: Counter[tuple[str | None, str]] = Counter()
        self._ends: dict[Run, Alarm | None] = {}
        self._listeners: dict[tuple[str, str | None], list[Actor]] = {}
        self._silent: Counter[tuple[Robot, str]] = Counter()
        """Number of current silences of a function."""
        self._behaviors: dict[tuple[str, str | None], FunctionBehavior] = {}
        self._audiences: dict[str, list[tuple[Robot, list[Life]]]] = {}
        """Robots that listen to an event, with the instances that do."""
        self._blanks: dict[str, Mapping[str, Any]] = {}
        self._unheard: list[Run] = []
        self._returning = 0
        """Number of lost robots that will come back."""
        self._instances: dict[Actor, Instance] = {}
        self._actors: dict[InstanceLike, Actor] = {}
        self._one: Instance | None = None
        """An instance that was running when somebody asked."""
        self._machines: dict[str | None, list[Actor]] = {}
        servers: dict[Robot, Servers] = {}
        for actor in actors:
            self._machines.setdefault(actor.robot.name, []).append(actor)
            shared = servers.setdefault(actor.robot, Servers())
            instance = Instance(actor.machine, self, data=actor.data, servers=shared)
            self.trace.watch(instance, actor)
            self._instances[actor] = instance
            self._actors[instance] = actor
        self.robots = list(servers)
        self._following = following(system)
        self.members = Members(
            self.clock,
            heartbeat,
            self.robots,
            [robot for robot in self.robots if self._observers(robot)],
            self._hears,
            self._tell_member,
        )
        for actor in self._instances:
            if actor.robot in self.members.rosters:
                actor.data[PRESENT] = self._presence(actor.robot)
        comes_back = any(each.lasts is not None and each.is_loss for each in scenario.faults)
        self._first_data = {
            actor: deepcopy(actor.data) for actor in (self._instances if comes_back else ())
        }

    # ---- called by a run

    def begin(self) -> None:
        """Start all machines and schedule the scenario."""
        self.trace.attach()
        if self._scenario.loss >= 1:
            self.members.follow()
        for instance in self._instances.values():
            self.trace.begin(instance, None)
            instance.start()
            self.trace.flush()
        said: Counter[str] = Counter()
        for message in self._scenario.messages:
            said[message.event] += 1
            for robot in self.robots:
                if is_selected(robot, message.to) and robot.name != message.sender:
                    chance = self._chance.stream(
                        robot.name, "hears", message.event, said[message.event]
                    )
                    self.clock.schedule(message.at.draw(chance), self._message(message, robot))
        for number, fault in enumerate(self._scenario.faults):
            if fault.apart:
                chance = self._chance.stream("fault", number)
                self.clock.schedule(fault.at.draw(chance), self._partition(fault))
                continue
            for robot in self.robots:
                if is_selected(robot, fault.of):
                    chance = self._chance.stream(robot.name, "fault", number)
                    self.clock.schedule(fault.at.draw(chance), self._fault(fault, robot))

    @property
    def over(self) -> bool:
        """True if no machine is running, and no robot comes back."""
        if self._one is None or not self._one.running:
            running = (instance for instance in self._instances.values() if instance.running)
            self._one = next(running, None)
        return self._one is None and not self._returning

    def step(self) -> None:
        """Execute the next scheduled action, if any."""
        self.clock.step()
        self.trace.flush()

    def deliver(self, event: str, data: Any, to: Iterable[Actor], sender: str = "") -> None:
        """Deliver an event from outside, in the name of a robot if a sender is given.

        One of an activity ends the activity.
        """
        envelope = Envelope(sender, self.clock.now) if sender else NO_ENVELOPE
        declared = self._system.events_by_name.get(event) if self._system is not None else None
        if sender and self._system is not None and declared is not None:
            data = signed(declared, data, self._system, sender, self.clock.now)
        if declared is not None and declared.predefined:
            for robot in dict.fromkeys(actor.robot for actor in to):
                if robot in self.members.rosters:
                    self.members.rosters[robot].note(event, data)
        self._deliver(Event(event, data, envelope=envelope), to)

    def _deliver(self, event: Event, to: Iterable[Actor]) -> None:
        for actor in to:
            instance = self._instances[actor]
            going_on = self.runs(actor) if event.name.startswith(_OF_ACTIVITIES) else ()
            run = next((r for r in going_on if event.name in r.activity.events.values()), None)
            if run is not None:
                self._end(run, event.name, event.data)
                self.trace.flush()
            else:
                self._receive(instance, event)

    def _receive(self, instance: Instance, event: Event) -> None:
        if instance.running:
            self.trace.begin(instance, event.name, event.data, event.envelope)
            instance.receive(event)
            self.trace.flush()

    def runs(self, actor: Actor) -> list[Run]:
        """Return the running activities of a machine."""
        return [run for run in self._ends if run.instance is self._instances[actor]]

    def data(self, actor: Actor) -> Any:
        """Return the variables of a machine."""
        return self._instances[actor].data

    def listeners(self, event: str, robot: Robot) -> list[Actor]:
        """Return the machines of a robot that react to an event."""
        found = self._listeners.get((event, robot.name))
        if found is None:
            found = [actor for actor in self._machines[robot.name] if actor.listens(event)]
            self._listeners[event, robot.name] = found
        return found

    # ---- called by the engine

    @property
    def time(self) -> int:
        """Return the virtual time in nanoseconds."""
        return self.clock.now

    def schedule(self, delay: int, action: Callable[[], None]) -> Alarm:
        """Schedule a call."""
        return self.clock.schedule(delay, action)

    def unschedule(self, handle: Alarm) -> None:
        """Cancel a scheduled call."""
        self.clock.unschedule(handle)

    def start(self, run: Run) -> None:
        """Start an activity, with a random end."""
        robot, function = self._actors[run.instance].robot, run.activity.name
        self._calls[robot.name, function] += 1
        call = self._calls[robot.name, function]
        answer = self._behavior(function, robot).draw(
            lambda: self._chance.stream(robot.name, function, call)
        )
        self._ends[run] = None
        if answer.outcome is None or self._is_silent(robot, function):
            return
        data = None
        if answer.outcome == "succeeded":
            data = {**self._blank(function), **answer.result}
        name = run.activity.events[answer.outcome]
        self._ends[run] = self.clock.schedule(answer.duration, lambda: self._end(run, name, data))

    def cancel(self, run: Run) -> None:
        """Stop an activity, after the time given in the scenario."""
        robot, function = self._actors[run.instance].robot, run.activity.name
        self.outcomes[function, "cancelled"] += 1
        alarm = self._ends.pop(run)
        if alarm is not None:
            self.clock.unschedule(alarm)
        if self._is_silent(robot, function):
            self._unheard.append(run)
        else:
            self._stop(run)

    def send(self, instance: InstanceLike, event: Event) -> None:
        """Deliver an event to the robot, and a swarm event to the other robots."""
        if self._system is None:
            return
        robot, to = self._actors[instance].robot, event.envelope.to
        sent = self._system.event(event.name)
        data = signed(sent, event.data, self._system, robot.name or "", self.clock.now)
        here = [each.name for each in self._system.events if each.incoming_topic == sent.topic]
        for name in here if to is None else ():
            self._later(0, Event(name, data), robot)
        if not sent.swarm:
            return
        envelope = Envelope(robot.name or "", self.clock.now, to)
        arriving = Event(event.name, data, envelope=envelope)
        if to is None and sent.delivery is None and self.network.latency is not None:
            self._send_to_all(robot, arriving, self.network.latency)
            return
        others = [other for other in self.robots if other is not robot and other.is_meant_by(to)]
        if not others and to is not None and robot.name is not None:
            self.nobody[event.name] += 1
            self.trace.reaches_nobody()
        self.network.send(arriving, sent, robot, others)

    def _send_to_all(self, robot: Robot, event: Event, latency: int) -> None:
        """Send an event to all other robots, which get it at the same time."""
        audience = self._audience(event.name)
        others = len(audience) - any(other is robot for other, _ in audience)
        self.network.delivered[event.name] += others
        heard, reporters = self.trace.is_heard, self.trace.reporters

        def arrive() -> None:
            for other, lives in audience:
                for life in lives if other is not robot else ():
                    instance = life.instance
                    if heard:
                        self._receive(instance, event)
                    elif instance.running and reporters:
                        reporters[instance].receive(event)
                    elif instance.running:
                        # As there, without a call for each of what may be millions.
                        life.arrives()
                        instance.receive(event)

        if others:
            self.clock.schedule(latency, arrive)

    def _audience(self, event: str) -> list[tuple[Robot, list[Life]]]:
        found = self._audiences.get(event)
        if found is None:
            lives = self.trace.lives
            pairs = (
                (robot, [lives[self._instances[actor]] for actor in self.listeners(event, robot)])
                for robot in self.robots
            )
            found = self._audiences[event] = [pair for pair in pairs if pair[1]]
        return found

    def failed(self, instance: InstanceLike, error: Exception) -> None:
        """Count the failure."""
        self.failures[instance.machine.name, str(error)] += 1

    # ---- internal

    def _is_silent(self, robot: Robot, function: str) -> bool:
        return bool(self._silent) and any(
            self._silent[robot, name] for name in (function, EVERY_FUNCTION)
        )

    def _stop(self, run: Run) -> None:
        robot, function = self._actors[run.instance].robot, run.activity.name
        call = self._calls[robot.name, function]
        delay = draw(
            self._behavior(function, robot).stopping,
            lambda: self._chance.stream(robot.name, function, call, "stops"),
        )
        self.clock.schedule(delay, lambda: run.end("preempted"))

    def _behavior(self, function: str, robot: Robot) -> FunctionBehavior:
        found = self._behaviors.get((function, robot.name))
        if found is None:
            found = self._scenario.behavior(function, robot)
            self._behaviors[function, robot.name] = found
        return found

    def _later(self, delay: int, event: Event, robot: Robot) -> None:
        to = self.listeners(event.name, robot)
        if to:
            self.clock.schedule(delay, lambda: self._deliver(event, to))

    def _end(self, run: Run, event: str, data: Any) -> None:
        if data is None and event == run.activity.events["succeeded"]:
            data = self._blank(run.activity.name)
        outcome = self._outcome(run, event, data)
        self.outcomes[run.activity.name, outcome] += 1
        alarm = self._ends.pop(run)
        if alarm is not None:
            self.clock.unschedule(alarm)
        run.end(outcome, data)

    def _blank(self, function: str) -> Mapping[str, Any]:
        """Return the default result of a function."""
        if self._system is None:
            return {}
        if function not in self._blanks:
            call = self._system.function(function).communication
            self._blanks[function] = default_result(call, self._system)
        return self._blanks[function]

    def _outcome(self, run: Run, event: str, data: Any) -> str:
        """Return the outcome of an end event: a service response may report failure."""
        outcome = next(each for each, name in run.activity.events.items() if name == event)
        if outcome != "succeeded" or self._system is None or not isinstance(data, Mapping):
            return outcome
        if data.get("success") is not False:
            return outcome
        call = self._system.function(run.activity.name).communication
        return run.activity.refused if call.paradigm == "service" else outcome

    def _message(self, message: Message, robot: Robot) -> Callable[[], None]:
        def arrive() -> None:
            if message.every is not None and robot not in self.network.gone:
                self.clock.schedule(message.every, arrive)
            to = self.listeners(message.event, robot)
            self.deliver(message.event, message.data, to, message.sender)

        return arrive

    def _fault(self, fault: Fault, robot: Robot) -> Callable[[], None]:
        def strike() -> None:
            if fault.function is None:
                self.lose(robot)
                if fault.lasts is not None:
                    self._returning += 1
                    self.clock.schedule(fault.lasts, lambda: self._return(robot))
                return
            self._silent[robot, fault.function] += 1
            for run, alarm in self._ends.items():
                if self._actors[run.instance].robot is robot and self._is_silent(
                    robot, run.activity.name
                ):
                    if alarm is not None:
                        self.clock.unschedule(alarm)
                    self._ends[run] = None
            if fault.lasts is not None:
                answers = (robot, fault.function)
                self.clock.schedule(fault.lasts, lambda: self._answer(answers))

        return strike

    def _answer(self, answers: tuple[Robot, str]) -> None:
        """End a silence, and stop the runs that were cancelled during it."""
        self._silent[answers] -= 1
        unheard, self._unheard = self._unheard, []
        for run in unheard:
            if self._is_silent(self._actors[run.instance].robot, run.activity.name):
                self._unheard.append(run)
            else:
                self._stop(run)

    def lose(self, robot: Robot) -> None:
        """Remove a robot, without executing exit effects."""
        self.network.leave(robot)
        self.members.forget(robot)
        self.members.follow([robot])
        for actor, instance in self._instances.items():
            if actor.robot is robot and instance.running:
                self.trace.begin(instance, LOST)
                self.trace.lives[instance].lose()
                instance.running = False
                self.trace.flush()
        for run in [run for run in self._ends if self._actors[run.instance].robot is robot]:
            alarm = self._ends.pop(run)
            if alarm is not None:
                self.clock.unschedule(alarm)

    def _return(self, robot: Robot) -> None:
        """Start the machines of a lost robot anew."""
        self._returning -= 1
        if robot not in self.network.gone:
            return
        servers = Servers()
        for actor, data in self._first_data.items():
            if actor.robot is robot:
                instance = Instance(actor.machine, self, data=deepcopy(data), servers=servers)
                self.trace.replace(self._instances[actor], instance)
                self._instances[actor] = instance
                self._actors[instance] = actor
                self.trace.begin(instance, None)
                instance.start()
                self.trace.flush()
        self.network.join(robot, self.robots)
        self.members.follow([robot])

    def _partition(self, fault: Fault) -> Callable[[], None]:
        def strike() -> None:
            self.members.follow(self.network.part(fault.apart, self.robots))
            if fault.lasts is not None:
                self.clock.schedule(fault.lasts, heal)

        def heal() -> None:
            self.members.follow(self.network.heal(fault.apart, self.robots))

        return strike

    # ---- members

    def _hears(self, one: Robot, other: Robot) -> bool:
        """Return True if heartbeats get from one robot to another; each one hears itself."""
        is_silent = self._scenario.loss >= 1 and one is not other
        return not is_silent and self.network.reaches(one, other)

    def _observers(self, robot: Robot) -> list[Actor]:
        """Return the machines of a robot that follow who is there."""
        found = self._machines[robot.name]
        return [actor for actor in found if actor.machine.name in self._following]

    def _presence(self, robot: Robot) -> Callable[[str | None], int]:
        """Return the function that counts the robots that are present for a robot."""
        return lambda role: self.members.rosters[robot].count(role)

    def _tell_member(self, event: str, observer: Robot, other: Robot) -> None:
        """Tell a robot that another one is lost, or is there again."""
        data = {"id": other.name or "", "role": other.role}
        self.members.rosters[observer].note(event, data)
        self._deliver(Event(event, data), self._observers(observer))

    def _miss(self, event: str, robot: Robot) -> None:
        """Trace a missed deadline, once for all machines of the robot that wait for the event."""
        for actor in self.listeners(event, robot)[:1]:
            if self._instances[actor].running:
                self.trace.begin(self._instances[actor], f"{LATE}{event}")
                self.trace.flush()


LATE = "fault.late."
"""Trace event of a missed deadline, before the name of the event."""
