"""Tables and sentences of an analysis, for text and for the page."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

from swarmdsl.base.diagnostics.render import counted
from swarmdsl.execution.estimation.intervals import Interval
from swarmdsl.execution.experiments.comparing import Comparison
from swarmdsl.execution.experiments.designs.indices import Index
from swarmdsl.execution.experiments.effects import Effect
from swarmdsl.execution.experiments.measured import FITNESS
from swarmdsl.execution.experiments.study.analysis import (
    Analysis,
    Answer,
    Result,
    point_text,
)
from swarmdsl.execution.experiments.study.plan import DESIGNS

Rows = list[tuple[str, ...]]


@dataclass(frozen=True)
class Grid:
    """A table with a title; `left` is the number of columns of text at its beginning."""

    title: str
    head: tuple[str, ...]
    rows: Rows
    left: int = 1


def conditions(found: Analysis, subject: str) -> list[tuple[str, str]]:
    """Return the conditions of all numbers, each with its name."""
    study = found.study
    last = study.seed + study.repetitions - 1
    runs = sum(len(each.rows) for each in found.results)
    seeds = counted(study.repetitions, "seed")
    what = f"fitness of {subject}" if found.measure == FITNESS else f"{found.measure} of {subject}"
    return [
        ("experiment", str(study.path)),
        ("design", f"{DESIGNS[study.design]}, {counted(len(found.results), 'point')}"),
        ("runs", f"{runs}: {seeds} a point, {study.seed} to {last}, the same for all points"),
        ("measured", f"{what}, to {found.goal}"),
        ("intervals", f"{100 * study.confidence:g} %"),
    ]


def answers(found: Analysis) -> Iterator[str]:
    """Yield what the runs say, as sentences."""
    if found.best is None:
        yield "no run has a value"
        return
    assert found.best.sample is not None
    mean = number(found.best.sample.mean)
    yield f"the best point is {point_text(found.study, found.best.point)}: {mean} in the mean"
    for each in (*found.levels, *found.points):
        yield _sentence(each)
    failed = sum(len(each.failures) for each in found.results)
    if failed:
        yield f"{counted(failed, 'run')} without a value"


def _sentence(answer: Answer) -> str:
    where = f"{answer.factor}: " if answer.factor else ""
    return f"{where}{answer.a} is better than {answer.b}: {verdict(answer.comparison)}"


def verdict(found: Comparison) -> str:
    """Return the answer of a comparison with its numbers."""
    if found.difference == 0 and found.deviation == 0:
        return f"{found.answer} (no difference in {counted(found.runs, 'pair')})"
    between = interval(found.interval)
    runs = counted(found.runs, "pair" if found.is_paired else "run")
    parts = [f"difference {number(found.difference)}"]
    if between:
        parts.append(f"{between} at {100 * found.level:.4g} %")
    if found.size is not None:
        parts.append(f"effect size {found.size:.2f}")
    parts.append(runs)
    if found.more is not None:
        parts.append(f"about {found.more} more would tell if it stays like this")
    return f"{found.answer} ({', '.join(parts)})"


def grids(found: Analysis) -> Iterator[Grid]:
    """Yield the tables of an analysis."""
    yield _points(found)
    if found.effects is not None:
        effects = found.effects
        yield Grid(
            f"Main effects and interactions, from {counted(len(effects.seeds), 'seed')}",
            ("factor", "level", "mean", "adds", "interval", "share", "size", "certain"),
            [
                row
                for each in (*effects.main, *effects.interactions)
                for row in _effect(found, each)
            ],
            2,
        )
    if found.slopes is not None:
        slopes = found.slopes
        share = "" if slopes.explained is None else f", which explain {_percent(slopes.explained)}"
        yield Grid(
            f"Linear effects{share}",
            ("factor", "from", "to", "change", "interval", "certain"),
            [
                (
                    each.factor,
                    *(_level(found, each.factor, value) for value in (each.start, each.end)),
                    number(each.change),
                    interval(each.interval),
                    _certain(each.is_certain),
                )
                for each in slopes.slopes
            ],
        )
    names = [each.name for each in found.study.factors]
    if found.screened:
        pairs = zip(names, found.screened, strict=True)
        yield Grid(
            "Elementary effects (Morris)",
            ("factor", "mean size", "mean", "deviation"),
            [
                (name, number(each.size), number(each.mean), number(each.deviation))
                for name, each in sorted(pairs, key=lambda pair: -pair[1].size)
            ],
        )
    if found.indices:
        yield Grid(
            "Shares of the variance (Sobol indices)",
            ("factor", "alone", "interval", "in all", "interval"),
            [_index(name, each) for name, each in zip(names, found.indices, strict=True)],
        )


def _points(found: Analysis) -> Grid:
    study = found.study
    names = tuple(each.name for each in study.factors)
    violated = any(each.violations for each in found.results)
    head = (*names, "mean", "interval", "median", "runs", *(("violations",) if violated else ()))
    rows = []
    ranked = sorted(found.results, key=lambda each: _rank(found, each))
    for each in ranked:
        texts = (v.text(value) for v, value in zip(study.factors, each.point, strict=True))
        rows.append((*texts, *_summary(each), *(_violations(each) if violated else ())))
    if found.today is not None and found.today.rows:
        first = ("as it is", *("" for _ in names[1:]))
        rows.append(
            (*first, *_summary(found.today), *(_violations(found.today) if violated else ()))
        )
    return Grid("Points, the best first", head, rows, len(names))


def _rank(found: Analysis, result: Result) -> tuple[bool, float]:
    """Return the key of a point: those with failed runs are last."""
    if result.sample is None:
        return True, float("inf")
    mean = result.sample.mean
    return bool(result.failures), -mean if found.goal == "maximize" else mean


def _summary(result: Result) -> tuple[str, ...]:
    sample = result.sample
    if sample is None:
        return "-", "", "", f"0 of {len(result.rows)}"
    runs = (
        str(sample.count)
        if sample.count == len(result.rows)
        else f"{sample.count} of {len(result.rows)}"
    )
    return number(sample.mean), interval(sample.interval), number(sample.quantiles[3]), runs


def _violations(result: Result) -> tuple[str, ...]:
    return (", ".join(f"{name} {len(seeds)}" for name, seeds in result.violations.items()),)


def _effect(found: Analysis, effect: Effect) -> Iterator[tuple[str, ...]]:
    names = " x ".join(effect.factors)
    for at, each in enumerate(effect.levels):
        first = at == 0
        levels = zip(effect.factors, each.levels, strict=True)
        yield (
            names if first else "",
            ", ".join(_level(found, name, value) for name, value in levels),
            number(each.mean),
            number(each.added),
            interval(each.added_interval),
            _percent(effect.share) if first and effect.share is not None else "",
            f"{effect.size:.2f}" if first and effect.size is not None else "",
            _certain(effect.is_certain) if first else "",
        )


def _index(name: str, found: Index) -> tuple[str, ...]:
    return (
        name,
        f"{found.first:.3f}",
        interval(found.first_interval),
        f"{found.total:.3f}",
        interval(found.total_interval),
    )


def _level(found: Analysis, factor: str, value: object) -> str:
    varied = next(each for each in found.study.factors if each.name == factor)
    return varied.text(value) if isinstance(value, (bool, int, float, str)) else str(value)


def number(value: float) -> str:
    """Format a number."""
    return f"{value:.5g}"


def interval(found: Interval | None) -> str:
    """Format an interval; empty without one."""
    return f"{number(found.lower)} .. {number(found.upper)}" if found is not None else ""


def _percent(share: float) -> str:
    return f"{100 * share:.1f} %"


def _certain(is_certain: bool) -> str:
    return "yes" if is_certain else "not yet"
