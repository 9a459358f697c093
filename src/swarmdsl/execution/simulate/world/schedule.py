"""Schedule the messages and faults of a scenario for a simulated world."""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable
from typing import Any, Protocol

from swarmdsl.execution.simulate.machines.actors import Actor
from swarmdsl.execution.simulate.network.members import Members
from swarmdsl.execution.simulate.network.network import Network
from swarmdsl.execution.simulate.scenario.clock import Clock
from swarmdsl.execution.simulate.scenario.random_source import RandomSource
from swarmdsl.execution.simulate.scenario.scenario import (
    Fault,
    Message,
    Robot,
    Scenario,
    is_selected,
)
from swarmdsl.execution.simulate.world.activities import Activities


class World(Protocol):
    """Parts of a world that messages and faults act on."""

    clock: Clock
    robots: list[Robot]
    network: Network
    members: Members
    activities: Activities

    def listeners(self, event: str, robot: Robot) -> list[Actor]:
        """Return the machines of a robot that react to an event."""

    def deliver(self, event: str, data: Any, to: list[Actor], sender: str) -> None:
        """Deliver an event from outside, in the name of a robot if a sender is given."""

    def lose(self, robot: Robot, lasts: int | None) -> None:
        """Remove a robot; it may come back after a time."""


def schedule(scenario: Scenario, world: World, chance: RandomSource) -> None:
    """Schedule all messages and faults, at the start of a run."""
    said: Counter[str] = Counter()
    for message in scenario.messages:
        said[message.event] += 1
        for robot in world.robots:
            if is_selected(robot, message.to) and robot.name != message.sender:
                stream = chance.stream(robot.name, "hears", message.event, said[message.event])
                world.clock.schedule(message.at.draw(stream), _message(message, robot, world))
    for number, fault in enumerate(scenario.faults):
        if fault.apart:
            stream = chance.stream("fault", number)
            world.clock.schedule(fault.at.draw(stream), _partition(fault, world))
            continue
        for robot in world.robots:
            if is_selected(robot, fault.of):
                stream = chance.stream(robot.name, "fault", number)
                world.clock.schedule(fault.at.draw(stream), _fault(fault, robot, world))


def _message(message: Message, robot: Robot, world: World) -> Callable[[], None]:
    def arrive() -> None:
        if message.every is not None and robot not in world.network.gone:
            world.clock.schedule(message.every, arrive)
        to = world.listeners(message.event, robot)
        world.deliver(message.event, message.data, to, message.sender)

    return arrive


def _fault(fault: Fault, robot: Robot, world: World) -> Callable[[], None]:
    def strike() -> None:
        if fault.function is None:
            world.lose(robot, fault.lasts)
        else:
            world.activities.silence(robot, fault.function, fault.lasts)

    return strike


def _partition(fault: Fault, world: World) -> Callable[[], None]:
    def strike() -> None:
        world.members.follow(world.network.part(fault.apart, world.robots))
        if fault.lasts is not None:
            world.clock.schedule(fault.lasts, heal)

    def heal() -> None:
        world.members.follow(world.network.heal(fault.apart, world.robots))

    return strike
