"""Observers of a property about time: in a swarm with clocks, and in one that takes any time."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from swarmdsl import ir
from swarmdsl.execution.verify.properties.clock_table import ClockTable
from swarmdsl.execution.verify.properties.monitor_table import MonitorTable
from swarmdsl.execution.verify.properties.observer import Observer
from swarmdsl.execution.verify.properties.truths import Sight
from swarmdsl.execution.verify.swarm.groups import TICK, Step
from swarmdsl.execution.verify.swarm.network import Network
from swarmdsl.execution.verify.swarm.timed_network import TimedNetwork

LATE = Step(-2, None, -2)
"""Step of the observer alone: the time of its clock passes."""
DEFERRAL = Step(-3, None, -3)
"""Step of a robot that defers one more event of a name, which stays on its way in the network."""


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
    """Follow a property in a network with clocks.

    A robot that defers one more event of a name ends what held for a moment. It may do so at any
    time: that includes the time at which the event arrives.
    """

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
        self._deferring: dict[int, bool] = {}
        """Places at which an event stays on its way."""

    def following(self, state: int) -> Iterator[int]:
        """Yield the states after one step or a tick, each at least once."""
        yield from super().following(state)
        yield from self._deferred(state)
        later = self._later(state)
        if later is not None:
            yield later

    def passing(self, state: int) -> Iterator[tuple[int, Step, Sequence[int]]]:
        """Yield the states after one step or a tick, with the memories at its moments."""
        yield from super().passing(state)
        for after in self._deferred(state):
            yield after, DEFERRAL, [after & self.mine]
        later = self._later(state)
        if later is not None:
            yield later, TICK, [later & self.mine]

    def _deferred(self, state: int) -> Iterator[int]:
        """Yield the state after a deferral, if that is another one."""
        present = self.timed.present(state)
        if self.forgets and any(self._defers(place) for place, _ in present):
            memory = state & self.mine
            after = state - memory + self._silence(memory, Sight(present))
            if after != state:
                yield after

    def _defers(self, place: int) -> bool:
        if place not in self._deferring:
            group, state, bag = self.timed.places[place]
            is_late = self.timed.groups[group].automaton.is_late
            self._deferring[place] = any(is_late(state, self.timed.message(m)) for m in bag)
        return self._deferring[place]

    def _later(self, state: int) -> int | None:
        later = self.timed.later(state)
        if later is None:
            return None
        memory = later & self.mine
        return later - memory + self._clock.tick(memory)
