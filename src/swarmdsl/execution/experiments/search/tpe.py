"""Tree-structured Parzen estimator, by the package `optuna`."""

from __future__ import annotations

import warnings
from collections.abc import Sequence
from typing import Any

import optuna
from optuna.distributions import FloatDistribution, IntDistribution

from swarmdsl.execution.experiments.search.domination import Losses
from swarmdsl.execution.experiments.search.space import Point, SearchSpace

_GENERATION = 8
"""Points of a generation: few, because each one learns from those before."""


class Tpe:
    """A study in memory; the points of a generation know of each other that they are tried."""

    def __init__(self, space: SearchSpace, seed: int, objectives: int = 1) -> None:
        optuna.logging.set_verbosity(optuna.logging.WARNING)
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")  # options of the sampler are called experimental
            sampler = optuna.samplers.TPESampler(seed=seed, multivariate=True, constant_liar=True)
        self._study = optuna.create_study(directions=["minimize"] * objectives, sampler=sampler)
        self._sizes = [each.size for each in space.dimensions]
        self._distributions: dict[str, Any] = {
            f"x{index}": FloatDistribution(0, 1) if size is None else IntDistribution(0, size - 1)
            for index, size in enumerate(self._sizes)
        }
        self._trials: list[Any] = []

    def ask(self, most: int) -> list[Point]:
        """Return a generation."""
        self._trials = [self._study.ask(self._distributions) for _ in range(min(most, _GENERATION))]
        return [self._point(trial.params) for trial in self._trials]

    def tell(self, points: Sequence[Point], losses: Sequence[Losses]) -> None:
        """Add the generation to the study."""
        for trial, loss in zip(self._trials, losses, strict=True):
            self._study.tell(trial, list(loss))

    def _point(self, params: dict[str, Any]) -> Point:
        return tuple(
            float(params[f"x{index}"]) if size is None else params[f"x{index}"] / max(size - 1, 1)
            for index, size in enumerate(self._sizes)
        )
