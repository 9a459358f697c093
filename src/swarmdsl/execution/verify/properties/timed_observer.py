"""Observers of a property about time: in a swarm with clocks, and in one that takes any time."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from swarmdsl import ir
from swarmdsl.execution.verify.properties.clock_table import ClockTable
from swarmdsl.execution.verify.properties.monitor_table import MonitorTable
from swarmdsl.execution.verify.properties.observer import Observer
from swarmdsl.execution.verify.swarm.groups import TICK, Step
from swarmdsl.execution.verify.swarm.network import Network
from swarmdsl.execution.verify.swarm.timed_network import TimedNetwork

LATE = Step(-2, None, -2)
"""Step of the observer alone: the time of its clock passes."""


class LateObserver(Observer):
    """Follow a property in a network without clocks; its own clock may be late at any time."""

    def __init__(
        self,
        property_: ir.Property,
        table: MonitorTable,
        network: Network,
        me: int | None,
        *,
        others: bool = False,
    ) -> None:
        super().__init__(property_, table, network, me, others=others)
        self._late_table = table

    def following(self, state: int) -> Iterator[int]:
        """Yield the states after one step, each at least once."""
        yield from super().following(state)
        yield from self._late(state)

    def passing(self, state: int) -> Iterator[tuple[int, Step, Sequence[int]]]:
        """Yield the states after one step, with the memories at its moments."""
        yield from super().passing(state)
        for late in self._late(state):
            yield late, LATE, [late & self.mine]

    def _late(self, state: int) -> Iterator[int]:
        memory = state & self.mine
        if self._late_table.has_clock(memory):
            yield state - memory + self._late_table.late(memory)


class TimedObserver(Observer):
    """Follow a property in a network with clocks."""

    def __init__(
        self,
        property_: ir.Property,
        table: ClockTable,
        network: TimedNetwork,
        me: int | None,
        *,
        others: bool = False,
    ) -> None:
        super().__init__(property_, table, network, me, others=others)
        self._clock = table
        self.timed = network

    def following(self, state: int) -> Iterator[int]:
        """Yield the states after one step or a tick, each at least once."""
        yield from super().following(state)
        later = self._later(state)
        if later is not None:
            yield later

    def passing(self, state: int) -> Iterator[tuple[int, Step, Sequence[int]]]:
        """Yield the states after one step or a tick, with the memories at its moments."""
        yield from super().passing(state)
        later = self._later(state)
        if later is not None:
            yield later, TICK, [later & self.mine]

    def _later(self, state: int) -> int | None:
        later = self.timed.later(state)
        if later is None:
            return None
        memory = later & self.mine
        return later - memory + self._clock.tick(memory)
