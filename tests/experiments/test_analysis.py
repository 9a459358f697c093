"""Analysis of the runs of a study."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

from swarmdsl.base.source import Source, Span
from swarmdsl.execution.experiments.designs.factors import Factor
from swarmdsl.execution.experiments.study.analysis import Result, analyse, result_of
from swarmdsl.execution.experiments.study.plan import Study, Varied
from swarmdsl.execution.experiments.study.tables import grids
from swarmdsl.execution.experiments.task import Candidate, Row, Task


def test_a_point_with_lucky_runs_only_is_not_the_best() -> None:
    place = Span(Source("study.toml", ""), 0, 0)
    factor = Varied(Factor("x", (1, 2)), "setting", place)
    study = Study(Path("study.toml"), (factor,), ("model.swarm",), repetitions=3)

    def point(x: int, values: Sequence[float | None]) -> Result:
        candidate = Candidate.of({"x": x})
        rows = [
            Row(candidate, "", seed, {}, value, failure=None if value is not None else "it fails")
            for seed, value in enumerate(values)
        ]
        return result_of((x,), Task("", "", candidate, (0, 1, 2)), rows, "fitness", 0.95)

    results = [point(1, [9.0, None, None]), point(2, [1.0, 2.0, 3.0])]
    found = analyse(study, "maximize", results, None)
    assert found.best is results[1]
    points = next(grids(found))
    assert [row[0] for row in points.rows] == ["2", "1"]
    results[1] = point(2, [None, None, None])
    assert analyse(study, "maximize", results, None).best is results[0]
