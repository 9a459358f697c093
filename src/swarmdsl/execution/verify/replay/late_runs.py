"""Times for runs in which the clock of a property is late, found without clocks.

The steps of a run are given, and that the time of the property passes between two of them. Times
that fit all functions, delays and events are difference constraints.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from itertools import islice

from swarmdsl.base.records import replace
from swarmdsl.execution.monitor import FALSE
from swarmdsl.execution.simulate.evaluation.properties import plan
from swarmdsl.execution.simulate.evaluation.properties import watch as watched
from swarmdsl.execution.simulate.scenario.durations import MILLISECOND
from swarmdsl.execution.verify.properties.timed_observer import LATE
from swarmdsl.execution.verify.replay.play import Play
from swarmdsl.execution.verify.replay.spurious import exceeding
from swarmdsl.execution.verify.replay.times import Constraint, fitting, in_step
from swarmdsl.execution.verify.search.run import Run
from swarmdsl.execution.verify.swarm.groups import Step
from swarmdsl.execution.verify.swarm.network import Network
from swarmdsl.ir import Property

_MOST_LAST = 30
"""Maximum number of steps that are tried as the last one."""


def late(
    network: Network, steps: Sequence[Step], property_: Property, within: int, *, ended: bool
) -> Run:
    """Run steps on the engine, with the step `LATE` where the clock of a property is late.

    The run shows the property to be violated; otherwise that is a flaw. Its last line is one after
    this, unless the swarm has `ended`: nothing happens any more.
    """
    real = [step for step in steps if step is not LATE]
    if ended or len(real) == len(steps):
        run = _timed(network, real, property_, None, within, ended=ended)
        return replace(run, loop=0) if ended else run
    at = max(number for number, step in enumerate(steps) if step is LATE)
    before = sum(step is not LATE for step in steps[:at])
    if before < len(real):
        return _timed(network, real, property_, before, within)
    flaw = ""
    last = list(islice(_following(network, real), _MOST_LAST))
    for step in last:
        run = _timed(network, [*real, step], property_, before, within)
        if not run.flaw:
            return run
        flaw = run.flaw if not flaw or run.flaw == _too_slow(network) else flaw
    if last:
        return Run((), flaw=flaw)
    return replace(_timed(network, real, property_, None, within, ended=True), loop=0)


def _following(network: Network, steps: Sequence[Step]) -> Iterator[Step]:
    """Yield the steps of robots that can follow on others."""
    state = network.start()
    for step in steps:
        state = network.after(state, step)
    for _, step in network.followers(state):
        if step.move is not None:
            yield step


def _timed(
    network: Network,
    steps: Sequence[Step],
    property_: Property,
    before: int | None,
    within: int,
    *,
    ended: bool = False,
) -> Run:
    """Run steps at times that fit, with a longer time than `within` after a number of them."""
    timeless = Play(network, [0] * (len(steps) + 1), None)
    timeless.run(steps)
    if timeless.departs:
        return Run((), flaw=timeless.departs)
    if timeless.exceeds:
        return Run((), flaw=exceeding(network.capacity, timeless.exceeds))
    if timeless.overtakes:
        return Run((), flaw=f"an event overtakes an earlier one on `{timeless.overtakes}`")
    flaw = timeless.misfit
    constraints, slow = timeless.constraints(), timeless.constraints(slow=True)
    for late_ in _lateness(before, within):
        times = _times(timeless, [*constraints, *late_])
        if times is not None:
            run = _at(network, steps, property_, times, ended=ended)
            if not run.flaw:
                return run
            continue
        times = _times(timeless, [*slow, *late_])
        if times is not None and not _at(network, steps, property_, times, ended=ended).flaw:
            flaw = _too_slow(network)
            break
    return Run((), flaw=flaw)


def _times(timeless: Play, constraints: Sequence[Constraint]) -> list[int] | None:
    """Return times of the steps that fit, with losses of robots at heartbeats."""
    steps = timeless.now
    return in_step(lambda more: fitting(steps, [*constraints, *more]), timeless.beats())


def _too_slow(network: Network) -> str:
    """Return the flaw of a run that fits delays and events, but not the times of functions."""
    assert network.timing is not None
    usual = "in the scenario" if network.timing.scenario.functions else "1 s"
    return f"functions would take longer than {usual}"


def _lateness(before: int | None, within: int) -> Iterator[list[Constraint]]:
    """Yield constraints by which the time since a step is too long, for the latest step first."""
    if before is None:
        yield []
        return
    for began in range(before, -1, -1):
        yield [(before + 1, began, within + MILLISECOND)]


def _at(
    network: Network,
    steps: Sequence[Step],
    property_: Property,
    times: Sequence[int],
    *,
    ended: bool,
) -> Run:
    """Run steps at given times."""
    watch = watched(plan([property_]), lambda actor: timed.data(actor))
    timed = Play(network, times, watch)
    timed.run(steps)
    if timed.departs:
        return Run((), flaw=timed.departs)
    if not watch.violations and timed.late:
        return Run((), flaw=exceeding(network.capacity, timed.late))
    (result,) = watch.results(times[-1], ended=ended)
    if result.verdict != FALSE:
        return Run((), flaw="the monitor does not see a violation in it")
    return Run(tuple(timed.lines), tuple(timed.lost), tuple(timed.gone), causes=timed.causes)
