"""Monitor of a property as a table with its clock, in ticks."""

from __future__ import annotations

from swarmdsl.execution.verify.properties.monitor_table import MonitorTable


class ClockTable:
    """States of a monitor with the ticks since its clock began, which may be `within`."""

    def __init__(self, table: MonitorTable, within: int) -> None:
        self.inner = table
        self._within = within
        self._size = table.size
        self._steps: dict[tuple[int, tuple[bool, ...]], tuple[int, bool]] = {}
        """State of the monitor after a step, and True if its clock goes on."""

    @property
    def size(self) -> int:
        """Number of states there may be."""
        return self._size * (self._within + 1)

    def step(self, state: int, truths: tuple[bool, ...]) -> int:
        """Return the state after a step."""
        elapsed, before = divmod(state, self._size)
        found = self._steps.get((before, truths))
        if found is None:
            after = self.inner.step(before, truths)
            begins = self.inner.begins(before, truths)
            found = self._steps[before, truths] = after, not begins and self.inner.has_clock(after)
        after, goes_on = found
        return elapsed * self._size + after if goes_on else after

    def tick(self, state: int) -> int:
        """Return the state a tick later."""
        elapsed, before = divmod(state, self._size)
        if not self.inner.has_clock(before):
            return state
        if elapsed == self._within:
            return self.inner.late(before)
        return state + self._size

    def is_bad(self, state: int) -> bool:
        """Return True if the property is violated."""
        return self.inner.is_bad(state % self._size)

    def is_settled(self, state: int) -> bool:
        """Return True if it cannot be violated any more."""
        return self.inner.is_settled(state % self._size)

    def fails_at_end(self, state: int) -> bool:
        """Return True if the property is violated when nothing happens any more."""
        return self.inner.fails_at_end(state % self._size)


Table = MonitorTable | ClockTable
