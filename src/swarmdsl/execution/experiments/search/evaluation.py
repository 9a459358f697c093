"""Value of a candidate, from rows: one number a seed, and why it is out."""

from __future__ import annotations

import math
from collections.abc import Iterable, Sequence
from typing import Any, Literal

from swarmdsl.base.diagnostics.render import counted
from swarmdsl.base.records import dataclass, field
from swarmdsl.execution.experiments.task import Candidate, Row

Goal = Literal["maximize", "minimize"]
Together = Literal["mean", "worst"]


@dataclass(frozen=True)
class Aim:
    """Goal of a search, the value of several scenarios together, and properties to keep."""

    goal: Goal
    together: Together = "mean"
    properties: tuple[str, ...] = ()

    def loss(self, value: float) -> float:
        """Return a number that is less for a better value."""
        return -value if self.goal == "maximize" else value


@dataclass(eq=False)
class Evaluation:
    """Values of a candidate by seed. `broken` says in how many runs what made it impossible."""

    candidate: Candidate
    values: dict[int, float] = field(default_factory=dict)
    broken: dict[str, int] = field(default_factory=dict)
    runs: int = 0

    @property
    def mean(self) -> float | None:
        """Mean of the values; None if it is out."""
        if self.broken or not self.values:
            return None
        return math.fsum(self.values.values()) / len(self.values)

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
                self.values[same[0].seed] = _together([row.fitness for row in same], aim)

    def as_data(self) -> dict[str, Any]:
        """Return JSON types."""
        found: dict[str, Any] = {
            "candidate": self.candidate.values,
            "runs": self.runs,
            "value": self.mean,
        }
        if self.broken:
            found["out"] = self.reason
        return found


def _fault(row: Row, aim: Aim) -> str:
    """Return why a run makes its candidate impossible."""
    if row.failure is not None:
        return row.failure
    broken = next((each for each in aim.properties if row.verdicts[each] == "false"), None)
    return violation(broken) if broken is not None else ""


def violation(name: str) -> str:
    """Return the fault of a run that violates a property."""
    return f"`{name}` is violated"


def _together(values: Iterable[float | None], aim: Aim) -> float:
    known = [each for each in values if each is not None]
    if aim.together == "mean":
        return math.fsum(known) / len(known)
    return min(known) if aim.goal == "maximize" else max(known)


def losses(found: Sequence[Evaluation], aim: Aim, worst: float) -> list[float]:
    """Return the losses of a generation; of impossible ones, that with fewer faults is better.

    They are worse than all that is possible, whose loss was `worst` at most.
    """
    known = [aim.loss(each.mean) for each in found if each.mean is not None]
    above = max([worst, *known]) if known or math.isfinite(worst) else 0.0
    width = max(abs(above), 1.0)
    return [
        aim.loss(each.mean)
        if each.mean is not None
        else above + width * (1 + sum(each.broken.values()) / max(each.runs, 1))
        for each in found
    ]


def ranked(found: Iterable[Evaluation], aim: Aim) -> list[Evaluation]:
    """Return the possible ones, the best first; of equal ones, the one that was tried first."""
    possible = [each for each in found if each.mean is not None]
    return sorted(possible, key=lambda each: aim.loss(each.mean or 0.0))


def values_of(a: Evaluation, b: Evaluation) -> tuple[list[float], list[float]]:
    """Return the values of each with the seeds that both have."""
    common = sorted(a.values.keys() & b.values.keys())
    return [a.values[seed] for seed in common], [b.values[seed] for seed in common]
