"""Verdicts on what must happen in random swarms are those of all fair loops on the engine."""

from __future__ import annotations

from collections import Counter
from collections.abc import Sequence
from pathlib import Path
from typing import Any

import pytest

from swarmdsl.cli import run
from swarmdsl.execution.verify.robot.environment import Options
from swarmdsl.execution.verify.search.run import written
from swarmdsl.execution.verify.swarm.groups import Group
from swarmdsl.execution.verify.swarm.model import Model

from .conftest import at_least, model_of, system_of, verdicts_of
from .random_duties import random_duties
from .slow import refuted
from .slow_lassos import never_happening

MOST = 60
"""Number of states up to which the slow explorer plays all runs from their beginning."""
# Seeds of swarms that have no more states.
FEW = (*range(8), 11, 13, 15, 17, 18, 19)


def compare(
    seed: int,
    path: Path,
    capsys: pytest.CaptureFixture[str],
    *,
    faults: int = 0,
    silent: bool = False,
    most: int = MOST,
) -> Counter[str]:
    """Compare the verdicts on a random swarm; replay each run that violates a property.

    Return how many there are of each kind, and none if it has too many states.
    """
    found: Counter[str] = Counter()
    path.write_text(random_duties(seed, heartbeat=faults > 0), encoding="utf-8")
    lossy = seed % 3 == 0
    options = Options(1, lossy, faults, ("attempt",) if silent else ())
    model, system = model_of(path, None, options), system_of(path)
    outside = list(model.outside)
    never = never_happening(system, outside, 1, most, lossy=lossy, faults=faults, silent=silent)
    if never is None:
        return found
    never |= refuted(system, outside, 1, most * most, lossy=lossy, faults=faults) or set()
    for name, verdict in verdicts_of(model, 50_000).items():
        found[verdict.outcome] += 1
        # Times or an order of messages may be such that a run cannot be: that is not a proof.
        assert (verdict.outcome != "holds") == (name in never), (seed, verdict)
        if verdict.outcome == "unknown":
            assert "is impossible" in verdict.reason
        if verdict.run is not None:
            trace = path.with_suffix(".jsonl")
            trace.write_text("".join(f"{line}\n" for line in written(verdict.run)))
            run(["simulate", str(path), "--replay", str(trace), "--property", name])
            told = capsys.readouterr().err
            assert "as in the model" in told
            assert f"property `{name}` is violated" in told
            assert "left out" not in told
            found["loop"] += verdict.run.loop not in (None, 0)
    return found


@pytest.mark.timeout(3000)
def test_verdicts_are_those_of_all_fair_loops(
    seeds: Sequence[int], tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    found: Counter[str] = Counter()
    for seed in seeds:
        found += compare(seed, tmp_path / "random.swarm", capsys)

    assert min(found["holds"], found["fails"], found["loop"]) >= at_least(4, seeds)


def test_verdicts_by_numbers_of_robots_are_those_of_each_by_itself(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    def single(self: Model, *arguments: Any, **options: Any) -> list[Group]:
        return groups(self, *arguments, **{**options, "single": True})

    groups, path = Model.groups, tmp_path / "random.swarm"
    verdicts: list[list[str]] = [[], []]
    for is_single in (False, True):
        if is_single:
            monkeypatch.setattr(Model, "groups", single)
        for seed in range(12):
            text = random_duties(seed).replace("A[2]", "A[3]")
            path.write_text(text, encoding="utf-8")
            found = verdicts_of(model_of(path, None, Options(1, seed % 3 == 0)), 50_000)
            verdicts[is_single] += (each.outcome for each in found.values())

    # A run may be found by numbers, and not by robots, that no times fit.
    assert all({*each} != {"holds", "fails"} for each in zip(*verdicts, strict=True))
    assert min(map(verdicts[0].count, ("holds", "fails"))) > 5
