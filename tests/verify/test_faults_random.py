"""Verdicts on random swarms that lose robots, or answers, are those of all runs on the engine."""

from __future__ import annotations

from collections import Counter
from collections.abc import Sequence
from pathlib import Path

import pytest

from .conftest import at_least
from .random_swarms import random_swarm
from .test_random import verdicts_as_in_all_runs
from .test_random_duties import compare

MOST = 80
"""Number of states up to which the slow explorer plays all runs from their beginning."""
# Seeds of swarms that have no more states.
FEW = (0, 2, 6, 15, 17, 22, 24, 26, 30, 33, 46, 56, 69, 84)
SILENT = (15, *range(18, 30), 32, 33, 35, 38)


def compared(seed: int, path: Path, most: int) -> Counter[str]:
    """Compare the verdicts on a random swarm, of which one or two robots are lost."""
    text = random_swarm(seed, heartbeat=seed % 4 != 1)
    return verdicts_as_in_all_runs(text, path, lossy=seed % 3 == 0, faults=1 + seed % 2, most=most)


@pytest.mark.timeout(3000)
def test_verdicts_are_those_of_all_runs_with_losses(seeds: Sequence[int], tmp_path: Path) -> None:
    found: Counter[str] = Counter()
    for seed in seeds:
        found += compared(seed, tmp_path / "random.swarm", MOST)

    assert min(found["holds"], found["fails"]) >= at_least(21, seeds)
    assert seeds is not FEW or found.total() == 6 * len(FEW)


@pytest.mark.timeout(3000)
def test_verdicts_are_those_of_all_fair_loops_with_losses_and_silence(
    seeds: Sequence[int], tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    found: Counter[str] = Counter()
    for seed in seeds if seeds is not FEW else SILENT:
        path = tmp_path / "random.swarm"
        found += compare(seed, path, capsys, faults=seed % 3, silent=seed % 2 == 0)

    assert min(found["holds"], found["fails"], found["loop"]) >= at_least(4, seeds)
