"""Analysis of the runs of a study: means of points, effects, comparisons, sensitivity."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace
from itertools import combinations

from swarmdsl.execution.estimation.sample import Sample
from swarmdsl.execution.experiments.comparing import Comparison, Goal, compare, together
from swarmdsl.execution.experiments.designs.factors import Point, Value
from swarmdsl.execution.experiments.designs.indices import Index, sobol_indices
from swarmdsl.execution.experiments.designs.morris import Screened, screen
from swarmdsl.execution.experiments.effects import Effects, Table, effects
from swarmdsl.execution.experiments.measured import FITNESS, summary_of, value_of
from swarmdsl.execution.experiments.slopes import Slopes, slopes
from swarmdsl.execution.experiments.study.plan import Study
from swarmdsl.execution.experiments.task import Row, Task
from swarmdsl.execution.monitor import FALSE

MOST_COMPARED = 3
"""Number of points that are compared with the best one."""
_FEWEST = 2


@dataclass(frozen=True)
class Result:
    """Runs of a point: their rows, and the values of what is measured, by seed."""

    point: Point
    task: Task
    rows: Sequence[Row]
    values: Mapping[int, float]
    sample: Sample | None

    @property
    def failures(self) -> list[Row]:
        """Runs without a value."""
        return [row for row in self.rows if row.seed not in self.values]

    @property
    def violations(self) -> dict[str, list[int]]:
        """Seeds of the runs that violate a property, by its name."""
        found: dict[str, list[int]] = {}
        for row in self.rows:
            for name, verdict in row.verdicts.items():
                if verdict == FALSE:
                    found.setdefault(name, []).append(row.seed)
        return found


@dataclass(frozen=True)
class Answer:
    """Answer to "A is better than B", about two levels of a factor or two points."""

    a: str
    b: str
    factor: str
    comparison: Comparison


@dataclass(frozen=True)
class Analysis:
    """Everything that follows from the runs of a study.

    `results` are in the order of the design, each point once; `best` is one of them, `today` the
    model as it is. What a design does not tell is None or empty.
    """

    study: Study
    measure: str
    goal: Goal
    results: Sequence[Result]
    best: Result | None
    today: Result | None
    levels: Sequence[Answer] = ()
    points: Sequence[Answer] = ()
    effects: Effects | None = None
    slopes: Slopes | None = None
    screened: Sequence[Screened] = ()
    indices: Sequence[Index] = field(default=())


def result_of(point: Point, task: Task, rows: Sequence[Row], measure: str, level: float) -> Result:
    """Return the result of a point from its rows."""
    read = {row.seed: value_of(row, measure) for row in rows}
    values = {
        seed: value for seed, value in read.items() if value is not None and math.isfinite(value)
    }
    is_property = any(measure in row.verdicts and measure not in row.measures for row in rows)
    sample = summary_of(list(values.values()), level, is_property=is_property)
    return Result(point, task, rows, values, sample)


def analyse(study: Study, goal: Goal, results: Sequence[Result], today: Result | None) -> Analysis:
    """Return what follows from the results of all points of the design."""
    measure = study.measure or FITNESS
    choose = max if goal == "maximize" else min
    valued = [each for each in results if each.sample is not None]
    # The mean of the runs that are left is no mean of all.
    complete = [each for each in valued if not each.failures]
    best = choose(complete or valued, key=_mean) if valued else None
    found = Analysis(study, measure, goal, results, best, today)
    table = {each.point: each.values for each in results}
    factors, level = study.plain_factors, study.confidence
    match study.design:
        case "full":
            return replace(
                found,
                levels=list(_level_answers(study, goal, table)),
                points=list(_point_answers(found)),
                effects=effects(factors, table, level),
            )
        case "latin" | "sobol":
            return replace(
                found,
                points=list(_point_answers(found)),
                slopes=slopes(factors, table, level),
            )
    means = {each.point: _mean(each) for each in valued}
    values = [means.get(point, math.nan) for point in study.design_points()]
    if any(map(math.isnan, values)):
        return found  # a point without a value leaves a gap in all of them
    if study.design == "morris":
        return replace(found, screened=screen(study.shares, values))
    indices = sobol_indices(len(factors), values, level, study.seed)
    return replace(found, indices=indices or [])


def _mean(result: Result) -> float:
    assert result.sample is not None
    return result.sample.mean


def point_text(study: Study, point: Point) -> str:
    """Return the settings of a point for people, without those that all points have."""
    pairs = list(zip(study.factors, point, strict=True))
    varied = [(each, value) for each, value in pairs if len(each.factor.levels) != 1]
    return ", ".join(f"{each.name} {each.text(value)}" for each, value in varied or pairs)


def _point_answers(found: Analysis) -> Iterator[Answer]:
    """Compare the best point with the model as it is and with the next ones.

    The best is chosen by the same runs, so that intervals hold together for all pairs of points.
    """
    best, study = found.best, found.study
    if best is None:
        return
    sign = -1 if found.goal == "maximize" else 1
    others = [each for each in found.results if each is not best and each.sample is not None]
    others.sort(key=lambda each: (bool(each.failures), sign * _mean(each)))
    count = len(others) + 1
    today = [found.today] if found.today is not None and found.today.values else []
    pairs = math.comb(count + len(today), 2)
    level = together(study.confidence, pairs)
    text = point_text(study, best.point)
    for each in (*today, *others[:MOST_COMPARED]):
        name = "the model as it is" if each is found.today else point_text(study, each.point)
        answer = compare(best.values, each.values, found.goal, level)
        if answer is not None:
            yield Answer(text, name, "", answer)


def _level_answers(study: Study, goal: Goal, table: Table) -> Iterator[Answer]:
    """Compare the best level of each factor with the others, in the mean of all other factors."""
    choose: Callable[..., Value] = max if goal == "maximize" else min
    for number, varied in enumerate(study.factors):
        means = {level: _level_means(table, number, level) for level in varied.factor.levels}
        means = {level: values for level, values in means.items() if values}
        if len(means) < _FEWEST:
            continue
        pairs = len(list(combinations(means, 2)))
        common = set.intersection(*(set(values) for values in means.values()))
        if not common:
            continue
        best = choose(
            means, key=lambda level: math.fsum(means[level][seed] for seed in sorted(common))
        )
        for level, values in means.items():
            answer = compare(means[best], values, goal, together(study.confidence, pairs))
            if level != best and answer is not None:
                yield Answer(varied.text(best), varied.text(level), varied.name, answer)


def _level_means(table: Table, number: int, level: Value) -> dict[int, float]:
    """Return the mean of all points with a level, for each seed that all of them have."""
    columns = [values for point, values in table.items() if point[number] == level]
    common = set.intersection(*(set(values) for values in columns)) if columns else set()
    return {
        seed: math.fsum(values[seed] for values in columns) / len(columns)
        for seed in sorted(common)
    }
