"""Broadcasts: swarm events that all other robots get at the same time."""

from __future__ import annotations

from collections.abc import Callable

from swarmdsl.execution.engine import Event, Instance
from swarmdsl.execution.simulate.network.network import Network
from swarmdsl.execution.simulate.scenario.clock import Clock
from swarmdsl.execution.simulate.scenario.scenario import Robot
from swarmdsl.execution.simulate.world.cast import Cast
from swarmdsl.execution.simulate.world.trace import Audience, Trace


class Broadcasts:
    """Swarm events on their way to everybody; there may be millions of arrivals."""

    def __init__(
        self,
        cast: Cast,
        clock: Clock,
        network: Network,
        trace: Trace,
        receive: Callable[[Instance, Event], None],
    ) -> None:
        self._cast = cast
        self._clock = clock
        self._network = network
        self._trace = trace
        self._receive = receive
        self._audiences: dict[str, list[Audience]] = {}
        """Robots that listen to an event, with the instances that do."""

    def send(self, robot: Robot, event: Event, latency: int) -> None:
        """Send an event to all other robots."""
        audience = self._audience(event.name)
        others = len(audience) - any(other is robot for other, _ in audience)
        self._network.delivered[event.name] += others
        heard = self._trace.is_heard
        spread = None if heard else self._trace.spread

        def arrive() -> None:
            if spread is not None:
                spread(event, robot, audience)
                return
            for other, lives in audience:
                for life in lives if other is not robot else ():
                    instance = life.instance
                    if heard:
                        self._receive(instance, event)
                    elif instance.running:
                        # As there, without a call for each arrival.
                        life.arrives()
                        instance.receive(event)

        if others:
            self._clock.schedule(latency, arrive)

    def _audience(self, event: str) -> list[Audience]:
        found = self._audiences.get(event)
        if found is None:
            cast, lives = self._cast, self._trace.lives
            pairs = (
                (robot, [lives[cast.instances[actor]] for actor in cast.listeners(event, robot)])
                for robot in cast.robots
            )
            found = self._audiences[event] = [pair for pair in pairs if pair[1]]
        return found
