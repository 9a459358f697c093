"""Simulated world: all machines in virtual time, their events, and faults."""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Iterable, Sequence
from copy import deepcopy
from functools import partial
from typing import Any

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
from swarmdsl.execution.simulate.machines.actors import Actor
from swarmdsl.execution.simulate.machines.expressions import NEIGHBORS, PRESENT
from swarmdsl.execution.simulate.machines.headers import signed
from swarmdsl.execution.simulate.network.members import Members, counting_neighbors, following
from swarmdsl.execution.simulate.network.network import Network
from swarmdsl.execution.simulate.scenario.clock import Alarm, Clock
from swarmdsl.execution.simulate.scenario.random_source import RandomSource
from swarmdsl.execution.simulate.scenario.scenario import Robot, Scenario
from swarmdsl.execution.simulate.scenario.space import ABSTRACT, Space
from swarmdsl.execution.simulate.world.activities import Activities
from swarmdsl.execution.simulate.world.broadcasts import Broadcasts
from swarmdsl.execution.simulate.world.cast import Cast
from swarmdsl.execution.simulate.world.devices import Devices
from swarmdsl.execution.simulate.world.line import LATE, Line
from swarmdsl.execution.simulate.world.schedule import schedule
from swarmdsl.execution.simulate.world.trace import Trace
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
        space: Space = ABSTRACT,
    ) -> None:
        self.space = space
        self.clock = Clock()
        self.trace = Trace(self.clock, listeners, space.at)
        self.failures: Counter[tuple[str, str]] = Counter()
        """Failures of guards and effects, by machine and reason."""
        self.nobody: Counter[str] = Counter()
        """Numbers of swarm events with an address that no other robot has."""
        self._system = system
        self.scenario = scenario
        self.seed = seed
        self._chance = RandomSource(seed)
        self.network = Network(
            self.clock,
            scenario,
            self._chance,
            lambda event, robot: self._deliver(event, self.listeners(event.name, robot)),
            lambda event, robot: bool(self.listeners(event, robot)),
            self._miss,
            space,
        )
        self.activities = Activities(
            self.clock,
            scenario,
            self._chance,
            system,
            lambda run: self._cast.actors[run.instance].robot,
            space,
        )
        self._returning = 0
        """Number of lost robots that will come back."""
        self._cast = Cast(actors, self._first_instance)
        self.robots = self._cast.robots
        self._devices = Devices(
            system,
            self._cast,
            self.clock,
            self.network,
            self.trace.statistics,
            self._deliver,
        )
        self._broadcasts = Broadcasts(
            self._cast, self.clock, self.network, self.trace, self._receive
        )
        self._following = following(system)
        self.members = Members(
            self.clock,
            heartbeat,
            self.robots,
            [robot for robot in self.robots if self._observers(robot)],
            self._hears,
            self._tell_member,
        )
        near = counting_neighbors(system)
        for actor in self._cast.instances:
            if actor.robot in self.members.rosters:
                actor.data[PRESENT] = self._presence(actor.robot)
            if actor.machine.name in near:
                actor.data[NEIGHBORS] = self._nearness(actor.robot)
        comes_back = any(each.lasts is not None and each.is_loss for each in scenario.faults)
        self._first_data = {
            actor: deepcopy(actor.data) for actor in (self._cast.instances if comes_back else ())
        }

    def _first_instance(self, actor: Actor, servers: Servers) -> Instance:
        instance = Instance(actor.machine, self, data=actor.data, servers=servers)
        self.trace.watch(instance, actor)
        return instance

    # ---- called by a run

    def begin(self) -> None:
        """Start all machines and schedule the scenario."""
        self.trace.attach()
        self.space.begin(self, self.activities.end_as)
        if self.scenario.loss >= 1:
            self.members.follow()
        for instance in self._cast.instances.values():
            self.trace.begin(instance, None)
            instance.start()
            self.trace.flush()
        schedule(self.scenario, self, self._chance)

    @property
    def over(self) -> bool:
        """True if no machine is running, and no robot comes back."""
        return not self._cast.is_running and not self._returning

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
            instance = self._cast.instances[actor]
            going_on = self.runs(actor) if event.name.startswith(_OF_ACTIVITIES) else ()
            run = next((r for r in going_on if event.name in r.activity.events.values()), None)
            if run is not None:
                self.activities.end(run, event.name, event.data)
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
        return self.activities.of(self._cast.instances[actor])

    def data(self, actor: Actor) -> Any:
        """Return the variables of a machine."""
        return self._cast.instances[actor].data

    def listeners(self, event: str, robot: Robot) -> list[Actor]:
        """Return the machines of a robot that react to an event."""
        return self._cast.listeners(event, robot)

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
        self.activities.start(run)

    def cancel(self, run: Run) -> None:
        """Stop an activity, after the time given in the scenario."""
        self.activities.cancel(run)

    def send(self, instance: InstanceLike, event: Event) -> None:
        """Deliver an event to the robot, and a swarm event to the other robots."""
        if self._system is None:
            return
        robot, to = self._cast.actors[instance].robot, event.envelope.to
        sent = self._system.event(event.name)
        data = signed(sent, event.data, self._system, robot.name or "", self.clock.now)
        here = [each.name for each in self._system.events if each.incoming_topic == sent.topic]
        for name in here if to is None else ():
            own = self.listeners(name, robot)
            if own:
                self.clock.schedule(0, partial(self._deliver, Event(name, data), own))
        if not sent.swarm:
            return
        envelope = Envelope(robot.name or "", self.clock.now, to)
        arriving = Event(event.name, data, envelope=envelope)
        if to is None and sent.delivery is None and self.network.latency is not None:
            self._broadcasts.send(robot, arriving, self.network.latency)
            return
        others = [other for other in self.robots if other is not robot and other.is_meant_by(to)]
        if not others and to is not None and robot.name is not None:
            self.nobody[event.name] += 1
            self.trace.reaches_nobody()
        self.network.send(arriving, sent, robot, others)

    def failed(self, instance: InstanceLike, error: Exception) -> None:
        """Count the failure."""
        self.failures[instance.machine.name, str(error)] += 1

    # ---- called by a space

    def lose(self, robot: Robot, lasts: int | None = None, reason: str = "") -> None:
        """Remove a robot, without executing exit effects; it may come back after a time.

        A `reason` is in the lines of the trace.
        """
        self.network.leave(robot)
        self.space.lose(robot)
        self.members.forget(robot)
        self.members.follow([robot])
        for actor in self._cast.of(robot):
            instance = self._cast.instances[actor]
            if instance.running:
                self.trace.begin(instance, LOST, {"reason": reason} if reason else None)
                self.trace.lives[instance].lose()
                instance.running = False
                self.trace.flush()
        self.activities.forget(robot)
        if lasts is not None:
            self._returning += 1
            self.clock.schedule(lasts, lambda: self._return(robot))

    def _return(self, robot: Robot) -> None:
        """Start the machines of a lost robot anew."""
        self._returning -= 1
        if robot not in self.network.gone:
            return
        self.space.restore(robot)
        servers = Servers()
        for actor, data in self._first_data.items():
            if actor.robot is robot:
                instance = Instance(actor.machine, self, data=deepcopy(data), servers=servers)
                self.trace.replace(self._cast.instances[actor], instance)
                self._cast.replace(actor, instance)
                self.trace.begin(instance, None)
                instance.start()
                self.trace.flush()
        self.network.join(robot, self.robots)
        self.members.follow([robot])

    def flush(self) -> None:
        """End the line of the trace."""
        self.trace.flush()

    def awaits(self, robot: Robot, topic: str) -> bool:
        """Return True if somebody would handle a message of a robot on a topic now."""
        return self._devices.awaits(robot, topic)

    def publish(self, robot: Robot, topic: str, data: Any) -> None:
        """Deliver a message that a device of a robot has published on a topic."""
        self._devices.publish(robot, topic, data)

    @property
    def minds_links(self) -> bool:
        """True if it matters when robots come in reach of each other, or out of it."""
        events = self._system.events if self._system is not None else ()
        kept = (e.delivery for e in events if e.swarm and e.delivery is not None)
        return self.members.is_followed or any(each.reliable or each.latest for each in kept)

    def links_changed(self, pairs: Iterable[tuple[Robot, Robot]]) -> None:
        """Follow a change of who reaches whom: from the first robot of a pair to the second."""
        for one, other in pairs:
            if self.network.reaches(one, other):
                self.network.meet(one, other)
            self.members.follow_pair(other, one)

    # ---- members

    def _hears(self, one: Robot, other: Robot) -> bool:
        """Return True if heartbeats get from one robot to another; each one hears itself."""
        is_silent = self.scenario.loss >= 1 and one is not other
        return not is_silent and self.network.reaches(one, other)

    def _observers(self, robot: Robot) -> list[Actor]:
        """Return the machines of a robot that follow who is there."""
        found = self._cast.of(robot)
        return [actor for actor in found if actor.machine.name in self._following]

    def _nearness(self, robot: Robot) -> Callable[[float], int | None]:
        """Return the function that counts the robots that are near a robot."""
        # A copy of it with the data of a machine must not copy the space.
        return lambda distance: self.space.neighbors(robot, distance)

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
            if self._cast.instances[actor].running:
                self.trace.begin(self._cast.instances[actor], f"{LATE}{event}")
                self.trace.flush()
