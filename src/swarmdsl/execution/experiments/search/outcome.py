"""Outcome of a search: the winner or the front, in all forms that a user sees."""

from __future__ import annotations

import sys
from collections.abc import Iterator, Sequence
from typing import Any, Protocol

import click

from swarmdsl.base.diagnostics.collector import Diagnostics
from swarmdsl.base.diagnostics.render import counted
from swarmdsl.execution.experiments.report.search import Worst
from swarmdsl.execution.experiments.search.files import files_of, point_files
from swarmdsl.execution.experiments.search.front_report import (
    front_data,
    front_page,
    front_text,
    worst_of_front,
)
from swarmdsl.execution.experiments.search.front_search import FoundFront
from swarmdsl.execution.experiments.search.optimizing import Found
from swarmdsl.execution.experiments.search.page import Chosen, Line, search_page, worst_of_winner
from swarmdsl.execution.experiments.search.problem import Problem
from swarmdsl.execution.experiments.search.report import as_data, as_text
from swarmdsl.execution.experiments.task import Candidate


class Outcome(Protocol):
    """Result of a search."""

    def data(self) -> dict[str, Any]:
        """Return it as JSON types."""

    def lines(self) -> Iterator[str]:
        """Yield the lines of text."""

    def files(self) -> dict[str, str]:
        """Return the files for other programs, by name."""

    def worst(self) -> list[Chosen]:
        """Return the runs that are worth a look."""

    def page(self, history: Sequence[Line], worst: Sequence[Worst]) -> str:
        """Return the page as HTML."""

    def to_apply(self, point: int | None, report: Diagnostics) -> Candidate | None:
        """Return the candidate to write into the model; report why there is none."""


class WinnerOutcome:
    """The winner of a search with one objective."""

    def __init__(self, problem: Problem, found: Found) -> None:
        self._problem = problem
        self._found = found
        self._names = problem.subject.name, problem.objective_name

    def data(self) -> dict[str, Any]:
        """Return it as JSON types."""
        return as_data(self._found, self._problem.plan, *self._names)

    def lines(self) -> Iterator[str]:
        """Yield the lines of text."""
        return as_text(self._found, self._problem.plan, *self._names)

    def files(self) -> dict[str, str]:
        """Return the files for other programs, by name."""
        problem = self._problem
        winner = self._found.winner.candidate
        return dict(files_of(winner, problem.optimization, problem.system))

    def worst(self) -> list[Chosen]:
        """Return the runs that are worth a look."""
        return worst_of_winner(self._found)

    def page(self, history: Sequence[Line], worst: Sequence[Worst]) -> str:
        """Return the page as HTML."""
        return search_page(self._found, self._problem.plan, self._names, history, worst)

    def to_apply(self, _point: int | None, report: Diagnostics) -> Candidate | None:
        """Return the winner, unless it is not better than the model as it is."""
        comparison = self._found.comparison
        if comparison is not None and comparison.answer == "no":
            _report_better(self._problem, report)
            return None
        return self._found.winner.candidate


class FrontOutcome:
    """The front of a search with several objectives."""

    def __init__(self, problem: Problem, found: FoundFront) -> None:
        self._problem = problem
        self._found = found
        self._names = problem.subject.name, problem.fitness.name

    def data(self) -> dict[str, Any]:
        """Return it as JSON types."""
        return front_data(self._found, self._problem.plan, *self._names)

    def lines(self) -> Iterator[str]:
        """Yield the lines of text."""
        return front_text(self._found, self._problem.plan, *self._names)

    def files(self) -> dict[str, str]:
        """Return the files for other programs, by name."""
        candidates = [each.evaluation.candidate for each in self._found.points]
        return dict(point_files(candidates, self._problem.optimization, self._problem.system))

    def worst(self) -> list[Chosen]:
        """Return the runs that are worth a look."""
        return worst_of_front(self._found, self._problem.plan, self._names[1])

    def page(self, _history: Sequence[Line], worst: Sequence[Worst]) -> str:
        """Return the page as HTML."""
        return front_page(self._found, self._problem.plan, self._names, worst)

    def to_apply(self, point: int | None, report: Diagnostics) -> Candidate | None:
        """Return the point that the user chooses; ask for it on a terminal."""
        count = len(self._found.points)
        if point is None and sys.stdin is not None and sys.stdin.isatty():
            point = click.prompt(
                f"point to apply, 1 to {count}", type=click.IntRange(1, count), err=True
            )
        if point is None or point > count:
            fault = "no point is chosen" if point is None else f"there is no point {point}"
            help_ = f"`--point N`, with N from 1 to {count}, chooses one of the table"
            report.report("no-point", fault=fault, count=counted(count, "point"), help=help_)
            return None
        return self._found.points[point - 1].evaluation.candidate


def _report_better(problem: Problem, report: Diagnostics) -> None:
    report.report("not-applied", help="the model is as it was", name=problem.subject.name)
