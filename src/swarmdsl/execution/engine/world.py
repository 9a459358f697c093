"""What is around an instance: the world that it acts on, and who watches it."""

from __future__ import annotations

from typing import Any, Callable, Protocol  # noqa: UP035 - for Python 3.8

from .activity import ActivityHost, Run
from .table import Event, InstanceLike, State, Transition


class ExecutionError(Exception):
    """A guard or an effect has no value; the machine goes on, with the event `error.execution`."""


FAILURES = (ExecutionError, ArithmeticError, ValueError)
"""What a guard or an effect may raise; anything else is a mistake in it."""


_RANGES = {
    f"{sign}int{bits}": (0, 2**bits - 1) if sign else (-(2 ** (bits - 1)), 2 ** (bits - 1) - 1)
    for sign in ("", "u")
    for bits in (8, 16, 32, 64)
}

LONGEST_TEXT = 1_000_000
"""How many characters an expression may put together."""


def bounded(value: Any, type_: str) -> Any:
    """Return a whole number or a text that the type can hold.

    Raises ExecutionError for one that it cannot: a model that multiplies in a circle would make
    ever longer ones.
    """
    if isinstance(value, str):
        if len(value) > LONGEST_TEXT:
            raise ExecutionError(f"a text of {len(value)} characters is too long")
        return value
    lowest, greatest = _RANGES[type_]
    if isinstance(value, int) and not lowest <= value <= greatest:
        raise ExecutionError(f"{value} is no {type_}")
    return value


class LoopError(Exception):
    """One event led to more and more steps; `states` are those of the last ones."""

    def __init__(self, machine: str, states: list[str]) -> None:
        names = ", ".join(f"`{state}`" for state in states)
        super().__init__(f"machine `{machine}` does not come to rest: it goes round in {names}")
        self.states = states


class World(ActivityHost, Protocol):
    """The clock, the servers of the activities, and those who hear of events.

    An instance calls these in the middle of a step. What happens in them may reach the same
    instance at once (`receive`, `Run.end`): it is looked at after the step.
    """

    def schedule(self, delay: int, action: Callable[[], None]) -> Any:
        """Call `action` once, in so many nanoseconds; return what `unschedule` takes."""

    def unschedule(self, handle: Any) -> None:
        """Do not call it any more."""

    def send(self, instance: InstanceLike, event: Event) -> None:
        """Bring an event of the instance to others."""

    def failed(self, instance: InstanceLike, error: Exception) -> None:
        """Say that a guard, an effect or a goal had no value: an event alone may be lost."""


class Observer:
    """Is told what an instance does, in order; a trace extends it."""

    def received(self, instance: InstanceLike, event: Event) -> None:
        """An event is looked at."""

    def exited(self, instance: InstanceLike, state: State) -> None:
        """A state has been left."""

    def taken(self, instance: InstanceLike, transition: Transition) -> None:
        """A transition is taken: the states have been left, its effect comes next."""

    def entered(self, instance: InstanceLike, state: State) -> None:
        """A state has been entered; its effects come next."""

    def started(self, instance: InstanceLike, run: Run) -> None:
        """An activity was started, or waits for its server."""

    def cancelled(self, instance: InstanceLike, run: Run) -> None:
        """The state of an activity that had not ended was left."""

    def sent(self, instance: InstanceLike, event: Event) -> None:
        """An event was sent to others."""

    def logged(self, instance: InstanceLike, text: str) -> None:
        """An effect has written a line."""
