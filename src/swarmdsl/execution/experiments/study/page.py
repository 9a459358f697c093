"""The page of a study."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from swarmdsl.execution.estimation.intervals import Interval
from swarmdsl.execution.experiments.effects import Effects
from swarmdsl.execution.experiments.report.charts import Mean, distributions, main_effect
from swarmdsl.execution.experiments.report.coordinates import Scored, caption_of, draw_candidates
from swarmdsl.execution.experiments.report.page import Figure, Page, Section, Table
from swarmdsl.execution.experiments.report.search import Worst, worst_runs
from swarmdsl.execution.experiments.study.analysis import Analysis
from swarmdsl.execution.experiments.study.tables import Grid, answers, conditions, grids


def page(found: Analysis, subject: str, worst: Sequence[Worst]) -> Page:
    """Return the page of an analysis."""
    title = f"{found.study.path.stem}: {subject}"
    return Page(
        title, conditions(found, subject), list(answers(found)), list(_sections(found, worst))
    )


def _sections(found: Analysis, worst: Sequence[Worst]) -> Iterator[Section]:
    points, *others = grids(found)
    figures = []
    scored = [
        Scored(
            {v.name: value for v, value in zip(found.study.factors, each.point, strict=True)},
            each.sample.mean if each.sample is not None else None,
            "best" if each is found.best else "",
        )
        for each in found.results
    ]
    drawn = draw_candidates(scored, found.goal, found.measure)
    if drawn is not None:
        figures.append(Figure(drawn, caption_of(scored, "point")))
    yield Section(points.title, [*figures, _table(points)])
    for grid in others:
        charts = list(_main_effects(found, found.effects)) if found.effects is not None else []
        yield Section(grid.title, [*charts, _table(grid)])
    groups = []
    for name, result in (("the best point", found.best), ("the model as it is", found.today)):
        if result is not None and result.values:
            groups.append((name, list(result.values.values())))
    if groups:
        drawing = distributions(groups, found.measure)
        caption = f"{found.measure} in single runs; dashed lines are means."
        yield Section("Single runs", [Figure(drawing, caption)])
    if worst:
        yield worst_runs(worst)


def _main_effects(found: Analysis, effects: Effects) -> Iterator[Figure]:
    """Yield a chart for each factor, all on one scale."""
    bounds = [
        bound
        for effect in effects.main
        for each in effect.levels
        for bound in (*(each.interval or ()), each.mean)
    ]
    span = Interval(min(bounds), max(bounds))
    texts = {each.name: each.text for each in found.study.factors}
    for effect in effects.main:
        (name,) = effect.factors
        means = [
            Mean(texts[name](each.levels[0]), each.mean, each.interval) for each in effect.levels
        ]
        caption = f"Means of {found.measure} over all other factors, with their intervals."
        yield Figure(main_effect(name, means, span), caption)


def _table(grid: Grid) -> Table:
    return Table(grid.head, grid.rows, frozenset(range(grid.left, len(grid.head))))
