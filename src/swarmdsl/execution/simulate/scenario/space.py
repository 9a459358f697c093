"""Space of a simulated world: where robots are, and what follows from that.

The class here is the abstract space, without places: nobody is anywhere, everybody reaches
everybody, and functions end as the scenario says. Others are in `execution/space/`.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence
from typing import Any, Protocol

from swarmdsl.base.errors import describe_exception
from swarmdsl.execution.engine import InstanceLike, Run
from swarmdsl.execution.simulate.scenario.clock import Clock
from swarmdsl.execution.simulate.scenario.scenario import Robot

Place = tuple[float, float, float]
"""Coordinates in metres."""
Ended = Callable[[Run, str, Any], None]
"""Called with a run that a space ends, its outcome, and the fields of the result that it sets."""


class Surroundings(Protocol):
    """Parts of a world that a space acts on."""

    clock: Clock
    robots: list[Robot]

    @property
    def over(self) -> bool:
        """True if no machine is running, and no robot comes back."""

    @property
    def minds_links(self) -> bool:
        """True if it matters when robots come in reach of each other, or out of it."""

    def failed(self, instance: InstanceLike, error: Exception) -> None:
        """Count a failed evaluation."""

    def lose(self, robot: Robot, lasts: int | None = None, reason: str = "") -> None:
        """Remove a robot."""

    def publish(self, robot: Robot, topic: str, data: Any) -> None:
        """Deliver a message that a device of a robot has published on a topic."""

    def awaits(self, robot: Robot, topic: str) -> bool:
        """Return True if somebody would handle a message of a robot on a topic now."""

    def links_changed(self, pairs: Iterable[tuple[Robot, Robot]]) -> None:
        """Follow a change of who reaches whom."""

    def flush(self) -> None:
        """End the line of the trace."""


class Viewer(Protocol):
    """Follower of what happens in a space."""

    def moved(self, now: int) -> None:
        """Note that robots have moved, at a time in nanoseconds."""

    def saw(self, robot: Robot, what: str) -> None:
        """Note that a robot sees a target."""


class Space:
    """Abstract space, without places."""

    viewers: tuple[Viewer, ...] = ()
    """Those who follow what happens in this space alone."""

    has_radio = False
    """True if distances decide what reaches whom."""
    due = False
    """True if time must not pass before this space has moved on; a driver of many lets it."""
    limit = -1
    """Time until which this space may move on by itself while nothing else can happen."""

    def begin(self, world: Surroundings, ended: Ended) -> None:
        """Begin with a world; `ended` is called when the space ends the run of a function."""

    def check(self) -> None:
        """Raise the error of a machine that has failed when this space moved on with others."""

    def start(self, run: Run, robot: Robot) -> bool:
        """Start a function; return False if this space has no model of it."""
        return False

    def stop(self, run: Run) -> None:
        """Stop a function that was started here; its end is told no more."""

    def lose(self, robot: Robot) -> None:
        """Let a robot do nothing any more."""

    def restore(self, robot: Robot) -> None:
        """Let a lost robot go on where it is."""

    def reaches(self, one: Robot, other: Robot) -> bool:
        """Return True if what one robot sends can reach the other."""
        return True

    def loss(self, one: Robot, other: Robot) -> float:
        """Return the probability that an event gets lost on its way, by distance and walls."""
        return 0.0

    def neighbors(self, robot: Robot, distance: float) -> int | None:
        """Return the number of other robots within a distance; None if nobody is anywhere."""
        return None

    def at(self, robot: Robot) -> Place | None:
        """Return where a robot is."""
        return None

    def targets(self) -> Sequence[tuple[str, Place, bool]]:
        """Return the targets: name, place, and whether somebody has seen it."""
        return ()

    def picture(self) -> bytes | None:
        """Return a picture of the robots as PNG, None if there is none. Raises NoPictureError."""
        return None

    def rows(self) -> Sequence[tuple[str, ...]]:
        """Return the lines of the summary: a heading, and values by robot; empty without any."""
        return ()

    def measure(self, kind: str, subject: str) -> float | None:
        """Return a measure of space, as `distance` of a role; None if there is none."""
        return None


ABSTRACT = Space()
"""The space of worlds without geometry; it has no state."""


class NoPictureError(Exception):
    """Nothing can be drawn here; the message says why."""


class ModelError(Exception):
    """The model of a function has failed, at its own fault."""

    def __init__(self, function: str, error: Exception | str) -> None:
        said = f"model of {function}"
        reason = error if isinstance(error, str) else describe_exception(said, error)
        super().__init__(f"the model of `{function}` fails: {reason}")
        self.function = function
        self.reason = reason
