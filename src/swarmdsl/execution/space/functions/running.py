"""Functions that run in the robots of a stage, by their models."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from operator import is_
from typing import TYPE_CHECKING, Any

import numpy as np

from swarmdsl.execution.simulate.scenario.space import ModelError
from swarmdsl.execution.space.arrays import Flags, Part, Rows
from swarmdsl.execution.space.functions.base import ABORTED, RUNNING, Finding, Model

if TYPE_CHECKING:
    from swarmdsl.execution.space.stage import Stage


class Running:
    """One function, with its model and the robots in which it runs."""

    def __init__(self, name: str, make: Callable[[Stage], Model], stage: Stage) -> None:
        self.name = name
        self._stage = stage
        self.active: Flags = np.zeros(stage.rows, dtype=np.bool_)
        self._who: Rows | None = None
        """Rows in which it is active, until that changes."""
        self._arrays = {
            name: array
            for name, array in vars(stage).items()
            if isinstance(array, np.ndarray) and name != "air_speed"
        }
        """Arrays of the stage, of which each has one shape and type in all steps."""
        self._model = self._guarded(make, stage)
        self._zeros = np.zeros(stage.rows)
        self._stepped: Rows = np.empty(0, dtype=np.int64)

    def start(self, row: int, arguments: Mapping[str, Any]) -> None:
        """Begin in a robot."""
        self.active[row] = True
        self._who = None
        self._guarded(self._model.start, np.array([row]), arguments)

    def stop(self, row: int) -> None:
        """End in a robot, which halts."""
        if self.active[row]:
            self.active[row] = False
            self._who = None
            who = np.array([row])
            self._stage.halt(who)
            self._guarded(self._model.stop, who)

    def step(self, part: Part) -> list[tuple[int, int]]:
        """Decide what robots in some rows want; return those that have ended, with status."""
        if self._who is None:
            self._who = np.flatnonzero(self.active)
        who = self._who
        if not isinstance(part, slice):
            who = who[np.isin(who, part, assume_unique=True)]
        self._stepped = who
        if not len(who):
            return []
        status = self._guarded(self._model.step, who, self._stage.dt)
        shape = getattr(status, "shape", None)
        if shape != who.shape:
            what = type(status).__name__ if shape is None else shape
            raise ModelError(self.name, f"`step` returns {what}, not a status for each robot")
        stage = self._stage
        for wanted in (stage.wanted_x, stage.wanted_y, stage.wanted_z):
            # Zero, unless something is infinite or no number.
            if wanted.dot(self._zeros) != 0.0:
                raise ModelError(self.name, "`step` wants a velocity that is not finite")
        ended = (status != RUNNING).nonzero()[0]
        return list(zip(who[ended].tolist(), status[ended].tolist(), strict=True))

    def contacts(self) -> list[tuple[int, int]]:
        """Return the robots that something has stopped in this step, with their status."""
        if not self._model.stops_on_contact or not len(self._stepped):
            return []
        touched = self._stepped[self._stage.touched[self._stepped]]
        return [(row, ABORTED) for row in touched.tolist()]

    def result(self, row: int) -> Finding | Mapping[str, Any]:
        """Return what a robot has found."""
        found: Finding | Mapping[str, Any] = self._guarded(self._model.result, row)
        return found

    def _guarded(self, call: Callable[..., Any], *given: Any) -> Any:
        """Call a model, which may be that of a project: its errors are not ours."""
        try:
            found = call(*given)
        except SystemExit as error:
            raise ModelError(self.name, "it ends the process with `SystemExit`") from error
        except Exception as error:
            raise ModelError(self.name, error) from error
        now = vars(self._stage).get
        if not all(map(is_, map(now, self._arrays), self._arrays.values())):
            for name, array in self._arrays.items():
                if now(name) is not array:
                    self._check_replaced(name, now(name), array)
        return found

    def _check_replaced(self, name: str, new: Any, old: Any) -> None:
        if not isinstance(new, np.ndarray) or (new.shape, new.dtype) != (old.shape, old.dtype):
            reason = f"it replaces `stage.{name}` by something of another shape or type"
            raise ModelError(self.name, reason)
        self._arrays[name] = new
