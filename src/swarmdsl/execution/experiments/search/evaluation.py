"""Value of a candidate, from rows: one number a seed, and why it is out."""

from __future__ import annotations

import math
from collections.abc import Iterable, Sequence
from typing import Any, Literal

from swarmdsl.base.diagnostics.render import counted
from swarmdsl.base.records import dataclass, field
from swarmdsl.execution.experiments.measured import FITNESS, value_of
from swarmdsl.execution.experiments.search.domination import Losses, in_order
from swarmdsl.execution.experiments.task import Candidate, Row

Goal = Literal["maximize", "minimize"]
Together = Literal["mean", "worst"]


@dataclass(frozen=True)
class Objective:
    """Measure to maximize or to minimize. A property is 1 in a run where it is true, else 0."""

    measure: str
    goal: Goal
    is_property: bool = False

    def loss(self, value: float) -> float:
        """Return a number that is less for a better value."""
        return -value if self.goal == "maximize" else value


@dataclass(frozen=True)
class Aim:
    """Goal of a search, the value of several scenarios together, and properties to keep.

    `others` are further objectives, beside the goal for `measure`. `is_property` says so of that.
    """

    goal: Goal
    together: Together = "mean"
    properties: tuple[str, ...] = ()
    measure: str = FITNESS
    others: tuple[Objective, ...] = ()
    is_property: bool = False

    @property
    def objectives(self) -> tuple[Objective, ...]:
        """All objectives, at least one."""
        return (Objective(self.measure, self.goal, self.is_property), *self.others)

    def loss(self, value: float) -> float:
        """Return a number that is less for a better value of the first objective."""
        return self.objectives[0].loss(value)

    def losses(self, found: Evaluation) -> Losses:
        """Return the losses of a possible candidate."""
        pairs = zip(self.objectives, found.means or (), strict=True)
        return tuple(each.loss(mean) for each, mean in pairs)


@dataclass(eq=False)
class Evaluation:
    """Values of a candidate by seed, one for each objective.

    `broken` says in how many runs what made it impossible.
    """

    candidate: Candidate
    by_seed: dict[int, tuple[float, ...]] = field(default_factory=dict)
    broken: dict[str, int] = field(default_factory=dict)
    runs: int = 0

    def of_objective(self, objective: int) -> dict[int, float]:
        """Return the values of an objective, by seed."""
        return {seed: values[objective] for seed, values in self.by_seed.items()}

    @property
    def values(self) -> dict[int, float]:
        """Values of the first objective, by seed."""
        return self.of_objective(0)

    @property
    def means(self) -> tuple[float, ...] | None:
        """Mean of each objective; None if it is out."""
        if self.broken or not self.by_seed:
            return None
        columns = zip(*self.by_seed.values(), strict=True)
        return tuple(math.fsum(column) / len(self.by_seed) for column in columns)

    @property
    def mean(self) -> float | None:
        """Mean of the first objective; None if it is out."""
        if self.broken or not self.by_seed:
            return None
        return math.fsum(first for first, *_ in self.by_seed.values()) / len(self.by_seed)

    @property
    def fault(self) -> str:
        """Most frequent fault, empty if there is none."""
        return max(self.broken, key=lambda each: (self.broken[each], each), default="")

    @property
    def reason(self) -> str:
        """Say why it is out, empty if it is not."""
        if not self.broken:
            return ""
        return f"{self.fault} in {self.broken[self.fault]} of {counted(self.runs, 'run')}"

    def add(self, rows: Sequence[Sequence[Row]], aim: Aim) -> None:
        """Add rows of the same seeds in each scenario."""
        for same in zip(*rows, strict=True):
            self.runs += len(same)
            faults = [fault for row in same if (fault := _fault(row, aim))]
            for fault in faults:
                self.broken[fault] = self.broken.get(fault, 0) + 1
            if not faults:
                self.by_seed[same[0].seed] = tuple(
                    _together([value_of(row, each.measure) for row in same], each, aim.together)
                    for each in aim.objectives
                )

    def as_data(self, aim: Aim) -> dict[str, Any]:
        """Return JSON types."""
        found: dict[str, Any] = {"candidate": self.candidate.values, "runs": self.runs}
        if aim.others:
            means = self.means
            names = [each.measure for each in aim.objectives]
            found["values"] = dict(zip(names, means, strict=True)) if means is not None else None
        else:
            found["value"] = self.mean
        if self.broken:
            found["out"] = self.reason
        return found


def _fault(row: Row, aim: Aim) -> str:
    """Return why a run makes its candidate impossible."""
    if row.failure is not None:
        return row.failure
    broken = next((each for each in aim.properties if row.verdicts[each] == "false"), None)
    if broken is not None:
        return violation(broken)
    names = (each.measure for each in aim.objectives)
    unknown = next((name for name in names if value_of(row, name) is None), None)
    return f"`{unknown}` has no value" if unknown is not None else ""


def violation(name: str) -> str:
    """Return the fault of a run that violates a property."""
    return f"`{name}` is violated"


def _together(values: Iterable[float | None], objective: Objective, how: Together) -> float:
    known = [each for each in values if each is not None]
    if how == "mean":
        return math.fsum(known) / len(known)
    return max(known, key=objective.loss)


def losses(found: Sequence[Evaluation], aim: Aim, worst: Losses) -> list[Losses]:
    """Return the losses of a generation; of impossible ones, that with fewer faults is better.

    They are worse than all that is possible, whose losses were `worst` at most.
    """
    columns = [
        _losses(found, number, each, worst[number]) for number, each in enumerate(aim.objectives)
    ]
    return list(zip(*columns, strict=True))


def _losses(
    found: Sequence[Evaluation], number: int, objective: Objective, worst: float
) -> list[float]:
    means = [each.means for each in found]
    known = [objective.loss(each[number]) for each in means if each is not None]
    above = max([worst, *known]) if known or math.isfinite(worst) else 0.0
    width = max(abs(above), 1.0)
    return [
        objective.loss(mean[number])
        if mean is not None
        else above + width * (1 + sum(each.broken.values()) / max(each.runs, 1))
        for each, mean in zip(found, means, strict=True)
    ]


def ranked(found: Iterable[Evaluation], aim: Aim) -> list[Evaluation]:
    """Return the possible ones, the best first; of equal ones, the one that was tried first."""
    possible = [each for each in found if each.means is not None]
    if aim.others:
        return [possible[number] for number in in_order([aim.losses(each) for each in possible])]
    return sorted(possible, key=lambda each: aim.loss(each.mean or 0.0))


def values_of(a: Evaluation, b: Evaluation) -> tuple[list[float], list[float]]:
    """Return the values of the first objective with the seeds that both have."""
    common = sorted(a.by_seed.keys() & b.by_seed.keys())
    return [a.by_seed[seed][0] for seed in common], [b.by_seed[seed][0] for seed in common]
