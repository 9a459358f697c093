"""Runs of real robots with clocks: the search has found who does what when."""

from __future__ import annotations

from collections import deque
from collections.abc import Sequence
from itertools import accumulate

from swarmdsl.base.records import replace
from swarmdsl.execution.monitor import FALSE, Watch
from swarmdsl.execution.simulate.evaluation.properties import plan
from swarmdsl.execution.simulate.evaluation.properties import watch as watched
from swarmdsl.execution.verify.automata.clocks import ClockedAutomaton
from swarmdsl.execution.verify.properties.timed_observer import DEFERRAL
from swarmdsl.execution.verify.replay.play import Play
from swarmdsl.execution.verify.replay.spurious import DEFERS, exceeding
from swarmdsl.execution.verify.search.run import Run
from swarmdsl.execution.verify.swarm.groups import TICK, Step
from swarmdsl.execution.verify.swarm.timed_network import TimedNetwork
from swarmdsl.ir import Property

_MOST_LOOKED_AT = 20_000
"""Maximum number of states among which a next step is looked for."""


def play_timed(
    network: TimedNetwork,
    steps: Sequence[Step],
    property_: Property | None = None,
    *,
    ended: bool = False,
) -> Run:
    """Run the steps and ticks of a network on the engine.

    The run shows the property, if one is given, to be violated; otherwise that is a flaw. If the
    swarm has `ended`, nothing more is on its way and nothing happens any more.
    """
    times = [0, *accumulate(network.tick * (step is TICK) for step in steps)]
    watch: Watch | None = None
    if property_ is not None:
        watch = watched(plan([property_]), lambda actor: played.data(actor))
    played = _TimedPlay(network, times, watch)
    played.run(steps)
    if played.departs:
        return Run((), flaw=played.departs)
    if played.exceeds or (ended and played.late):
        return Run((), flaw=exceeding(network.capacity, played.exceeds or played.late))
    if played.overtakes:
        return Run((), flaw=f"an event overtakes an earlier one on `{played.overtakes}`")
    if any(times[later] - times[earlier] < least for later, earlier, least in played.constraints()):
        late = played.late
        return Run((), flaw=exceeding(network.capacity, late) if late else played.misfit)
    if watch is not None:
        (result,) = watch.results(times[-1], ended=ended)
        if result.verdict != FALSE:
            return Run((), flaw="the monitor does not see a violation in it")
    return Run(tuple(played.lines), tuple(played.lost), causes=played.causes)


def violating(
    network: TimedNetwork, steps: Sequence[Step], property_: Property, *, ended: bool
) -> Run:
    """Return the run of some steps that violate a property at their end.

    If they do so because time passes, it has one more line: a trace has no time without one. If the
    swarm has `ended`, or nothing follows, nothing happens any more.
    """
    more = list(steps)
    if not ended and steps and steps[-1] is TICK:
        following = _next(network, steps)
        ended = following is None
        more += following or []
    run = play_timed(network, more, property_, ended=ended)
    return replace(run, loop=0) if ended else run


def _next(network: TimedNetwork, steps: Sequence[Step]) -> list[Step] | None:
    """Return the way to the next step of a robot after some steps; None if none follows."""
    first = network.start()
    for step in steps:
        first = network.after(first, step)
    before: dict[int, tuple[int, Step] | None] = {first: None}
    todo = deque([first])
    while todo and len(before) < _MOST_LOOKED_AT:
        state = todo.popleft()
        for after, step in network.followers(state):
            if step is not TICK and step.move is not None:
                way = [step]
                while (link := before[state]) is not None:
                    state, step = link
                    way.append(step)
                return way[::-1]
            if after not in before:
                before[after] = (state, step)
                todo.append(after)
    return None


class _TimedPlay(Play):
    """The robots of a run with clocks."""

    def __init__(self, network: TimedNetwork, times: Sequence[int], watch: Watch | None) -> None:
        super().__init__(network, times, watch)
        self._timed = network

    def take(self, step: Step) -> None:
        """Take a step, or let time pass."""
        if step is DEFERRAL:
            self.departs = DEFERS
            return
        if step is not TICK:
            super().take(step)
            return
        for robot in self.robots:
            group = self._timed.groups.index(robot.group)
            for copy in robot.bag:
                older = self._timed.aged(group, robot.state, (copy.number,))
                assert older is not None
                (copy.number,) = older
            automaton = robot.group.automaton
            if isinstance(automaton, ClockedAutomaton):
                later = automaton.later(robot.state)
                assert later is not None
                robot.state = later
