"""A study as plain data: what is varied, how often it runs, and what is measured."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any, Literal

from swarmdsl.base.source import Span
from swarmdsl.execution.experiments.comparing import Goal
from swarmdsl.execution.experiments.designs.factorial import full_factorial
from swarmdsl.execution.experiments.designs.factors import Factor, Point, Value, settle
from swarmdsl.execution.experiments.designs.indices import saltelli_points
from swarmdsl.execution.experiments.designs.latin import latin_hypercube
from swarmdsl.execution.experiments.designs.morris import trajectories
from swarmdsl.execution.experiments.designs.sobol import sobol_sequence
from swarmdsl.execution.simulate.scenario.durations import SECOND, format_duration, written_duration

Design = Literal["full", "latin", "sobol", "morris", "indices"]
DESIGNS: dict[Design, str] = {
    "full": "full factorial",
    "latin": "Latin hypercube",
    "sobol": "Sobol sequence",
    "morris": "elementary effects of Morris",
    "indices": "Sobol indices",
}
Kind = Literal["setting", "model", "scenario", "faults"]


@dataclass(frozen=True)
class Varied:
    """A factor of a study: values of a setting, or models, scenarios or sets of faults by name.

    Times are in seconds in `factor`. `faults` are those of each level; `places` are the spans of
    the levels in the file.
    """

    factor: Factor
    kind: Kind
    place: Span
    is_time: bool = False
    faults: Mapping[Value, Any] = field(default_factory=dict)
    places: Mapping[Value, Span] = field(default_factory=dict)

    @property
    def name(self) -> str:
        """Name of the setting, or the kind."""
        return self.factor.name

    def setting(self, value: Value) -> Any:
        """Return a value as a scenario has it."""
        if self.kind == "faults":
            return self.faults[value]
        if self.is_time and isinstance(value, (int, float)):
            return written_duration(round(value * SECOND))
        return value

    def text(self, value: Value) -> str:
        """Return a value for people."""
        if self.is_time and isinstance(value, (int, float)):
            text = format_duration(round(value * SECOND))
            return text.removesuffix(" 0 s").removesuffix(" 0 min")
        return f"{value:.6g}" if isinstance(value, float) else str(value)


@dataclass(frozen=True)
class Study:
    """An experiment. `measure` is FITNESS, or the name of a measure or of a property.

    `points` is the number of points of a Latin hypercube or a Sobol sequence, of trajectories of
    Morris, or of rows for Sobol indices. `goal` is None where the fitness has its own.
    """

    path: Path
    factors: tuple[Varied, ...]
    models: tuple[str, ...]
    swarm: str | None = None
    scenario: Path | None = None
    design: Design = "full"
    points: int = 0
    repetitions: int = 10
    seed: int = 1
    until: int | None = None
    world: str | None = None
    measure: str | None = None
    goal: Goal | None = None
    confidence: float = 0.95
    places: Mapping[str, Span] = field(default_factory=dict)

    @property
    def folder(self) -> Path:
        """Folder of the file, from which its paths start."""
        return self.path.parent

    @property
    def plain_factors(self) -> tuple[Factor, ...]:
        """The factors of the design."""
        return tuple(each.factor for each in self.factors)

    @property
    def shares(self) -> list[tuple[float, ...]]:
        """Points in the unit cube in the order of the design, with repetitions; none for full."""
        count = len(self.factors)
        match self.design:
            case "latin":
                return latin_hypercube(count, self.points, self.seed)
            case "sobol":
                return sobol_sequence(count, self.points, self.seed)
            case "morris":
                return trajectories(count, self.points, self.seed)
            case "indices":
                return saltelli_points(count, self.points, self.seed)
        return []

    def design_points(self) -> list[Point]:
        """Return the points in the order of the design; some designs repeat points."""
        factors = self.plain_factors
        if self.design == "full":
            return full_factorial(factors)
        return [settle(factors, shares) for shares in self.shares]
