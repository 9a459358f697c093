"""Search for the best candidate: from a plan to the winner beside today's model.

1. Where all candidates can be tried, they race. Otherwise a method proposes generations, each
   candidate of which runs with a few seeds, the same for all, and the best of them race with
   others.
2. The winner and today's model run with fresh seeds, of which the search has seen none: the mean
   of the winner is not the one that made it win.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Sequence
from typing import Any

from swarmdsl.base.diagnostics.render import counted
from swarmdsl.base.records import dataclass
from swarmdsl.execution.estimation.sample import Sample
from swarmdsl.execution.experiments.comparing import Comparison, compare_paired
from swarmdsl.execution.experiments.failures import StoppedError
from swarmdsl.execution.experiments.measured import summary_of
from swarmdsl.execution.experiments.running import Runs
from swarmdsl.execution.experiments.search.domination import fronts
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
from swarmdsl.execution.experiments.task import NO_SCENARIO, Candidate, Task, settings_text

SEARCH_SEEDS, FINALISTS, ON_FRONT = 10, 10, 20
"""Seeds of each candidate that a method proposes, and how many of the best race.

With several objectives there are more of the best.
"""
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
            many = "nsga" if self.aim.others else "cma"
            return "all" if is_small(self.space, self.evaluations) else many
        return self.method

    @property
    def finalists(self) -> int:
        """Number of candidates of a method that race, at most."""
        return ON_FRONT if self.aim.others else FINALISTS

    @property
    def fresh_seeds(self) -> range:
        """Seeds that the search does not see."""
        return range(self.seed + _FRESH, self.seed + _FRESH + self.fresh)

    @property
    def expected(self) -> int:
        """Number of runs, at most."""
        fresh = (1 + ON_FRONT if self.aim.others else 2) * self.fresh
        if self.chosen == "all":
            return len(self.scenarios) * ((self.space.size or 0) * self.seeds + fresh)
        few = min(SEARCH_SEEDS, self.seeds)
        finals = min(self.finalists, self.evaluations) * self.seeds
        return len(self.scenarios) * (self.evaluations * few + finals + fresh)


Observed = tuple[Candidate, tuple[float, ...]]
"""A candidate with its mean of each objective."""


@dataclass(frozen=True)
class Found:
    """Result of a search; `winner` and `today` are of fresh seeds.

    `finals` are the evaluations of the race, the best first, `tried` the number of candidates, and
    `observed` what is known of the possible ones with the same few seeds. With `is_property`, the
    objective is a property.
    """

    winner: Evaluation
    today: Evaluation
    comparison: Comparison | None
    finals: tuple[Evaluation, ...]
    tried: int
    observed: tuple[Observed, ...] = ()
    is_property: bool = False

    def sample(self, of: Evaluation, level: float) -> Sample | None:
        """Return the summary of an evaluation."""
        values = list(of.values.values())
        return summary_of(values, level, is_property=self.is_property) if not of.broken else None


Tell = Callable[[dict[str, Any]], None]
"""Takes a line of the history."""


class Search:
    """A search, with what is known of it at any time."""

    def __init__(self, plan: Plan, runs: Runs, digest: str, tell: Tell) -> None:
        self._plan = plan
        self._runs = runs
        self._digest = digest
        self._tell = tell
        self.best: Sequence[Evaluation] = ()
        """Best candidates so far, the first one in front."""
        self.tried = 0
        self.observed: tuple[Observed, ...] = ()

    @property
    def so_far(self) -> str:
        """Say what is best so far, empty if nothing is known."""
        if not self.best:
            return ""
        best, aim = self.best[0], self._plan.aim
        if aim.others:
            losses = [aim.losses(each) for each in self.best if each.means is not None]
            return f"{counted(len(fronts(losses)[0]), 'candidate')} on the front" if losses else ""
        return f"{best.mean:.6g} with {settings_text(best.candidate)}"

    def run(self) -> Found:
        """Search; raise StoppedError if no candidate is possible."""
        survivors, left = self.finals()
        # Of equal ones, the best is that which changes less of the model.
        space, aim = self._plan.space, self._plan.aim

        def order(each: Evaluation) -> tuple[float, int]:
            return aim.loss(each.mean or 0.0), len(space.changed(each.candidate).settings)

        return self._measure([*sorted(survivors, key=order), *left])

    def finals(self) -> tuple[list[Evaluation], list[Evaluation]]:
        """Return the candidates that are left after a race, and those that left it."""
        plan = self._plan
        if plan.chosen == "all":
            points = plan.space.grid(plan.evaluations)
            candidates = list(dict.fromkeys(plan.space.candidate(each) for each in points))
            self.tried = len(candidates)
            first = plan.seed
        else:
            candidates = self._finalists()
            first = plan.seed + min(SEARCH_SEEDS, plan.seeds)
        return self._race([Evaluation(each) for each in candidates], first)

    def _finalists(self) -> list[Candidate]:
        """Return the best candidates that a method has proposed."""
        tried: dict[Candidate, Evaluation] = {}
        seeds = range(self._plan.seed, self._plan.seed + min(SEARCH_SEEDS, self._plan.seeds))
        aim = self._plan.aim
        worst = (float("-inf"),) * len(aim.objectives)
        for number, (points, method) in enumerate(self._generations()):
            found = [Evaluation(self._plan.space.candidate(point)) for point in points]
            self._add(found, seeds)
            for each in found:
                self._say("search", each, generation=number)
                tried.setdefault(each.candidate, each)
            ordered = ranked(tried.values(), aim)
            self._note(ordered)
            values = losses(found, aim, worst)
            if ordered:
                worst = tuple(map(max, zip(*map(aim.losses, ordered), strict=True)))
            method.tell(points, values)
        self._observe(tried.values())
        best = ranked(tried.values(), aim)[: self._plan.finalists]
        if not best:
            raise self._none_possible(list(tried.values()))
        return [each.candidate for each in best]

    def _generations(self) -> Iterator[tuple[list[Point], Any]]:
        plan = self._plan
        name: Any = plan.chosen
        objectives = len(plan.aim.objectives)
        method = method_of(name, plan.space, plan.evaluations, plan.seed, objectives)
        while self.tried < plan.evaluations:
            points = method.ask(plan.evaluations - self.tried)
            if not points:
                return
            self.tried += len(points)
            yield points, method

    def _race(
        self, found: Sequence[Evaluation], first: int
    ) -> tuple[list[Evaluation], list[Evaluation]]:
        """Return those that are left after a race, and those that left it, the last ones first."""
        left: list[Evaluation] = []
        survivors: Sequence[Evaluation] = found
        rounds = rounds_of(first, self._plan.seeds)
        for each in race(found, self._add, self._plan.aim, rounds, _ERROR):
            if not self.observed:
                self._observe(each.ran)
            for evaluation in each.ran:
                is_out = evaluation in each.left
                more = {"left": True} if is_out else {}
                self._say("race", evaluation, round=each.number, **more)
            left = [*ranked(each.left, self._plan.aim), *left]
            survivors = each.survivors
            self._note(survivors)
        if not survivors:
            raise self._none_possible(found)
        return list(survivors), left

    def _observe(self, found: Iterable[Evaluation]) -> None:
        pairs = ((each.candidate, each.means) for each in found)
        self.observed = tuple((each, means) for each, means in pairs if means is not None)

    def _measure(self, finals: Sequence[Evaluation]) -> Found:
        """Measure the winner and today's model; a winner that is not possible is no winner."""
        plan = self._plan
        today = self._fresh(Candidate(), "today")
        for each in finals:
            winner = self._fresh(each.candidate, "winner")
            if winner.mean is not None:
                break
        else:
            raise self._none_possible([winner])
        self.best = [winner]
        comparison = None
        if today.mean is not None:
            left, right = values_of(winner, today)
            comparison = compare_paired(left, right, plan.aim.goal, plan.level)
        ordered = [each for each in finals if each.candidate == winner.candidate]
        ordered += [each for each in finals if each.candidate != winner.candidate]
        return Found(
            winner,
            today,
            comparison,
            tuple(ordered),
            self.tried,
            self.observed,
            plan.aim.is_property,
        )

    def _fresh(self, candidate: Candidate, stage: str) -> Evaluation:
        """Measure a candidate with fresh seeds."""
        found = Evaluation(candidate)
        self._add([found], self._plan.fresh_seeds)
        self._say(stage, found)
        return found

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
        self.best = best or self.best

    def _say(self, stage: str, found: Evaluation, **more: Any) -> None:
        self._tell({"stage": stage, **more, **found.as_data(self._plan.aim)})

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
