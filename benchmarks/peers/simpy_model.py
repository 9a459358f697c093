"""A crowd of robots in SimPy: processes that take events from stores."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any


def heard(talkers: int, listeners: int, seconds: int) -> int:
    """Let the talkers broadcast each second; return the number of events that were heard."""
    import simpy

    world = simpy.Environment()
    stores = [simpy.Store(world) for _ in range(talkers + listeners)]
    counts = [0] * len(stores)

    def hear(number: int) -> Iterator[Any]:
        while True:
            yield stores[number].get()
            counts[number] += 1

    def talk(number: int) -> Iterator[Any]:
        while True:
            yield world.timeout(1)
            for other, store in enumerate(stores):
                if other != number:
                    store.put("Hello")

    for number in range(len(stores)):
        world.process(hear(number))
    for number in range(talkers):
        world.process(talk(number))
    # The events of the last second are heard at that time.
    world.run(until=seconds + 0.5)
    return sum(counts)
