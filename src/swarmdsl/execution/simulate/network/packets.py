"""Swarm events between two robots."""

from __future__ import annotations

from random import Random

from swarmdsl.base.records import dataclass, field
from swarmdsl.execution.engine import Event
from swarmdsl.execution.simulate.scenario.clock import Alarm
from swarmdsl.execution.simulate.scenario.scenario import Robot
from swarmdsl.ir import Event as Declared

Channel = tuple[Robot, Robot, str]
"""Sender, receiver and topic: events of a channel arrive in the order of sending."""


@dataclass(frozen=True)
class Transmission:
    """Swarm event in transit between two robots; `arrives` is False if it is lost."""

    event: str
    source: Robot
    target: Robot
    sent: int
    due: int
    arrives: bool
    to: str | None = None
    """Address, None for all others."""


@dataclass(eq=False)
class Packet:
    """An event that can wait: `ready` on its way, `landed` when it waits for earlier ones there."""

    event: Event
    declared: Declared
    source: Robot
    target: Robot
    sent: int
    chance: Random
    attempts: int = 0
    ready: bool = False
    landed: bool = False
    alarm: Alarm | None = None

    @property
    def channel(self) -> Channel:
        """Channel that the event travels on."""
        return self.source, self.target, self.declared.topic


@dataclass(eq=False)
class Kept:
    """An event that a sender keeps for robots that come later, and those that it has reached."""

    event: Event
    sent: int
    reached: set[Robot] = field(default_factory=set)
