"""Robots of a swarm, for those that follow which others are there."""

from __future__ import annotations

from swarmdsl.base.records import dataclass
from swarmdsl.execution.simulate.actors import Actor
from swarmdsl.execution.simulate.scenario import Robot


@dataclass(frozen=True)
class Crew:
    """All robots of a swarm, with the names of the machines that follow who is there."""

    robots: tuple[Robot, ...]
    followers: frozenset[str]
    has_heartbeat: bool

    def observes(self, actor: Actor) -> bool:
        """Return True if a machine gets the events of members."""
        return actor.machine.name in self.followers
