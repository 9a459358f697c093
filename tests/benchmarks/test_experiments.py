"""The benchmark of searches runs what it measures."""

from __future__ import annotations

import shutil
from pathlib import Path

import pytest

BENCHMARKS = Path(__file__).resolve().parents[2] / "benchmarks"


def test_the_candidates_of_the_benchmark_run(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.syspath_prepend(BENCHMARKS)
    import experiments
    from swarmdsl.base.diagnostics.collector import Diagnostics
    from swarmdsl.driver import pipeline
    from swarmdsl.execution.experiments.engines import local

    monkeypatch.setattr(experiments, "SEEDS", 1)
    shipment = experiments._shipment()
    tasks = experiments._tasks(shipment, experiments.CANDIDATES)
    assert len({task.candidate for task in tasks}) == experiments.CANDIDATES
    # It fails where a candidate has no result.
    spent = experiments._spent(shipment, [*tasks[:4], tasks[-1]], lambda: local(1))

    assert 0 < spent.runs <= spent.wall
    shutil.copytree(experiments.MISSION, tmp_path / "model")
    with (tmp_path / "model" / "sar.swarm").open("a") as file:
        file.write(experiments.OPTIMIZE)
    report = Diagnostics()
    report.include(pipeline.check([tmp_path / "model"]).report)
    assert not report.has_errors
