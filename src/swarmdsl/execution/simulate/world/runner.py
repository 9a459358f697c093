"""Run a world, in virtual or real time."""

from __future__ import annotations

import time
from collections import deque
from collections.abc import Callable, Generator, Iterable, Iterator
from queue import SimpleQueue
from typing import Literal

from swarmdsl.base import interrupts
from swarmdsl.execution.simulate.inputs.events import Input
from swarmdsl.execution.simulate.scenario.durations import SECOND
from swarmdsl.execution.simulate.scenario.space import ABSTRACT
from swarmdsl.execution.simulate.world.world import World

DEFAULT_UNTIL = 10 * 60 * SECOND
"""Default limit of a run, after the last event from outside."""

Ending = Literal["ended", "quiet", "stopped"]
"""All machines ended; nothing is scheduled; the time limit was reached."""

# Short enough to notice an interrupt on every platform.
_NAP = 0.2
# Polling interval for events, in seconds.
_BLINK = 0.01


class Pace:
    """Synchronize virtual time with real time, or let it be `factor` times as fast."""

    def __init__(self, factor: float = 1.0) -> None:
        self._start = time.monotonic_ns()
        self._factor = factor

    @property
    def now(self) -> int:
        """Nanoseconds of virtual time since the start."""
        return round((time.monotonic_ns() - self._start) * self._factor)

    def wait(self, until: int) -> None:
        """Wait until a time."""
        while (left := until - self.now) > 0:
            time.sleep(min(left / SECOND / self._factor, _NAP))
            interrupts.raise_lost()


def run(
    world: World, inputs: Iterable[Input | None], until: int | None, pace: Pace | None = None
) -> Ending:
    """Start all machines and process the inputs; None stands for an invalid one.

    Raises LoopError if a machine does not come to rest.
    """
    steps = run_by_steps(world, inputs, until, pace)
    while True:
        try:
            next(steps)
        except StopIteration as stop:
            ending: Ending = stop.value
            return ending


def run_by_steps(
    world: World, inputs: Iterable[Input | None], until: int | None, pace: Pace | None = None
) -> Generator[None, None, Ending]:
    """Run likewise, and yield whenever the space of the world must move on with others.

    Its driver lets it before it goes on here.
    """
    world.begin()
    last = 0
    for each in inputs:
        if each is None:
            continue
        at = world.clock.now + each.after
        if until is not None and at > until:
            break
        yield from _let_happen(world, at, pace)
        if world.over:
            break
        if pace is not None:
            pace.wait(at)
        world.clock.advance(at - world.clock.now)
        world.deliver(each.event, each.data, each.to, each.sender)
        last = at
    end = until if until is not None else last + DEFAULT_UNTIL
    return (yield from _finish(world, end, pace))


def run_live(
    world: World, arrivals: SimpleQueue[Input | None], until: int | None, pace: Pace
) -> Ending:
    """Run in real time, with inputs that arrive at any time; None is the last one.

    Raises LoopError if a machine does not come to rest.
    """
    world.begin()
    while until is None or pace.now < until:
        while not arrivals.empty():
            each = arrivals.get()
            if each is None:
                return _finish_now(world, until or pace.now + DEFAULT_UNTIL, pace)
            world.clock.schedule(pace.now + each.after - world.clock.now, _arrival(world, each))
        deque(_let_happen(world, pace.now, None), maxlen=0)
        if world.over:
            return "ended"
        world.clock.advance(max(pace.now - world.clock.now, 0))
        time.sleep(_BLINK)
        interrupts.raise_lost()
    return _finish_now(world, until, pace)


def _arrival(world: World, each: Input) -> Callable[[], None]:
    return lambda: world.deliver(each.event, each.data, each.to, each.sender)


def _let_happen(world: World, until: int, pace: Pace | None) -> Iterator[None]:
    """Execute everything that is due until then; yield when its space must move on."""
    space = world.space
    if space is not ABSTRACT:
        space.limit = until if pace is None else -1
    while not world.over and (due := world.clock.next) is not None and due <= until:
        if pace is not None:
            pace.wait(due)
        world.step()
        if space.due:
            yield


def _finish_now(world: World, until: int, pace: Pace | None) -> Ending:
    """Finish a run whose space moves on by itself."""
    steps = _finish(world, until, pace)
    try:
        next(steps)
    except StopIteration as stop:
        ending: Ending = stop.value
        return ending
    raise AssertionError("a run in real time has a space of its own")


def _finish(world: World, until: int, pace: Pace | None) -> Generator[None, None, Ending]:
    yield from _let_happen(world, until, pace)
    if world.over:
        return "ended"
    if world.clock.next is None:
        return "quiet"
    if pace is not None:
        pace.wait(until)
    world.clock.advance(until - world.clock.now)
    return "stopped"
