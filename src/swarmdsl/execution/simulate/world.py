"""The world of a simulation: servers that answer after a while, a network, and faults."""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Iterable, Mapping, Sequence
from typing import Any

from swarmdsl.base.records import dataclass
from swarmdsl.codegen.shared.default_values import default_result
from swarmdsl.execution.engine import Event, Instance, InstanceLike, Run, Servers
from swarmdsl.execution.simulate.actors import Actor
from swarmdsl.execution.simulate.clock import Alarm, Clock
from swarmdsl.execution.simulate.random_source import Chance
from swarmdsl.execution.simulate.scenario import (
    EVERY_FUNCTION,
    Fault,
    Message,
    Robot,
    Scenario,
    meant,
)
from swarmdsl.execution.simulate.trace import Line, Trace
from swarmdsl.ir import System

_OF_ACTIVITIES = "do."
"""How the events of activities begin, in tables of models and of our SCXML."""


@dataclass(frozen=True)
class Crossing:
    """A swarm event on its way from one robot to another one, and whether it arrives."""

    event: str
    source: Robot
    target: Robot
    sent: int
    due: int
    arrives: bool


class World:
    """All that run, in virtual time; the `World` of the engine.

    Everything that one machine makes another one do goes through the clock, so that no machine
    is in the middle of a step when an event reaches it.
    """

    def __init__(
        self,
        system: System | None,
        actors: Iterable[Actor],
        scenario: Scenario,
        seed: int,
        listeners: Sequence[Callable[[Line], None]],
    ) -> None:
        self.clock = Clock()
        self.trace = Trace(self.clock, listeners)
        self.failures: Counter[tuple[str, str]] = Counter()
        """What guards and effects failed at, by machine and reason."""
        self.outcomes: Counter[tuple[str, str]] = Counter()
        """How activities ended, by function and outcome."""
        self.heard: Counter[str] = Counter()
        self.lost: Counter[str] = Counter()
        """How many copies of swarm events arrived at another robot, and how many did not."""
        self.crossed: Callable[[Crossing], None] | None = None
        """Is told of swarm events on their way to another robot."""
        self._system = system
        self._scenario = scenario
        self._chance = Chance(seed)
        self._calls: Counter[tuple[str | None, str]] = Counter()
        self._crossings: Counter[tuple[str | None, str | None]] = Counter()
        self._ends: dict[Run, Alarm | None] = {}
        self._listeners: dict[tuple[str, Robot], list[Actor]] = {}
        self._silent: Counter[tuple[Robot, str]] = Counter()
        """How many silences of a function are going on."""
        self._unheard: list[Run] = []
        self._gone: set[Robot] = set()
        self._instances: dict[Actor, Instance] = {}
        self._actors: dict[InstanceLike, Actor] = {}
        servers: dict[Robot, Servers] = {}
        for actor in actors:
            shared = servers.setdefault(actor.robot, Servers())
            instance = Instance(actor.machine, self, data=actor.data, servers=shared)
            self.trace.watch(instance, actor)
            self._instances[actor] = instance
            self._actors[instance] = actor
        self.robots = list(servers)

    # ---- what a run does with it

    def begin(self) -> None:
        """Start all machines, and plan what the scenario brings."""
        for instance in self._instances.values():
            self.trace.begin(instance, None)
            instance.start()
            self.trace.flush()
        said: Counter[str] = Counter()
        for message in self._scenario.messages:
            said[message.event] += 1
            for robot in self.robots:
                if meant(robot, message.to):
                    chance = self._chance.about(
                        robot.name, "hears", message.event, said[message.event]
                    )
                    self.clock.schedule(message.at.draw(chance), self._message(message, robot))
        for number, fault in enumerate(self._scenario.faults):
            for robot in self.robots:
                if meant(robot, fault.of):
                    chance = self._chance.about(robot.name, "fault", number)
                    self.clock.schedule(fault.at.draw(chance), self._fault(fault, robot))

    @property
    def over(self) -> bool:
        """Whether nobody is left to do anything."""
        return not any(instance.running for instance in self._instances.values())

    def step(self) -> None:
        """Do what comes next, if there is anything."""
        self.clock.step()
        self.trace.flush()

    def deliver(self, event: str, data: Any, to: Iterable[Actor]) -> None:
        """Bring an event from outside to machines; that of an activity ends the activity."""
        for actor in to:
            instance = self._instances[actor]
            going_on = self.runs(actor) if event.startswith(_OF_ACTIVITIES) else ()
            run = next((run for run in going_on if event in run.activity.events.values()), None)
            if run is not None:
                self._end(run, event, data)
            elif instance.running:
                self.trace.begin(instance, event, data)
                instance.receive(Event(event, data))
            self.trace.flush()

    def runs(self, actor: Actor) -> list[Run]:
        """The activities that a machine has going on."""
        return [run for run in self._ends if run.instance is self._instances[actor]]

    def data(self, actor: Actor) -> Any:
        """What the variables of a machine hold."""
        return self._instances[actor].data

    def listeners(self, event: str, robot: Robot) -> list[Actor]:
        """The machines of a robot that wait for an event in some state."""
        found = self._listeners.get((event, robot))
        if found is None:
            found = [a for a in self._instances if a.robot is robot and a.listens(event)]
            self._listeners[event, robot] = found
        return found

    # ---- what the engine asks of it

    def schedule(self, delay: int, action: Callable[[], None]) -> Alarm:
        """Call something later."""
        return self.clock.schedule(delay, action)

    def unschedule(self, handle: Alarm) -> None:
        """Do not call it."""
        self.clock.unschedule(handle)

    def start(self, run: Run) -> None:
        """Begin an activity, whose end chance decides."""
        robot, function = self._actors[run.instance].robot, run.activity.name
        self._calls[robot.name, function] += 1
        conduct = self._scenario.conduct(function, robot)
        chance = self._chance.about(robot.name, function, self._calls[robot.name, function])
        outcome = conduct.outcome(chance)
        chosen = int(chance.random() * len(conduct.results))
        self._ends[run] = None
        if outcome is None or self._is_silent(robot, function):
            return
        data = None
        if outcome == "succeeded":
            data = {**self._blank(function), **(conduct.results or ({},))[chosen]}
        name = run.activity.events[outcome]
        self._ends[run] = self.clock.schedule(
            conduct.duration.draw(chance), lambda: self._end(run, name, data)
        )

    def cancel(self, run: Run) -> None:
        """Stop an activity, which takes the time that the scenario says."""
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
        """Bring an event to the machines of the robot, and a swarm event to the other robots."""
        if self._system is None:
            return
        robot = self._actors[instance].robot
        sent = self._system.event(event.name)
        here = [each.name for each in self._system.events if each.incoming_topic == sent.topic]
        for name in here:
            self._later(0, name, event.data, robot)
        if not sent.swarm:
            return
        for other in self.robots:
            if other is robot or not self.listeners(event.name, other):
                continue
            self._crossings[robot.name, other.name] += 1
            count = self._crossings[robot.name, other.name]
            chance = self._chance.about(robot.name, "to", other.name, count)
            arrives = chance.random() >= self._scenario.loss and other not in self._gone
            delay = self._scenario.latency.draw(chance)
            if self.crossed is not None:
                now = self.clock.now
                self.crossed(Crossing(event.name, robot, other, now, now + delay, arrives))
            if not arrives:
                self.lost[event.name] += 1
                continue
            self.heard[event.name] += 1
            self._later(delay, event.name, event.data, other)

    def failed(self, instance: InstanceLike, error: Exception) -> None:
        """Count it."""
        self.failures[instance.machine.name, str(error)] += 1

    # ---- inside

    def _is_silent(self, robot: Robot, function: str) -> bool:
        return any(self._silent[robot, name] for name in (function, EVERY_FUNCTION))

    def _stop(self, run: Run) -> None:
        robot, function = self._actors[run.instance].robot, run.activity.name
        conduct = self._scenario.conduct(function, robot)
        chance = self._chance.about(
            robot.name, function, self._calls[robot.name, function], "stops"
        )
        self.clock.schedule(conduct.stopping.draw(chance), lambda: run.end("preempted"))

    def _later(self, delay: int, event: str, data: Any, robot: Robot) -> None:
        to = self.listeners(event, robot)
        if to:
            self.clock.schedule(delay, lambda: self.deliver(event, data, to))

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
        """The result of a function in which nothing is said."""
        if self._system is None:
            return {}
        return default_result(self._system.function(function).communication, self._system)

    def _outcome(self, run: Run, event: str, data: Any) -> str:
        """How an activity ends with an event: a response may say that nothing came of it."""
        outcome = next(each for each, name in run.activity.events.items() if name == event)
        if outcome != "succeeded" or self._system is None or not isinstance(data, Mapping):
            return outcome
        if data.get("success") is not False:
            return outcome
        call = self._system.function(run.activity.name).communication
        return run.activity.refused if call.paradigm == "service" else outcome

    def _message(self, message: Message, robot: Robot) -> Callable[[], None]:
        def arrive() -> None:
            if message.every is not None and robot not in self._gone:
                self.clock.schedule(message.every, arrive)
            self.deliver(message.event, message.data, self.listeners(message.event, robot))

        return arrive

    def _fault(self, fault: Fault, robot: Robot) -> Callable[[], None]:
        def strike() -> None:
            if fault.function is None:
                self.lose(robot)
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
        """End a silence; what was asked to stop in it does so now."""
        self._silent[answers] -= 1
        unheard, self._unheard = self._unheard, []
        for run in unheard:
            if self._is_silent(self._actors[run.instance].robot, run.activity.name):
                self._unheard.append(run)
            else:
                self._stop(run)

    def lose(self, robot: Robot) -> None:
        """Let a robot be gone: it does nothing any more, and nothing is done on leaving."""
        self._gone.add(robot)
        for actor, instance in self._instances.items():
            if actor.robot is robot and instance.running:
                self.trace.begin(instance, LOST)
                instance.running = False
                self.trace.flush()
        for run in [run for run in self._ends if self._actors[run.instance].robot is robot]:
            alarm = self._ends.pop(run)
            if alarm is not None:
                self.clock.unschedule(alarm)


LOST = "fault.lost"
"""The event of a robot that is lost, in a trace; no event of a model has such a name."""
