"""Search for the best candidate: from a plan to the winner beside today's model.

1. Where all candidates can be tried, they race. Otherwise a method proposes generations, each
   candidate of which runs with a few seeds, the same for all, and the best of them race with
   others.
2. The winner and today's model run with fresh seeds, of which the search has seen none: the mean
   of the winner is not the one that made it win.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from typing import Any

from swarmdsl.base.records import dataclass
from swarmdsl.execution.estimation.sample import Sample, summarize
from swarmdsl.execution.experiments.comparing import Comparison, compare_paired
from swarmdsl.execution.experiments.failures import StoppedError
from swarmdsl.execution.experiments.running import Runs
from swarmdsl.execution.experiments.search.evaluation import (
    Aim,
    Evaluation,
    losses,
    ranked,
    values_of,
    violation,
)
from swarmdsl.execution.experiments.search.methods import Name, is_small, method_of
from swarmdsl.execution.experiments.search.race import race, rounds_of
from swarmdsl.execution.experiments.search.space import Point, SearchSpace
from swarmdsl.execution.experiments.task import NO_SCENARIO, Candidate, Task

SEARCH_SEEDS, FINALISTS = 10, 10
"""Seeds of each candidate that a method proposes, and how many of the best race."""
_FRESH = 1_000_000
"""Distance of the fresh seeds from the first one."""
_ERROR = 0.05
"""Probability to lose the best candidate in the race."""


@dataclass(frozen=True)
class Plan:
    """Space, aim and length of a search.

    `evaluations` is the number of candidates that are tried, `seeds` the most seeds of one in the
    race, `fresh` the seeds of the winner and of today's model, `seed` the first one.
    """

    space: SearchSpace
    aim: Aim
    scenarios: tuple[str, ...]
    method: Name = "auto"
    evaluations: int = 200
    seeds: int = 30
    fresh: int = 100
    seed: int = 0
    level: float = 0.95

    @property
    def chosen(self) -> str:
        """Method of the search: all candidates if they are few."""
        if self.method == "auto":
            return "all" if is_small(self.space, self.evaluations) else "cma"
        return self.method

    @property
    def expected(self) -> int:
        """Number of runs, at most."""
        fresh = 2 * self.fresh
        if self.chosen == "all":
            return len(self.scenarios) * ((self.space.size or 0) * self.seeds + fresh)
        few = min(SEARCH_SEEDS, self.seeds)
        finals = min(FINALISTS, self.evaluations) * self.seeds
        return len(self.scenarios) * (self.evaluations * few + finals + fresh)


@dataclass(frozen=True)
class Found:
    """Result of a search; `winner` and `today` are of fresh seeds.

    `finals` are the evaluations of the race, the best first, `tried` all candidates.
    """

    winner: Evaluation
    today: Evaluation
    comparison: Comparison | None
    finals: tuple[Evaluation, ...]
    tried: int

    def sample(self, of: Evaluation, level: float) -> Sample | None:
        """Return the summary of an evaluation."""
        return summarize(list(of.values.values()), level) if not of.broken else None


Tell = Callable[[dict[str, Any]], None]
"""Takes a line of the history."""


class Search:
    """A search, with what is known of it at any time."""

    def __init__(self, plan: Plan, runs: Runs, digest: str, tell: Tell) -> None:
        self._plan = plan
        self._runs = runs
        self._digest = digest
        self._tell = tell
        self.best: Evaluation | None = None
        """Best candidate so far."""
        self.tried = 0

    def run(self) -> Found:
        """Search; raise StoppedError if no candidate is possible."""
        plan = self._plan
        if plan.chosen == "all":
            points = plan.space.grid(plan.evaluations)
            candidates = list(dict.fromkeys(plan.space.candidate(each) for each in points))
            self.tried = len(candidates)
            first = plan.seed
        else:
            candidates = self._finalists()
            first = plan.seed + min(SEARCH_SEEDS, plan.seeds)
        finals = self._race([Evaluation(each) for each in candidates], first)
        return self._measure(finals)

    def _finalists(self) -> list[Candidate]:
        """Return the best candidates that a method has proposed."""
        tried: dict[Candidate, Evaluation] = {}
        seeds = range(self._plan.seed, self._plan.seed + min(SEARCH_SEEDS, self._plan.seeds))
        worst = float("-inf")
        for number, (points, method) in enumerate(self._generations()):
            found = [Evaluation(self._plan.space.candidate(point)) for point in points]
            self._add(found, seeds)
            for each in found:
                self._say("search", each, generation=number)
                tried.setdefault(each.candidate, each)
            self._note(ranked(tried.values(), self._plan.aim))
            values = losses(found, self._plan.aim, worst)
            means = (each.mean for each in tried.values())
            worst = max(
                [self._plan.aim.loss(mean) for mean in means if mean is not None] or [worst]
            )
            method.tell(points, values)
        best = ranked(tried.values(), self._plan.aim)[:FINALISTS]
        if not best:
            raise self._none_possible(list(tried.values()))
        return [each.candidate for each in best]

    def _generations(self) -> Iterator[tuple[list[Point], Any]]:
        plan = self._plan
        name: Any = plan.chosen
        method = method_of(name, plan.space, plan.evaluations, plan.seed)
        while self.tried < plan.evaluations:
            points = method.ask(plan.evaluations - self.tried)
            if not points:
                return
            self.tried += len(points)
            yield points, method

    def _race(self, found: Sequence[Evaluation], first: int) -> list[Evaluation]:
        """Return the evaluations of a race, the best first, those that left after the others."""
        left: list[Evaluation] = []
        survivors: Sequence[Evaluation] = found
        rounds = rounds_of(first, self._plan.seeds)
        for each in race(found, self._add, self._plan.aim, rounds, _ERROR):
            for evaluation in each.ran:
                is_out = evaluation in each.left
                more = {"left": True} if is_out else {}
                self._say("race", evaluation, round=each.number, **more)
            left = [*ranked(each.left, self._plan.aim), *left]
            survivors = each.survivors
            self._note(survivors)
        if not survivors:
            raise self._none_possible(found)
        # Of equal ones, the best is that which changes less of the model.
        space, aim = self._plan.space, self._plan.aim

        def order(each: Evaluation) -> tuple[float, int]:
            return aim.loss(each.mean or 0.0), len(space.changed(each.candidate).settings)

        return [*sorted(survivors, key=order), *left]

    def _measure(self, finals: Sequence[Evaluation]) -> Found:
        """Measure the winner and today's model; a winner that is not possible is no winner."""
        plan = self._plan
        fresh = range(plan.seed + _FRESH, plan.seed + _FRESH + plan.fresh)
        today = Evaluation(Candidate())
        self._add([today], fresh)
        self._say("today", today)
        for each in finals:
            winner = Evaluation(each.candidate)
            self._add([winner], fresh)
            self._say("winner", winner)
            if winner.mean is not None:
                break
        else:
            raise self._none_possible([winner])
        self.best = winner
        comparison = None
        if today.mean is not None:
            left, right = values_of(winner, today)
            comparison = compare_paired(left, right, plan.aim.goal, plan.level)
        ordered = [each for each in finals if each.candidate == winner.candidate]
        ordered += [each for each in finals if each.candidate != winner.candidate]
        return Found(winner, today, comparison, tuple(ordered), self.tried)

    def _add(self, found: Sequence[Evaluation], seeds: range) -> None:
        """Run candidates with some seeds, in each scenario."""
        scenarios = self._plan.scenarios
        tasks = [
            Task(self._digest, scenario, each.candidate, tuple(seeds))
            for each in found
            for scenario in scenarios
        ]
        rows = iter(self._runs.run(tasks))
        for each in found:
            each.add([next(rows) for _ in scenarios], self._plan.aim)

    def _note(self, best: Sequence[Evaluation]) -> None:
        self.best = best[0] if best else self.best

    def _say(self, stage: str, found: Evaluation, **more: Any) -> None:
        self._tell({"stage": stage, **more, **found.as_data()})

    def _none_possible(self, found: Sequence[Evaluation]) -> StoppedError:
        faults = [each.fault for each in found if each.fault]
        fault = max(set(faults), key=lambda each: (faults.count(each), each))
        reason = next(each.reason for each in found if each.fault == fault)
        if fault in map(violation, self._plan.aim.properties):
            help_ = "widen the ranges of `optimize`, or ask for less"
        elif self._plan.scenarios == (NO_SCENARIO,):
            help_ = "add `--scenario FILE`: without one, functions succeed and nothing else happens"
        else:
            help_ = "`swarmc simulate` plays a candidate of `history.jsonl` in the folder of `-o`"
        return StoppedError("no-candidate", help_, reason=reason)
