"""Race of candidates."""

from __future__ import annotations

import math
from typing import Any

from swarmdsl.execution.experiments.search.evaluation import Aim, Evaluation
from swarmdsl.execution.experiments.search.race import race, rounds_of
from swarmdsl.execution.experiments.task import Candidate, Row


def test_a_race_keeps_the_best_on_the_same_chance() -> None:
    """Candidates differ by 0.1, chance by 3 between seeds: only pairs can tell."""
    found = [Evaluation(Candidate.of({"x": x})) for x in range(8)]
    aim = Aim("maximize")

    def add(running: Any, seeds: range) -> None:
        for each in running:
            (x,) = each.candidate.values.values()
            rows = [
                Row(
                    each.candidate,
                    "",
                    seed,
                    {},
                    -0.1 * abs(x - 5) + 3 * math.sin(9.7 * seed) + 0.01 * math.sin(seed * (x + 2)),
                    {},
                )
                for seed in seeds
            ]
            each.add([rows], aim)

    rounds = list(race(found, add, aim, rounds_of(0, 40), 0.05))

    assert [each.candidate.values for each in rounds[-1].survivors] == [{"x": 5}]
    assert len(rounds) <= 2
    assert rounds_of(3, 12) == [range(3, 8), range(8, 13), range(13, 15)]
