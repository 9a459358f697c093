"""Session of a client, as the handlers of its requests use it."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import Any, Protocol

from swarmdsl.ide.debugger.breakpoints import Places
from swarmdsl.ide.debugger.controls import Controls
from swarmdsl.ide.debugger.inspection import Inspection
from swarmdsl.ide.debugger.messages import Arguments
from swarmdsl.ide.debugger.points import Way

Body = Mapping[str, Any] | None


class Session(Protocol):
    """Session of a client, as requests use it."""

    first_line: int
    first_column: int
    places: Places | None
    controls: Controls | None
    inspection: Inspection | None
    is_held: bool

    @property
    def reason(self) -> str:
        """Text of why the run stands still."""

    def event(self, name: str, body: Body = None) -> None:
        """Send an event to the client."""

    def tell(self, text: str, category: str = "stdout") -> None:
        """Tell the user a line."""

    def after_answer(self, act: Callable[[], None]) -> None:
        """Do something when the present request has been answered."""

    def set_speed(self, arguments: Arguments) -> None:
        """Let time pass at the speed of some arguments; raise RequestError for a wrong one."""

    def looking(self) -> Controls:
        """Return the controls of the run; raise RequestError if nothing is launched."""

    def standing(self) -> Inspection:
        """Return what looks into the run; raise RequestError unless it stands still."""

    def begin(self, arguments: Arguments) -> None:
        """Load the program of a launch; raise RequestError if there is none."""

    def configured(self) -> None:
        """Begin to run, when the request has been answered."""

    def again(self) -> None:
        """Begin anew with the files of now, when the request has been answered."""

    def go_on(self, way: Way) -> None:
        """Let the run go on, when the request has been answered."""

    def go_back(self, point: int, *, finds: bool = False) -> None:
        """Play the run again to a point, when the request has been answered."""

    def picture(self, member: int | None = None) -> dict[str, Any]:
        """Return the run as pages show it, with what is to see of a member."""


Handler = Callable[[Session, Arguments], Body]
"""Answers a request, or raises RequestError."""
