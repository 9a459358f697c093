"""Verdicts on random swarms are those of all runs on the engine."""

from __future__ import annotations

from collections import Counter
from pathlib import Path

import pytest

from swarmdsl.execution.verify.model import Options

from .conftest import model_of, system_of, verdicts_of
from .random_swarms import random_swarm
from .slow import refuted

MOST = 45
"""Number of states up to which the slow explorer plays all runs from their beginning."""
# Seeds of swarms that have no more states.
FEW = (0, 2, 6, 17, 19, 20, 22, 23, 26, 27, 29, 30, 33, 34, 38, 42, 46, 48, 52, 54, 56, 62)


def compare(seed: int, path: Path) -> Counter[str]:
    """Compare the verdicts on a random swarm; return how many of each kind there are."""
    path.write_text(random_swarm(seed), encoding="utf-8")
    lossy = seed % 3 == 0
    model = model_of(path, None, Options(1, lossy))
    wanted = refuted(system_of(path), list(model.outside), 1, MOST, lossy=lossy)
    found: Counter[str] = Counter()
    if wanted is None:
        return found
    for name, verdict in verdicts_of(model, 5_000).items():
        found[verdict.outcome] += 1
        match verdict.outcome:
            case "holds":
                assert name not in wanted, verdict
            case "fails":
                # Robots that cannot go on violate it, though others act without end.
                owed = verdict.property.kind in ("eventually", "leads", "then")
                assert name in wanted or owed, verdict
            case "unknown" if "counts" not in verdict.reason:
                # Some run violates it, but for times or an order of messages that cannot be.
                assert (name in wanted) == ("cannot be" in verdict.reason), verdict
    return found


def test_verdicts_are_those_of_all_runs(tmp_path: Path) -> None:
    found: Counter[str] = Counter()
    for seed in FEW:
        found += compare(seed, tmp_path / "random.swarm")

    assert min(found["holds"], found["fails"]) > 20
    assert found.total() == 6 * len(FEW)


@pytest.mark.long
@pytest.mark.timeout(3000)
@pytest.mark.parametrize("start", range(100, 300, 100))
def test_verdicts_on_many_swarms_are_those_of_all_runs(start: int, tmp_path: Path) -> None:
    found: Counter[str] = Counter()
    for seed in range(start, start + 100):
        found += compare(seed, tmp_path / "random.swarm")

    assert min(found["holds"], found["fails"]) > 20
