"""Base class of function models, and what they return."""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Mapping
from typing import TYPE_CHECKING, Any, ClassVar, NamedTuple

import numpy as np

from swarmdsl.execution.space.arrays import Flags, Rows, Small
from swarmdsl.ir.function_models import Argument

if TYPE_CHECKING:
    from swarmdsl.execution.space.stage import Stage

RUNNING, SUCCEEDED, ABORTED = 0, 1, 2
OUTCOMES = {SUCCEEDED: "succeeded", ABORTED: "aborted"}

Place = tuple[float, float, float]
Arguments = Mapping[str, Any]
"""Values of all arguments in the catalogue, None for those that the model chooses; times are in
seconds, a place is a tuple of three coordinates."""


class Finding(NamedTuple):
    """Findings of a function, written to the fields of its result that look like them."""

    place: Place | None = None
    heading: tuple[float, float] | None = None
    id: str = ""
    distance: float | None = None


class Model(ABC):
    """Model of a function: one object for all robots that call it, with arrays of its own.

    `who` are rows of the stage. Robots go where `stage.steer` or `stage.wanted_x` say. With
    `stops_on_contact`, the function of a robot that something stops is aborted.
    """

    stops_on_contact: ClassVar[bool] = True
    arguments: ClassVar[tuple[Argument, ...]] = ()
    """Arguments of a model of a project; those of others are in the catalogue."""

    def __init__(self, stage: Stage) -> None:
        self.stage = stage

    def start(self, who: Rows, arguments: Arguments) -> None:  # noqa: B027
        """Begin with some robots, which have the same arguments."""

    @abstractmethod
    def step(self, who: Rows, dt: float) -> Small:
        """Decide what robots want in the next `dt` seconds; return the status of each."""

    def stop(self, who: Rows) -> None:  # noqa: B027
        """End with some robots, whether they are done or not; the stage halts them."""

    def result(self, row: int) -> Finding | Mapping[str, Any]:
        """Return what a robot has found, or fields of its result, when it has succeeded."""
        stage = self.stage
        place = float(stage.x[row]), float(stage.y[row]), float(stage.z[row])
        return Finding(place, (float(stage.heading_x[row]), float(stage.heading_y[row])))

    # ---- for models

    def height(self, who: Rows, arguments: Arguments) -> Any:
        """Return the heights that robots keep: the argument, or those of now."""
        given = arguments["height"]
        return self.stage.z[who] if given is None else given

    def speed(self, who: Rows, arguments: Arguments) -> Any:
        """Return the speeds of robots: the argument, or those of their bodies."""
        given = arguments["speed"]
        return self.stage.speed[who] if given is None else given


def statuses(done: Flags, failed: Flags | None = None) -> Small:
    """Return the status of robots that are done, have failed, or go on."""
    found: Small = done.astype(np.int8)  # SUCCEEDED is 1, RUNNING is 0
    if failed is not None:
        found[failed] = ABORTED
    return found
