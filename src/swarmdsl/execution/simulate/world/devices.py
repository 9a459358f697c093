"""Devices of robots: the messages that they publish on topics, and who hears them."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from functools import partial
from typing import Any

from swarmdsl.execution.engine import Envelope, Event
from swarmdsl.execution.simulate.machines.actors import Actor
from swarmdsl.execution.simulate.machines.headers import signed
from swarmdsl.execution.simulate.network.network import Network
from swarmdsl.execution.simulate.scenario.clock import Clock
from swarmdsl.execution.simulate.scenario.scenario import Robot
from swarmdsl.execution.simulate.world.cast import Cast
from swarmdsl.execution.simulate.world.statistics import Statistics
from swarmdsl.ir import Event as Declared
from swarmdsl.ir import System


class Devices:
    """Devices of all robots, which publish what they sense."""

    def __init__(
        self,
        system: System | None,
        cast: Cast,
        clock: Clock,
        network: Network,
        statistics: Statistics,
        deliver: Callable[[Event, Iterable[Actor]], None],
    ) -> None:
        self._system = system
        self._cast = cast
        self._clock = clock
        self._network = network
        self._statistics = statistics
        self._deliver = deliver
        self._on_topic: dict[str, tuple[list[Declared], list[str]]] = {}

    def awaits(self, robot: Robot, topic: str) -> bool:
        """Return True if somebody would handle a message of a robot on a topic now."""
        said, heard = self._events_on(topic)
        cast = self._cast
        return any(cast.waits(actor, name) for name in heard for actor in cast.of(robot)) or any(
            cast.listeners(each.name, other)
            for each in said
            for other in cast.robots
            if other is not robot
        )

    def publish(self, robot: Robot, topic: str, data: Any) -> None:
        """Deliver a message that a device of a robot has published on a topic.

        The robot's own machines hear it if they wait for it now. If it is that of a swarm event,
        it goes out by radio.
        """
        assert self._system is not None
        said, heard = self._events_on(topic)
        for name in heard:
            to = [actor for actor in self._cast.of(robot) if self._cast.waits(actor, name)]
            if to:
                self._clock.schedule(0, partial(self._deliver, Event(name, data), to))
        for each in said:
            self._statistics.sent[each.name] += 1
            signed_data = signed(each, data, self._system, robot.name or "", self._clock.now)
            envelope = Envelope(robot.name or "", self._clock.now, None)
            others = [other for other in self._cast.robots if other is not robot]
            event = Event(each.name, signed_data, envelope=envelope)
            self._network.send(event, each, robot, others)

    def _events_on(self, topic: str) -> tuple[list[Declared], list[str]]:
        """Return the swarm events that are sent on a topic, and the names of those heard on it."""
        found = self._on_topic.get(topic)
        if found is None:
            events = self._system.events if self._system is not None else ()
            said = [each for each in events if each.swarm and each.topic == topic]
            heard = [each.name for each in events if each.incoming_topic == topic]
            found = self._on_topic[topic] = (said, heard)
        return found
