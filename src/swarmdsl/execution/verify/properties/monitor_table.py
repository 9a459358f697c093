"""Automaton of a monitor, as a table."""

from __future__ import annotations

from itertools import product

from swarmdsl.execution.monitor import OPEN, Monitor, Sentence

MOST_CLAIMS = 10
"""Number of claims up to which all combinations of their truth are looked at."""
_DUE = 1 << 62
"""Time at which a clock that is running is due; one that has just begun is due earlier."""


class MonitorTable:
    """The automaton of a monitor, as a table: states are numbers, 0 is before the first step.

    The clock of `within` is only running or not; it may be `late` at any time.
    """

    def __init__(self, sentence: Sentence, claims: int, scope: int) -> None:
        self._claims, self._scope = claims, scope
        self._monitors = [Monitor(sentence)]
        self._numbers = {self._monitors[0].memory: 0}
        self._steps: dict[tuple[int, tuple[bool, ...]], int] = {}
        self._settled: set[int] = set()
        self._beginning: set[tuple[int, tuple[bool, ...]]] = set()
        self._late: dict[int, int] = {}
        self._look_ahead()

    def step(self, state: int, truths: tuple[bool, ...]) -> int:
        """Return the state after a step."""
        found = self._steps.get((state, truths))
        if found is None:
            monitor = self._monitors[state].copy()
            monitor.step(0, truths[: self._claims], truths[self._claims :])
            if monitor.clock not in (None, _DUE):
                self._beginning.add((state, truths))
            found = self._steps[state, truths] = self._number(monitor)
        return found

    def begins(self, state: int, truths: tuple[bool, ...]) -> bool:
        """Return True if the clock begins at a step."""
        self.step(state, truths)
        return (state, truths) in self._beginning

    def has_clock(self, state: int) -> bool:
        """Return True if the clock is running."""
        return self._monitors[state].clock is not None

    def late(self, state: int) -> int:
        """Return the state after the time of the clock has passed."""
        if state not in self._late:
            monitor = self._monitors[state].copy()
            monitor.advance(_DUE + 1)
            self._late[state] = self._number(monitor)
        return self._late[state]

    def is_bad(self, state: int) -> bool:
        """Return True if the property is violated."""
        return self._monitors[state].violated is not None

    def is_settled(self, state: int) -> bool:
        """Return True if it cannot be violated any more."""
        return state in self._settled

    def fails_at_end(self, state: int) -> bool:
        """Return True if the property is violated when nothing happens any more."""
        monitor = self._monitors[state].copy()
        monitor.finish(0, ended=True)
        return monitor.violated is not None

    @property
    def size(self) -> int:
        """Number of states known."""
        return len(self._monitors)

    def _number(self, monitor: Monitor) -> int:
        monitor.forget_times(_DUE)
        found = self._numbers.setdefault(monitor.memory, len(self._monitors))
        if found == len(self._monitors):
            self._monitors.append(monitor)
        return found

    def _look_ahead(self) -> None:
        every = list(product((False, True), repeat=self._claims + self._scope))
        number = 0
        while number < len(self._monitors):
            for truths in every:
                self.step(number, truths)
            if self.has_clock(number):
                self.late(number)
            number += 1
        dangerous = {
            state
            for state in range(number)
            if self.is_bad(state) or self._monitors[state].state == OPEN
        }
        grown = True
        while grown:
            more = {s for (s, _), target in self._steps.items() if target in dangerous}
            grown = not more <= dangerous
            dangerous |= more
        self._settled = set(range(number)) - dangerous
