"""One of many runs, in a process of its own: from a seed to plain data."""

from __future__ import annotations

import gc
import signal
from collections.abc import Sequence
from typing import NamedTuple

from swarmdsl.base.diagnostics.collector import Diagnostics
from swarmdsl.execution.engine import LoopError
from swarmdsl.execution.monitor import Verdict, Watch
from swarmdsl.execution.simulate.evaluation.measures import (
    evaluate,
    fitness_of,
    inputs_of,
    measures_of,
)
from swarmdsl.execution.simulate.evaluation.properties import plan, watch, watchable
from swarmdsl.execution.simulate.evaluation.reporter import observe
from swarmdsl.execution.simulate.inputs.events import Input
from swarmdsl.execution.simulate.run.prepare import Prepared, Request, prepare
from swarmdsl.execution.simulate.scenario.space import ModelError, Space
from swarmdsl.execution.simulate.world.runner import DEFAULT_UNTIL, Ending, run, run_by_steps
from swarmdsl.execution.simulate.world.world import World

QUIET = ("ended", "quiet")
_CHUNK = 4
"""Number of runs that a worker gets at a time, without places."""
_ROWS, _MOST_TOGETHER = 2000, 30
"""Number of robots that move together, and of runs."""


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


class _Started(NamedTuple):
    """A run that goes on."""

    seed: int
    world: World
    monitors: Watch
    inputs: Sequence[Input]


class Runner:
    """Runs with the same conditions and different seeds."""

    def __init__(self, request: Request, prepared: Prepared) -> None:
        self._request = request
        self._prepared = prepared
        subject = prepared.subject
        self.properties = [each for each in watchable(subject) if request.watches(each.name)]
        self.fitness = fitness_of(subject)
        self._plan = plan(self.properties, measures_of(self.fitness))
        asked = (each.space for each in inputs_of(self.fitness))
        self._covers = any(each is not None and each.quantity == "covered" for each in asked)
        self.first_seed = request.seed if request.seed is not None else prepared.scenario.seed

    def run(self, seed: int) -> Outcome:
        """Run the subject with a seed."""
        started = self._start(seed, self._prepared.spaces.alone(seed, covers=self._covers))
        try:
            ending = run(started.world, started.inputs, self._until)
        except (LoopError, ModelError) as error:
            return Outcome(seed, failure=str(error))
        return self._outcome(started, ending)

    def run_all(self, seeds: Sequence[int]) -> list[Outcome]:
        """Run the subject with some seeds; robots with places move together."""
        if len(seeds) < 2 or not self.is_together:
            return [self.run(seed) for seed in seeds]
        ensemble = self._prepared.spaces.together(seeds, covers=self._covers)
        started = [
            self._start(seed, space) for seed, space in zip(seeds, ensemble.spaces, strict=True)
        ]
        found: dict[int, Outcome] = {}
        going = [(each, run_by_steps(each.world, each.inputs, self._until)) for each in started]
        try:
            while going:
                still = []
                for each, steps in going:
                    if each.world.space.due:
                        still.append((each, steps))
                        continue
                    try:
                        each.world.space.check()
                        next(steps)
                        still.append((each, steps))
                        continue
                    except StopIteration as stop:
                        found[each.seed] = self._outcome(each, stop.value)
                    except LoopError as error:
                        found[each.seed] = Outcome(each.seed, failure=str(error))
                    each.world.space.due = False
                going = still
                ensemble.advance()
        except ModelError:
            # It may be the fault of one run: each has its own then.
            return [self.run(seed) for seed in seeds]
        return [found[seed] for seed in seeds]

    @property
    def is_together(self) -> bool:
        """True if the robots of several runs move together."""
        return self._prepared.spaces.is_flat

    @property
    def batch(self) -> int:
        """Number of runs to do at a time."""
        if not self.is_together:
            return _CHUNK
        subject = self._prepared.subject
        robots = max(subject.size(self._prepared.scenario.counts), 1)
        return min(max(_ROWS // robots, 1), _MOST_TOGETHER)

    @property
    def _until(self) -> int | None:
        until = self._request.until
        return until if until is not None else self._prepared.scenario.until

    def _start(self, seed: int, space: Space) -> _Started:
        """Make the world of a run."""
        subject, scenario = self._prepared.subject, self._prepared.scenario
        cast, inputs = self._prepared.stage(Diagnostics())
        world = World(subject.system, cast, scenario, seed, [], subject.heartbeat, space)
        monitors = watch(self._plan, world.data)
        if self.properties or self.fitness is not None:
            observe(world.trace, monitors, world.clock)
        return _Started(seed, world, monitors, inputs)

    def _outcome(self, started: _Started, ending: Ending) -> Outcome:
        """Return the outcome of a run that is over."""
        seed, world, monitors, inputs = started
        until, now = self._until, world.clock.now
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
        readings = monitors.readings(now, limit if ending in QUIET else now)
        found = evaluate(self.fitness, readings, world.space)
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


def run_seeds(seeds: Sequence[int]) -> list[Outcome]:
    """Run with some seeds in a worker process."""
    assert _runner is not None
    return _runner.run_all(seeds)
