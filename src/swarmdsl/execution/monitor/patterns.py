"""Patterns of properties: requirements on one part of a run.

Steps are the moments of a run at which something changes; times are nanoseconds. `P leads to Q`
is fulfilled by a Q at the same step.
"""

from __future__ import annotations

from collections.abc import Sequence


class Pattern:
    """Requirement on a part of a run, from its first step on.

    `broken` is the time at which it was violated; `owes` is True while something that must
    happen has not happened, at the latest at time `due` if that is not None.
    """

    broken: int | None = None
    due: int | None = None
    owes = False

    def step(self, time: int, claims: Sequence[bool]) -> None:
        """Process a step, with the truth of the claims."""
        raise NotImplementedError

    def advance(self, time: int) -> None:
        """Let time pass: what is due before is late."""
        if self.broken is None and self.due is not None and time > self.due:
            self.broken = self.due

    def close(self, time: int) -> None:
        """End the part of the run: what has not happened never will."""
        self.advance(time)
        if self.broken is None and self.owes:
            self.broken = time


class Never(Pattern):
    """`never P`."""

    def step(self, time: int, claims: Sequence[bool]) -> None:
        """Process a step."""
        if claims[0]:
            self.broken = time


class Always(Pattern):
    """`P at all times`."""

    def step(self, time: int, claims: Sequence[bool]) -> None:
        """Process a step."""
        if not claims[0]:
            self.broken = time


class Eventually(Pattern):
    """`eventually P within T`."""

    owes = True

    def __init__(self, start: int, within: int | None) -> None:
        self.due = None if within is None else start + within

    def step(self, time: int, claims: Sequence[bool]) -> None:
        """Process a step."""
        if claims[0]:
            self.owes, self.due = False, None


class LeadsTo(Pattern):
    """`P leads to Q within T`."""

    def __init__(self, within: int | None) -> None:
        self._within = within

    def step(self, time: int, claims: Sequence[bool]) -> None:
        """Process a step; the earliest P that waits for a Q is due first."""
        cause, effect = claims
        if effect:
            self.owes, self.due = False, None
        elif cause and not self.owes:
            self.owes = True
            self.due = None if self._within is None else time + self._within


class OnlyAfter(Pattern):
    """`P only after Q`."""

    _allowed = False

    def step(self, time: int, claims: Sequence[bool]) -> None:
        """Process a step."""
        self._allowed |= claims[1]
        if claims[0] and not self._allowed:
            self.broken = time


class AtMost(Pattern):
    """`P at most N times`: how often P becomes true, or happens if it is `momentary`."""

    def __init__(self, times: int, *, momentary: bool) -> None:
        self._left = times
        self._momentary = momentary
        self._held = False

    def step(self, time: int, claims: Sequence[bool]) -> None:
        """Process a step."""
        if claims[0] and (self._momentary or not self._held):
            self._left -= 1
        self._held = claims[0]
        if self._left < 0:
            self.broken = time


class Then(Pattern):
    """`P then Q then R`: in this order, perhaps at one step."""

    owes = True
    _next = 0

    def step(self, time: int, claims: Sequence[bool]) -> None:
        """Process a step."""
        while self._next < len(claims) and claims[self._next]:
            self._next += 1
        self.owes = self._next < len(claims)


class Again(Pattern):
    """`again and again P`: in a run that ends, P must hold in the end."""

    owes = True

    def step(self, time: int, claims: Sequence[bool]) -> None:
        """Process a step."""
        self.owes = not claims[0]


class Possible(Again):
    """`always possible P`: a run that goes on does not contradict it."""

    def close(self, time: int) -> None:
        """End the part of the run; P is still possible."""


def pattern_of(
    kind: str, start: int, within: int | None, times: int | None, *, momentary: bool
) -> Pattern:
    """Return the pattern of a kind, for a part of a run that begins at a time."""
    match kind:
        case "never":
            return Never()
        case "always":
            return Always()
        case "eventually":
            return Eventually(start, within)
        case "leads":
            return LeadsTo(within)
        case "only":
            return OnlyAfter()
        case "times":
            return AtMost(times or 0, momentary=momentary)
        case "then":
            return Then()
        case "again":
            return Again()
        case "possible":
            return Possible()
    raise ValueError(kind)
