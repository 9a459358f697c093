"""Sections of a report about a search: where it went, and what it found beside today's model."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass

from swarmdsl.execution.experiments.measured import summary_of
from swarmdsl.execution.experiments.report.canvas import short
from swarmdsl.execution.experiments.report.charts import convergence, distributions
from swarmdsl.execution.experiments.report.coordinates import Scored, caption_of, draw_candidates
from swarmdsl.execution.experiments.report.page import Figure, Section, Table, text_table

_FEWEST = 2
FRESH = "The winner on fresh seeds"
"""Title of the section about the winner."""


@dataclass(frozen=True)
class Worst:
    """Run that is worth a look: what is bad in it, its value, and the command that plays it."""

    why: str
    seed: int
    value: float | None
    command: str


@dataclass(frozen=True)
class Search:
    """A search: candidates in the order of its history, and runs of the winner on fresh seeds.

    `today` has the runs of the model as it is, with the same seeds; it may be empty. With
    `is_property`, values are those of a property.
    """

    name: str
    goal: str
    candidates: Sequence[Scored]
    winner: Sequence[float]
    today: Sequence[float]
    level: float
    worst: Sequence[Worst] = ()
    is_property: bool = False


def search_sections(search: Search) -> Iterator[Section]:
    """Yield the sections of a search; those with nothing to show are left out."""
    values = [each.value for each in search.candidates]
    if sum(value is not None for value in values) >= _FEWEST:
        curve = convergence(values, search.goal, search.name)
        caption = "Each dot is a candidate; the line is the best so far."
        yield Section("Convergence", [Figure(curve, caption)])
    drawn = draw_candidates(search.candidates, search.goal, search.name)
    if drawn is not None:
        caption = caption_of(search.candidates, "candidate")
        yield Section("Candidates", [Figure(drawn, caption)])
    groups = [("the winner", search.winner), ("the model as it is", search.today)]
    groups = [(name, values) for name, values in groups if values]
    if groups:
        yield Section(
            FRESH,
            [_summary(groups, search), _distribution(groups, search.name)],
        )
    if search.worst:
        yield worst_runs(search.worst)


def worst_runs(runs: Sequence[Worst]) -> Section:
    """Return the section with runs that are worth a look, each with its command."""
    rows = [
        (each.why, str(each.seed), "" if each.value is None else short(each.value), each.command)
        for each in runs
    ]
    table = Table(("run", "seed", "value", "play it"), rows, frozenset((1, 2)), frozenset((3,)))
    return Section("Runs worth a look", [table])


def _summary(groups: Sequence[tuple[str, Sequence[float]]], search: Search) -> Table:
    rows = []
    for name, values in groups:
        sample = summary_of(values, search.level, is_property=search.is_property)
        assert sample is not None
        least, low, _, median, _, high, greatest = map(short, sample.quantiles)
        between = ""
        if sample.interval is not None:
            between = f"{short(sample.interval.lower)} .. {short(sample.interval.upper)}"
        head = (name, str(sample.count), short(sample.mean), between)
        rows.append((*head, least, low, median, high, greatest))
    head = ("", "runs", "mean", f"interval of {100 * search.level:g} %")
    return text_table((*head, "least", "5 %", "median", "95 %", "greatest"), rows)


def _distribution(groups: Sequence[tuple[str, Sequence[float]]], name: str) -> Figure:
    return Figure(distributions(groups, name), f"{name} in single runs; dashed lines are means.")
