"""Options of `swarmc simulate` for many runs."""

from __future__ import annotations

import os
from collections.abc import Callable
from functools import reduce
from pathlib import Path
from typing import TYPE_CHECKING, Any, TypeVar

import click
from click.core import ParameterSource

from swarmdsl.cli import options

if TYPE_CHECKING:
    from swarmdsl.execution.simulate.many_runs.many import Many

_Decorated = TypeVar("_Decorated", bound=Callable[..., Any])

_NEED_RUNS = ("jobs", "early", "confidence", "indifference", "error", "histogram")
_ABOUT_ONE_RUN = (
    "replay",
    "trace_file",
    "timeline",
    "map_file",
    "animation",
    "picture",
    "live",
    "real_time",
    "stop_on_violation",
)


def _share(flag: str, limit: float, default: float, help_: str) -> Callable[..., Any]:
    return click.option(
        flag,
        type=options.Number(0, limit, min_open=True, max_open=True),
        default=default,
        show_default=True,
        help=help_,
    )


_OPTIONS = (
    click.option(
        "--runs",
        type=options.Integer(1, 1_000_000),
        metavar="N",
        help="Run so many times, with the seeds from `--seed` on, and print estimates.",
    ),
    click.option(
        "--jobs",
        type=options.Integer(1, 256),
        metavar="J",
        help="Number of processes for `--runs`.  [default: one for each processor]",
    ),
    click.option(
        "--early",
        is_flag=True,
        help="End `--runs` when the tests of all properties with a chance have decided.",
    ),
    _share("--confidence", 1, 0.95, "Level of the intervals of `--runs`."),
    _share(
        "--indifference",
        0.5,
        0.02,
        "Distance from a chance within which either decision of the sequential test is right.",
    ),
    _share(
        "--error",
        0.5,
        0.05,
        "Probability of a wrong decision of the sequential test farther away.",
    ),
    click.option(
        "--histogram",
        type=click.Path(path_type=Path),
        help="Draw the measures of `--runs`, as SVG.",
    ),
)


def many_runs(function: _Decorated) -> _Decorated:
    """Add the options for many runs."""
    return reduce(lambda inner, option: option(inner), reversed(_OPTIONS), function)


def many_of(
    runs: int | None,
    jobs: int | None,
    early: bool,
    confidence: float,
    indifference: float,
    error: float,
    histogram: Path | None,
) -> Many | None:
    """Return what the options request, None for a single run.

    Raises UsageError for an option that needs `--runs`, and one that is about a single run.
    """
    if runs is None:
        for name in filter(_is_given, _NEED_RUNS):
            raise click.UsageError(f"`--{name}` needs `--runs`")
        return None
    for name in filter(_is_given, _ABOUT_ONE_RUN):
        flag = "map" if name == "map_file" else name.replace("_", "-")
        raise click.UsageError(f"`--runs` and `--{flag}` conflict")
    given = click.get_current_context().params
    if given["trace"] not in (None, "none"):
        raise click.UsageError("`--runs` and `--trace` conflict")
    if given["events"] == "-":
        raise click.UsageError("`--runs` and `--events -` conflict")
    if histogram is not None:
        options.check_picture(histogram, "--histogram", ".svg", {})
    from swarmdsl.execution.simulate.many_runs.chances import Level
    from swarmdsl.execution.simulate.many_runs.many import Many

    level = Level(confidence, indifference, error)
    return Many(runs, jobs or os.cpu_count() or 1, level, early, histogram)


def _is_given(name: str) -> bool:
    source = click.get_current_context().get_parameter_source(name)
    return source not in (None, ParameterSource.DEFAULT)
