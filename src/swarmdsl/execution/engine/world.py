"""Environment of an instance: its world and its observer."""

from __future__ import annotations

from typing import Any, Callable, Protocol  # noqa: UP035 - for Python 3.8

from .activity import ActivityHost, Run
from .table import Event, InstanceLike, State, Transition


class ExecutionError(Exception):
    """Error in a guard or effect; the machine continues with `error.execution`."""


FAILURES = (ExecutionError, ArithmeticError, ValueError)
"""Errors that guards and effects may raise; any other is a bug in them."""


_RANGES = {
    f"{sign}int{bits}": (0, 2**bits - 1) if sign else (-(2 ** (bits - 1)), 2 ** (bits - 1) - 1)
    for sign in ("", "u")
    for bits in (8, 16, 32, 64)
}

MAX_STRING_LENGTH = 1_000_000
"""Maximum length of strings in expressions."""


def bounded(value: Any, type_: str) -> Any:
    """Return an integer or string if it is in the range of the type.

    Otherwise raises ExecutionError: repeated multiplication would yield ever larger values.
    """
    if isinstance(value, str):
        if len(value) > MAX_STRING_LENGTH:
            raise ExecutionError(f"a string of {len(value)} characters is too long")
        return value
    lowest, greatest = _RANGES[type_]
    if isinstance(value, int) and not lowest <= value <= greatest:
        raise ExecutionError(f"{value} is out of range of {type_}")
    return value


class LoopError(Exception):
    """An event leads to an endless loop; `states` are those of the last steps."""

    def __init__(self, machine: str, states: list[str]) -> None:
        names = ", ".join(f"`{state}`" for state in states)
        super().__init__(f"machine `{machine}` does not come to rest: it loops through {names}")
        self.states = states


class World(ActivityHost, Protocol):
    """Clock, servers of activities, and receivers of events.

    An instance calls these during a step. They may call `receive` or `Run.end` of the same
    instance, which take effect after the step.
    """

    @property
    def time(self) -> int:
        """The time in nanoseconds, from any zero; delays pass in it."""

    def schedule(self, delay: int, action: Callable[[], None]) -> Any:
        """Call `action` after a delay in nanoseconds; return a handle for `unschedule`."""

    def unschedule(self, handle: Any) -> None:
        """Cancel a scheduled call."""

    def send(self, instance: InstanceLike, event: Event) -> None:
        """Deliver an event of the instance to others."""

    def failed(self, instance: InstanceLike, error: Exception) -> None:
        """Report a failed guard, effect or goal: the event alone may be ignored."""


class Observer:
    """Receives the actions of an instance, in order; base class of traces."""

    def received(self, instance: InstanceLike, event: Event) -> None:
        """Handle an event that is about to be processed."""

    def ignored(self, instance: InstanceLike, event: Event) -> None:
        """Handle an event from outside that enables no transition."""

    def deferred(self, instance: InstanceLike, event: Event) -> None:
        """Handle an event that is kept until a state that does not defer it."""

    def dropped(self, instance: InstanceLike, event: Event) -> None:
        """Handle the oldest deferred event, which is forgotten because there are too many."""

    def recalled(self, instance: InstanceLike, event: Event) -> None:
        """Handle a deferred event that is about to be processed."""

    def exited(self, instance: InstanceLike, state: State) -> None:
        """Handle the exit of a state."""

    def taken(self, instance: InstanceLike, transition: Transition) -> None:
        """Handle a transition, after the exits and before its effect."""

    def entered(self, instance: InstanceLike, state: State) -> None:
        """Handle the entry of a state, before its entry effects."""

    def started(self, instance: InstanceLike, run: Run) -> None:
        """Handle an activity that was started or waits for its server."""

    def cancelled(self, instance: InstanceLike, run: Run) -> None:
        """Handle the exit of a state with a running activity."""

    def sent(self, instance: InstanceLike, event: Event) -> None:
        """Handle an event that was sent to others."""

    def scheduled(self, instance: InstanceLike, event: Event, delay: int) -> None:
        """Handle an event that will be sent to others after a delay in nanoseconds."""

    def withdrawn(self, instance: InstanceLike, event: Event) -> None:
        """Handle an event whose delayed sending was cancelled."""

    def logged(self, instance: InstanceLike, text: str) -> None:
        """Handle a line that an effect has written."""
