"""Radio between nodes: swarm events of each robot have topics of their own, and are relayed."""

from __future__ import annotations

import time
from collections.abc import Callable, Iterable, Mapping
from typing import Any

from swarmdsl.base.records import replace
from swarmdsl.codegen.shared import envelopes_of
from swarmdsl.execution.engine import Envelope, Event
from swarmdsl.execution.ros2_world.names import name_in, radio_topic, topic_of_swarm
from swarmdsl.execution.ros2_world.ports import Graph, Sender
from swarmdsl.execution.simulate.machines.headers import signed
from swarmdsl.execution.simulate.network.network import Network
from swarmdsl.execution.simulate.scenario.scenario import Robot
from swarmdsl.ir import Delivery, Heartbeat, Named, System
from swarmdsl.ir import Event as Declared

_BEATS = Declared("members", Named("std_msgs", "String"), "members", swarm=True)
"""Heartbeats: a node publishes them beside its events."""
_PLAIN = Delivery()
_ECHO = 2.0
"""Real time in which what is relayed to a robot comes back from its topic, in seconds."""
_HEAD = 4
"""Bytes before a message, in which the middleware may change some."""


class Radio:
    """Relays between the topics of robots what the network lets through.

    Events of a person come on the topics of the swarm, whose namespace is `swarm`, and reach all.
    `told(robot, event, listeners)` is called when an event has reached a robot.
    """

    def __init__(
        self,
        graph: Graph,
        system: System,
        heartbeat: Heartbeat | None,
        swarm: str,
        spaces: Mapping[Robot, str],
        told: Callable[[Robot, str, int], None],
    ) -> None:
        self._system = system
        self._swarm = swarm
        self._spaces = spaces
        self._told = told
        self._envelopes = envelopes_of(system)
        self._senders: dict[tuple[Robot, str], Sender] = {}
        self._echoes: dict[tuple[Robot, str], list[tuple[bytes, float]]] = {}
        self._topics: dict[str, str] = {}
        """Topic of each event."""
        self.network: Network
        events = [(each, topic_of_swarm(each)) for each in system.events if not each.predefined]
        if heartbeat is not None:
            events.append((_BEATS, _BEATS.topic))
        known: set[str] = set()
        for event, topic in sorted(events, key=lambda each: not each[0].swarm):
            if topic is None or not isinstance(event.type, Named):
                continue
            self._topics[event.name] = topic
            if topic not in known:
                known.add(topic)
                self._open(graph, event, topic)

    def topic_of(self, event: str) -> str | None:
        """Return the topic of an event between robots; None for one of the robot itself."""
        return self._topics.get(event)

    def sends(self, topic: str) -> list[Declared]:
        """Return the swarm events on a topic."""
        return [each for each in self._system.events if each.swarm and each.topic == topic]

    def send(self, event: Declared, robot: Robot, data: Any, now: int) -> None:
        """Send an event in the name of a robot, as if one of its nodes had."""
        signed_data = signed(event, data, self._system, robot.name or "", now)
        wire = self._wire(event, robot, robot.name or "", signed_data, now)
        self._carry(event, robot, wire, None)

    def deliver(self, event: str, robot: Robot, sender: str, data: Any, now: int) -> None:
        """Let a robot hear an event from outside."""
        declared = self._system.event(event)
        if sender:
            data = signed(declared, data, self._system, sender, now)
        self.arrive(Event(event, self._wire(declared, robot, sender, data or {}, now)), robot)

    def arrive(self, event: Event, robot: Robot) -> None:
        """Publish on the topic of a robot what has reached it."""
        key = (robot, self._topics[event.name])
        self._echoes.setdefault(key, []).append((event.data[_HEAD:], time.monotonic() + _ECHO))
        sender = self._senders[key]
        sender.send(event.data)
        # One is the subscription with which this process hears the robot.
        self._told(robot, event.name, sender.listeners - 1)

    # ---- internal

    def _open(self, graph: Graph, event: Declared, topic: str) -> None:
        envelope = self._envelopes.get(event.name)
        type_ = event.type if envelope is None else envelope.type
        assert isinstance(type_, Named)
        delivery = event.delivery or _PLAIN
        for robot, space in self._spaces.items():
            name = radio_topic(space, topic)
            self._senders[robot, topic] = graph.sender(name, type_, delivery)
            graph.hear_wire(name, type_, delivery, self._listener(event, robot, topic))
        if event.operator:
            hear = self._person(event, topic)
            graph.hear_wire(name_in(self._swarm, topic), type_, delivery, hear)

    def _person(self, event: Declared, topic: str) -> Callable[[bytes], None]:
        """Return a function that lets robots hear a person, wherever they are."""

        def hear(wire: bytes) -> None:
            for robot in self._spaces:
                to = self._address(event, robot, topic, wire)
                if robot.is_meant_by(to) and robot not in self.network.gone:
                    self.arrive(Event(event.name, bytes(wire)), robot)

        return hear

    def _address(self, event: Declared, robot: Robot, topic: str, wire: bytes) -> str | None:
        if event.name not in self._envelopes:
            return None
        return self._senders[robot, topic].read(wire)["to"] or None

    def _listener(self, event: Declared, robot: Robot, topic: str) -> Callable[[bytes], None]:
        def hear(wire: bytes) -> None:
            if self._is_echo(robot, topic, wire) or robot in self.network.gone:
                return
            if event.swarm:
                to = self._address(event, robot, topic, wire)
                self._carry(event, robot, bytes(wire), to)

        return hear

    def _carry(self, event: Declared, robot: Robot, wire: bytes, to: str | None) -> None:
        others: Iterable[Robot] = (
            each for each in self._spaces if each is not robot and each.is_meant_by(to)
        )
        arriving = Event(event.name, wire, envelope=Envelope(robot.name or "", 0, to))
        if event is _BEATS:
            # One that is late says nothing.
            event = replace(event, delivery=Delivery(reliable=False))
        self.network.send(arriving, event, robot, list(others))

    def _wire(self, event: Declared, robot: Robot, sender: str, data: Any, now: int) -> bytes:
        if event.name in self._envelopes:
            data = {"sender": sender, "sent": now, "to": "", "message": data}
        return self._senders[robot, self._topics[event.name]].wire(data)

    def _is_echo(self, robot: Robot, topic: str, wire: bytes) -> bool:
        """Return True for what this process has published on the topic itself."""
        waited = self._echoes.get((robot, topic))
        if not waited:
            return False
        now, content = time.monotonic(), bytes(wire)[_HEAD:]
        waited[:] = [each for each in waited if each[1] >= now]
        for each in waited:
            if each[0] == content:
                waited.remove(each)
                return True
        return False
