"""Robots of a swarm, for those that follow which others are there."""

from __future__ import annotations

from collections.abc import Sequence

from swarmdsl.base.records import dataclass
from swarmdsl.execution.simulate.machines.actors import Actor
from swarmdsl.execution.simulate.machines.subject import Subject
from swarmdsl.execution.simulate.network.members import following
from swarmdsl.execution.simulate.scenario.scenario import Robot
from swarmdsl.execution.verify.robot.environment import Environment


@dataclass(frozen=True)
class Crew:
    """All robots of a swarm, with the names of the machines that follow who is there.

    If heartbeats may be lost, each one `guesses`: it takes any other one for lost at any time, and
    hears it again at any time.
    """

    robots: tuple[Robot, ...]
    followers: frozenset[str]
    has_heartbeat: bool
    guesses: bool = False
    is_deaf: bool = False
    """True if no heartbeat ever arrives."""

    @property
    def tells(self) -> bool:
        """True if each loss of a robot is noticed by all others."""
        return self.has_heartbeat and not self.guesses

    def observes(self, actor: Actor) -> bool:
        """Return True if a machine gets the events of members."""
        return actor.machine.name in self.followers


def crew_of(subject: Subject, robots: Sequence[Robot], environment: Environment) -> Crew:
    """Return the robots of a swarm, which guess if the environment may lose heartbeats."""
    has_heartbeat = subject.heartbeat is not None
    return Crew(
        tuple(robots),
        following(subject.system),
        has_heartbeat,
        guesses=has_heartbeat and environment.guesses,
        is_deaf=has_heartbeat and environment.is_deaf,
    )
