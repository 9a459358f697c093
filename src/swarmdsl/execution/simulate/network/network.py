"""Network of a simulation: what reaches which robot, and when.

An event is sent once, unless its delivery is reliable: then it is sent again until it arrives. An
event for a robot out of reach waits for it if it is reliable, and is lost if it is not.
"""

from __future__ import annotations

from collections import Counter, deque
from collections.abc import Callable, Iterable, Iterator
from functools import partial

from swarmdsl.execution.engine import Event
from swarmdsl.execution.simulate.network.deadlines import Deadlines
from swarmdsl.execution.simulate.network.held_events import HeldEvents
from swarmdsl.execution.simulate.network.packets import Channel, Kept, Packet, Transmission
from swarmdsl.execution.simulate.network.partitions import Groups, Partitions
from swarmdsl.execution.simulate.scenario.clock import Clock
from swarmdsl.execution.simulate.scenario.durations import MILLISECOND, Fixed
from swarmdsl.execution.simulate.scenario.random_source import RandomSource
from swarmdsl.execution.simulate.scenario.scenario import Robot, Scenario
from swarmdsl.execution.simulate.scenario.space import ABSTRACT, Space
from swarmdsl.ir import Delivery
from swarmdsl.ir import Event as Declared

RETRY = 100 * MILLISECOND
"""Time after which a reliable event that did not arrive is sent again."""
_PLAIN = Delivery()


class Network:
    """Carry swarm events between the robots of a scenario.

    `deliver(event, robot)` is called when an event arrives, `listens(name, robot)` says whether a
    machine of the robot handles it, and `late(name, robot)` is called for a missed deadline.
    """

    def __init__(
        self,
        clock: Clock,
        scenario: Scenario,
        chance: RandomSource,
        deliver: Callable[[Event, Robot], None],
        listens: Callable[[str, Robot], bool],
        late: Callable[[str, Robot], None],
        space: Space = ABSTRACT,
    ) -> None:
        self.delivered: Counter[str] = Counter()
        self.lost: Counter[str] = Counter()
        self.repeated: Counter[str] = Counter()
        self.expired: Counter[str] = Counter()
        self.late: Counter[str] = Counter()
        """Numbers of swarm events, by name: delivered to and lost on the way to other robots, sent
        again, too old on arrival, and missed deadlines."""
        self.transmitted: Callable[[Transmission], None] | None = None
        """Callback for swarm events in transit."""
        self.gone: set[Robot] = set()
        """Robots that are lost at present."""
        self._clock = clock
        self._space = space
        self._scenario = scenario
        self._chance = chance
        self._deliver = deliver
        self._listens = listens
        self._tell_late = late
        self._transmissions: Counter[tuple[str | None, str | None]] = Counter()
        self._last_arrival: dict[Channel, int] = {}
        """Time at which the last event on a topic arrives, by sender, receiver and topic."""
        self._partitions = Partitions()
        self._waiting: dict[Channel, deque[Packet]] = {}
        """Reliable events by sender, receiver and topic, in the order of sending."""
        self._latest: dict[tuple[Robot, str], tuple[Declared, deque[Kept]]] = {}
        self._deadlines = Deadlines(clock, self._miss)
        self._held = HeldEvents()

    @property
    def waiting(self) -> Counter[str]:
        """Numbers of reliable events that have not reached their receivers yet."""
        packets = (packet for channel in self._waiting.values() for packet in channel)
        return Counter(packet.event.name for packet in packets if not packet.ready)

    @property
    def latency(self) -> int | None:
        """Latency of all events, if at present it is the same and none is lost."""
        troubled = self._scenario.loss or self.gone or self._partitions.active or self._held.names
        troubled = troubled or self._space.has_radio
        latency = self._scenario.latency
        if troubled or self.transmitted is not None or not isinstance(latency, Fixed):
            return None
        return latency.length

    def reaches(self, one: Robot, other: Robot) -> bool:
        """Return True if two robots are there, no partition is between them, and radio reaches."""
        if self.gone and (one in self.gone or other in self.gone):
            return False
        if self._partitions.active and self._partitions.separate(one, other):
            return False
        return self._space.reaches(one, other)

    def send(
        self, event: Event, declared: Declared, source: Robot, targets: Iterable[Robot]
    ) -> None:
        """Send an event to other robots."""
        delivery = declared.delivery or _PLAIN
        kept = None
        if delivery.latest:
            kept = Kept(event, self._clock.now)
            _, history = self._latest.setdefault(
                (source, declared.name), (declared, deque(maxlen=delivery.keep or 1))
            )
            history.append(kept)
        for target in targets:
            if self._listens(event.name, target):
                self._transmit(event, declared, source, target, self._clock.now, kept)

    def part(self, groups: Groups, robots: Iterable[Robot]) -> list[Robot]:
        """Begin a partition; return the robots in its groups."""
        return self._partitions.begin(groups, robots)

    def heal(self, groups: Groups, robots: Iterable[Robot]) -> list[Robot]:
        """End a partition, and return the robots in its groups.

        What waits for a robot in reach is sent again.
        """
        parted = self._partitions.members(groups, robots)
        apart = [(a, b) for a in parted for b in parted if a is not b and not self.reaches(a, b)]
        self._partitions.end(groups)
        for source, target in apart:
            if self.reaches(source, target):
                self.meet(source, target)
        return parted

    def hold(self, event: str, target: str | None) -> None:
        """Let events on their way to a robot wait, until they are told to arrive."""
        self._held.names.add((event, target))

    def release(self, event: str, target: str | None) -> None:
        """Let events arrive by themselves again; those that have waited arrive now."""
        for packet in self._held.release(event, target):
            self._clock.schedule(0, partial(self._arrive, packet))

    def take(
        self, event: str, target: str | None, source: str | None, *, arrives: bool
    ) -> str | None:
        """Let the first event that waits arrive at a robot, or lose it.

        With a `source`, it is that of this robot. Return the reason if there is none, or if an
        earlier event of the same channel waits.
        """
        packet = self._held.take(event, target, source, arrives=arrives)
        if isinstance(packet, str):
            return packet
        if arrives:
            self._arrive(packet)
        else:
            self.lost[event] += 1
        return None

    def leave(self, robot: Robot) -> None:
        """Remove a robot; what it has sent and what waits for it is lost."""
        self.gone.add(robot)
        for packet in self._held.leave(robot):
            self.lost[packet.event.name] += 1
        for (source, target, _), packets in self._waiting.items():
            if robot in (source, target):
                for packet in [each for each in packets if not each.ready]:
                    self._give_up(packet)
                    self.lost[packet.event.name] += 1
        for source, name in list(self._latest):
            if source is robot:
                del self._latest[source, name]
            else:
                for kept in self._latest[source, name][1]:
                    kept.reached.discard(robot)
        self._deadlines.leave(robot)

    def join(self, robot: Robot, robots: Iterable[Robot]) -> None:
        """Add a robot that comes back; it gets the latest events."""
        self.gone.discard(robot)
        for source in robots:
            if source is not robot and self.reaches(source, robot):
                self.meet(source, robot)

    # ---- internal

    def _loss(self, source: Robot, target: Robot) -> float:
        """Return the probability that an event gets lost, in the network or by radio."""
        loss = self._scenario.loss
        if self._space.has_radio:
            loss += (1 - loss) * self._space.loss(source, target)
        return loss

    def _transmit(
        self,
        event: Event,
        declared: Declared,
        source: Robot,
        target: Robot,
        sent: int,
        kept: Kept | None,
    ) -> None:
        self._transmissions[source.name, target.name] += 1
        count = self._transmissions[source.name, target.name]
        chance = self._chance.stream(source.name, "to", target.name, count)
        if (event.name, target.name) in self._held.names:
            self._held.add(Packet(event, declared, source, target, sent, chance))
            if kept is not None:
                kept.reached.add(target)
            return
        if declared.delivery is not None and declared.delivery.reliable:
            if target in self.gone:
                self._lose(event, source, target, sent)
                return
            packet = Packet(event, declared, source, target, sent, chance)
            self._queue(packet)
            if kept is not None:
                kept.reached.add(target)
            self._attempt(packet)
            return
        arrives = chance.random() >= self._loss(source, target) and self.reaches(source, target)
        now = self._clock.now
        due = now + self._scenario.latency.draw(chance)
        if not arrives:
            self._lose(event, source, target, sent, due)
            return
        channel = (source, target, declared.topic)
        self._last_arrival[channel] = due = max(due, self._last_arrival.get(channel, 0))
        if kept is not None:
            kept.reached.add(target)
        self._tell(event, source, target, sent, due, arrives=True)
        if declared.delivery is None:
            self.delivered[event.name] += 1
            self._clock.schedule(due - now, lambda: self._deliver(event, target))
        else:
            packet = Packet(event, declared, source, target, sent, chance)
            self._clock.schedule(due - now, lambda: self._arrive(packet))

    def _queue(self, packet: Packet) -> None:
        """Let an event wait behind the earlier ones; of too many, the oldest is dropped."""
        packets = self._waiting.setdefault(packet.channel, deque())
        packets.append(packet)
        delivery = packet.declared.delivery
        if delivery is None or delivery.keep is None or self.reaches(packet.source, packet.target):
            return
        own = [each for each in packets if each.declared is packet.declared and not each.ready]
        if len(own) > delivery.keep:
            self._give_up(own[0])
            self._lose(own[0].event, packet.source, packet.target, own[0].sent)

    def _attempt(self, packet: Packet) -> None:
        """Send a reliable event, unless its receiver is out of reach or it is too old."""
        packet.alarm = None
        if not self.reaches(packet.source, packet.target):
            return
        if self._is_old(packet):
            self._expire(packet)
            return
        packet.attempts += 1
        if packet.attempts > 1:
            self.repeated[packet.event.name] += 1
        if packet.chance.random() < self._loss(packet.source, packet.target):
            packet.alarm = self._clock.schedule(RETRY, lambda: self._attempt(packet))
            return
        now = self._clock.now
        due = now + self._scenario.latency.draw(packet.chance)
        packet.ready = True
        self._clock.schedule(due - now, lambda: self._land(packet))
        self._tell(packet.event, packet.source, packet.target, packet.sent, due, arrives=True)

    def _land(self, packet: Packet) -> None:
        """Deliver an event that has reached its receiver, and those that it held up."""
        packet.landed = True
        self._deliver_next(packet.channel)

    def _deliver_next(self, channel: Channel) -> None:
        packets = self._waiting[channel]
        while packets and packets[0].landed:
            self._arrive(packets.popleft())

    def _arrive(self, packet: Packet) -> None:
        name, target = packet.event.name, packet.target
        if target in self.gone:
            self.lost[name] += 1
        elif self._is_old(packet):
            self.expired[name] += 1
        else:
            self.delivered[name] += 1
            self._deadlines.arrived(packet)
            self._deliver(packet.event, target)

    def _is_old(self, packet: Packet) -> bool:
        lifespan = packet.declared.delivery.lifespan if packet.declared.delivery else None
        return lifespan is not None and self._clock.now - packet.sent > lifespan

    def _expire(self, packet: Packet) -> None:
        self.expired[packet.event.name] += 1
        self._give_up(packet)
        self._tell(
            packet.event, packet.source, packet.target, packet.sent, self._clock.now, arrives=False
        )

    def _give_up(self, packet: Packet) -> None:
        """Remove an event that no longer waits; it holds up no other."""
        if packet.alarm is not None:
            self._clock.unschedule(packet.alarm)
        self._waiting[packet.channel].remove(packet)
        self._clock.schedule(0, lambda: self._deliver_next(packet.channel))

    def meet(self, source: Robot, target: Robot) -> None:
        """Send what waits for a robot that is in reach again, and the latest events."""
        for (sender, receiver, _), packets in self._waiting.items():
            if sender is source and receiver is target:
                for packet in [each for each in packets if not each.ready and each.alarm is None]:
                    self._attempt(packet)
        for declared, event, kept in list(self._missed(source, target)):
            self._transmit(event, declared, source, target, kept.sent, kept)

    def _missed(self, source: Robot, target: Robot) -> Iterator[tuple[Declared, Event, Kept]]:
        """Yield the latest events of a robot that have not reached another one."""
        for (sender, name), (declared, history) in self._latest.items():
            if sender is source and self._listens(name, target):
                for kept in history:
                    meant = target.is_meant_by(kept.event.envelope.to)
                    if meant and target not in kept.reached:
                        yield declared, kept.event, kept

    def _miss(self, name: str, target: Robot) -> None:
        self.late[name] += 1
        self._tell_late(name, target)

    def _lose(
        self, event: Event, source: Robot, target: Robot, sent: int, due: int | None = None
    ) -> None:
        self.lost[event.name] += 1
        when = self._clock.now if due is None else due
        self._tell(event, source, target, sent, when, arrives=False)

    def _tell(
        self, event: Event, source: Robot, target: Robot, sent: int, due: int, *, arrives: bool
    ) -> None:
        if self.transmitted is not None:
            to = event.envelope.to
            self.transmitted(Transmission(event.name, source, target, sent, due, arrives, to))
