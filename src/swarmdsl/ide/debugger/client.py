"""Client of a run: its owner, and how this one leaves the run."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any, Protocol

from swarmdsl.execution.simulate.world.line import Line


class RunAgainError(BaseException):
    """The run is to be played again, to a point.

    It passes through the model of a function, which may handle every `Exception`.
    """

    def __init__(self, point: int, *, finds: bool = False) -> None:
        super().__init__(point)
        self.point = point
        self.finds = finds
        """True if the point is the last breakpoint before it."""


class EndedError(BaseException):
    """The session is over."""


class Client(Protocol):
    """Owner of a run, which a user drives."""

    def poll(self) -> None:
        """Handle what the user has asked for meanwhile."""

    def hold(self, reason: str, text: str) -> None:
        """Stand still until the user goes on; may raise RunAgainError or EndedError."""

    def tell(self, text: str, category: str = "stdout") -> None:
        """Tell the user a line."""

    def moved(self, line: Line) -> None:
        """Follow a step that the user sees."""

    def judged(self, result: Mapping[str, Any]) -> None:
        """Follow the result of a test."""
