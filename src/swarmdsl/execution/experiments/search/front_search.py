"""Search for the front of several objectives: candidates that nothing is better than.

Those that the race leaves are measured with fresh seeds, beside the model as it is.
"""

from __future__ import annotations

from swarmdsl.base.records import dataclass
from swarmdsl.execution.experiments.comparing import Answer
from swarmdsl.execution.experiments.search.domination import fronts
from swarmdsl.execution.experiments.search.evaluation import Evaluation, ranked
from swarmdsl.execution.experiments.search.front import beside, is_certain, undominated
from swarmdsl.execution.experiments.search.optimizing import ON_FRONT, Observed, Search
from swarmdsl.execution.experiments.task import Candidate


@dataclass(frozen=True)
class PointOnFront:
    """A candidate that nothing dominates in the means of fresh seeds.

    It is certain if none of the others with fresh seeds can dominate it, as far as the runs tell.
    `dominates_today` is None if the model as it is, is out.
    """

    evaluation: Evaluation
    is_certain: bool
    dominates_today: Answer | None


@dataclass(frozen=True)
class FoundFront:
    """Result of a search: the front in the order of the first objective, the best first.

    `near` are candidates that are dominated in the means, but not for certain, and `unmeasured` is
    the number of those that the race left, but which were too many for fresh seeds.
    """

    points: tuple[PointOnFront, ...]
    near: tuple[Evaluation, ...]
    today: Evaluation
    finals: tuple[Evaluation, ...]
    tried: int
    observed: tuple[Observed, ...]
    unmeasured: int = 0


class FrontSearch(Search):
    """A search with several objectives."""

    def run_front(self) -> FoundFront:
        """Search; raise StoppedError if no candidate is possible."""
        plan = self._plan
        survivors, left = self.finals()
        today = self._fresh(Candidate(), "today")
        different = ranked(self._distinct(survivors), plan.aim)
        chosen = different[:ON_FRONT]
        measured = [self._fresh(each.candidate, "front") for each in chosen]
        possible = self._distinct([each for each in measured if each.means is not None])
        if not possible:
            raise self._none_possible(measured)
        error = 1 - plan.level
        kept = undominated(possible, plan.aim, error)
        losses = [plan.aim.losses(each) for each in kept]
        first = set(fronts(losses)[0])
        order = sorted(range(len(kept)), key=lambda number: losses[number])
        points = [
            PointOnFront(
                kept[number],
                is_certain(kept[number], possible, plan.aim, error),
                beside(kept[number], today, plan.aim, error) if today.means is not None else None,
            )
            for number in order
            if number in first
        ]
        near = [kept[number] for number in order if number not in first]
        finals = (*survivors, *left)
        return FoundFront(
            tuple(points),
            tuple(near),
            today,
            finals,
            self.tried,
            self.observed,
            len(different) - len(chosen),
        )

    def _distinct(self, found: list[Evaluation]) -> list[Evaluation]:
        """Return one of those with the same runs: that which changes less of the model."""
        space = self._plan.space
        kept: dict[tuple[tuple[float, ...], ...], Evaluation] = {}
        for each in sorted(found, key=lambda each: len(space.changed(each.candidate).settings)):
            kept.setdefault(tuple(each.by_seed[seed] for seed in sorted(each.by_seed)), each)
        return [each for each in found if each in kept.values()]
