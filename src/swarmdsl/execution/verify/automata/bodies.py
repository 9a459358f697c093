"""Bodies of a robot in the states of its automaton, each on the first way there that was found."""

from __future__ import annotations

from collections.abc import Callable

from swarmdsl.execution.verify.robot.body import Body
from swarmdsl.execution.verify.robot.tasks import Input

_MOST = 200
"""Number of bodies that wait: states are looked at in the order in which they were found."""


class Bodies:
    """Bodies in the states of an automaton.

    The way to a state is played, unless a body waits in it: it has just come there on this way, or
    an input has changed nothing.
    """

    def __init__(self, rest: Callable[[], Body], apply: Callable[[Body, Input], None]) -> None:
        self._rest = rest
        self._apply = apply
        self._origins: list[tuple[int, Input] | None] = []
        self._new: dict[int, Body] = {}
        self._unchanged: tuple[int, Body] | None = None

    def add(self, origin: tuple[int, Input] | None) -> None:
        """Note the state and the input from which the next state was found."""
        self._origins.append(origin)

    def at(self, number: int) -> Body:
        """Return a body in a state."""
        there, self._unchanged = self._unchanged, None
        if there is not None and there[0] == number:
            return there[1]
        if number in self._new:
            return self._new.pop(number)
        body = self._rest()
        body.start()
        for given in self._path(number):
            body.clock.now += 1
            self._apply(body, given)
        body.clock.now += 1
        return body

    def keep_new(self, number: int, body: Body) -> None:
        """Let a body wait in a state that it was the first to come to."""
        if len(self._new) < _MOST:
            body.seen = None
            body.clock.now += 1
            self._new[number] = body

    def keep_unchanged(self, number: int, body: Body) -> None:
        """Let a body wait in a state that it has not left."""
        body.seen = None
        self._unchanged = number, body

    def clear(self) -> None:
        """Free all that wait."""
        self._new.clear()
        self._unchanged = None

    def _path(self, number: int) -> list[Input]:
        path: list[Input] = []
        origin = self._origins[number]
        while origin is not None:
            number, given = origin
            path.append(given)
            origin = self._origins[number]
        return path[::-1]


def is_unchanged(body: Body) -> bool:
    """Return True if the last input was an event that changed nothing."""
    if body.failures or body.loop or body.sent or body.near.is_asked:
        return False
    return all(
        line.ignored and not (line.taken or line.deferred or line.dropped) for line in body.lines
    )


def take_back(body: Body) -> None:
    """Forget an input that changed nothing."""
    body.steps -= 1
    body.trace.count_anew()
