"""Drive a served world: wait for its nodes, then let time pass while they keep up."""

from __future__ import annotations

import time
from collections.abc import Callable
from typing import Literal

from swarmdsl.base import interrupts
from swarmdsl.execution.ros2_world.ports import Graph
from swarmdsl.execution.ros2_world.served import ServedWorld
from swarmdsl.execution.simulate.scenario.durations import SECOND

Ending = Literal["ended", "stopped"]
_TELL_AFTER = 5.0
"""Real time after which it is told who is missing, in seconds."""
_KNOWN = 0.5
"""Real time in which those that have found each other on one topic do so on all, in seconds."""
_NAP = 0.05


def wait_for_nodes(world: ServedWorld, graph: Graph, tell: Callable[[list[str]], None]) -> None:
    """Let time stand at 0 until each node has told its first line, and follows the clock.

    `tell` is called with those that are missing after a while.
    """
    # Goals may come before all are there.
    world.begin()
    members = len(world.recorded.missing)
    since, told = time.monotonic(), False
    while (missing := world.recorded.missing) or graph.clocks < members:
        graph.tell_time(0)
        graph.spin(_NAP)
        interrupts.raise_lost()
        if not told and time.monotonic() - since > _TELL_AFTER:
            told = True
            tell(missing)
    since = time.monotonic()
    while time.monotonic() - since < _KNOWN:
        graph.spin(_NAP)


def drive(world: ServedWorld, graph: Graph, step: int, until: int, factor: float) -> Ending:
    """Let time pass, by steps, at `factor` times the real time or slower.

    It stands while something that follows at once is under way between the world and its nodes.
    """
    clock = world.clock
    real = time.monotonic()
    while clock.now < until:
        following = min(clock.now + step, until)
        real += (following - clock.now) / SECOND / factor
        while (left := real - time.monotonic()) > 0:
            graph.spin(left)
            interrupts.raise_lost()
        # What was late is not made up for: nodes would be late more and more.
        real = max(real, time.monotonic() - step / SECOND / factor)
        _keep_up(world, graph)
        while (due := clock.next) is not None and due <= following:
            if due > clock.now:
                graph.tell_time(due)
            clock.step()
            _keep_up(world, graph)
        if world.over:
            return "ended"
        if following > clock.now:
            graph.tell_time(following)
            clock.advance(following - clock.now)
    return "ended" if world.over else "stopped"


def _keep_up(world: ServedWorld, graph: Graph) -> None:
    """Let nodes do what follows at once, before anything else happens in the world."""
    while world.holds.is_waiting:
        graph.spin(_NAP)
        interrupts.raise_lost()
