"""One of many runs, in a process of its own: from a seed to plain data."""

from __future__ import annotations

import gc
import signal
from typing import NamedTuple

from swarmdsl.base.diagnostics.collector import Diagnostics
from swarmdsl.execution.engine import LoopError
from swarmdsl.execution.monitor import Verdict
from swarmdsl.execution.simulate.measures import evaluate, fitness_of, measures_of
from swarmdsl.execution.simulate.prepare import Prepared, Request, prepare
from swarmdsl.execution.simulate.properties import plan, watch, watchable
from swarmdsl.execution.simulate.reporter import observe
from swarmdsl.execution.simulate.run import DEFAULT_UNTIL, run
from swarmdsl.execution.simulate.world import World

QUIET = ("ended", "quiet")


class Outcome(NamedTuple):
    """Result of a run: verdicts by property, values of measures in order, and the fitness.

    A value is a number or a time in nanoseconds, and False if it was not reached. `remarks` say
    why a true verdict says nothing of the run, `reason` why there is no fitness, `failure` why
    a run has no result. `failed` are the evaluations that failed, by machine and reason.
    """

    seed: int
    verdicts: tuple[Verdict, ...] = ()
    measures: tuple[tuple[float | None, bool], ...] = ()
    fitness: float | None = None
    reason: str = ""
    failure: str = ""
    remarks: tuple[str, ...] = ()
    failed: tuple[tuple[tuple[str, str], int], ...] = ()


class Runner:
    """Runs with the same conditions and different seeds."""

    def __init__(self, request: Request, prepared: Prepared) -> None:
        self._request = request
        self._prepared = prepared
        subject = prepared.subject
        self.properties = [each for each in watchable(subject) if request.watches(each.name)]
        self.fitness = fitness_of(subject)
        self._plan = plan(self.properties, measures_of(self.fitness))
        self.first_seed = request.seed if request.seed is not None else prepared.scenario.seed

    def run(self, seed: int) -> Outcome:
        """Run the subject with a seed."""
        subject, scenario = self._prepared.subject, self._prepared.scenario
        cast, inputs = self._prepared.stage(Diagnostics())
        world = World(subject.system, cast, scenario, seed, [], subject.heartbeat)
        monitors = watch(self._plan, world.data)
        if self.properties or self.fitness is not None:
            observe(world.trace, monitors, world.clock)
        until = self._request.until if self._request.until is not None else scenario.until
        try:
            ending = run(world, inputs, until)
        except LoopError as error:
            return Outcome(seed, failure=str(error))
        now = world.clock.now
        results = monitors.results(now, ended=ending == "ended")
        outcome = Outcome(
            seed,
            tuple(each.verdict for each in results),
            remarks=tuple(each.remark for each in results),
            failed=tuple(world.failures.items()),
        )
        if self.fitness is None:
            return outcome
        last = sum(each.after for each in inputs)
        limit = until if until is not None else last + DEFAULT_UNTIL
        found = evaluate(self.fitness, monitors.readings(now, limit if ending in QUIET else now))
        measures = tuple((each.reading.value, each.reading.reached) for each in found.measures)
        return outcome._replace(measures=measures, fitness=found.value, reason=found.reason)


_runner: Runner | None = None


def begin(request: Request) -> None:
    """Load the model in a worker process, which leaves interrupts to the main one."""
    global _runner
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    gc.enable()
    prepared = prepare(request, Diagnostics())
    assert prepared is not None  # the main process has loaded it
    _runner = Runner(request, prepared)


def run_seed(seed: int) -> Outcome:
    """Run with a seed in a worker process."""
    assert _runner is not None
    return _runner.run(seed)
