"""Options of commands that run many candidates: what does the runs, and what is printed."""

from __future__ import annotations

from collections.abc import Callable
from functools import reduce
from pathlib import Path
from typing import Any, TypeVar

import click

from swarmdsl.cli import options

_Decorated = TypeVar("_Decorated", bound=Callable[..., Any])

_PROCESSES = (
    click.option(
        "--jobs",
        type=options.Integer(1, 256),
        metavar="J",
        help="Number of processes.  [default: one for each processor]",
    ),
    click.option(
        "--cluster",
        metavar="ADDRESS",
        help="Run on a Dask cluster, such as `tcp://host:8786`, or on an installed kind of engine.",
    ),
    click.option(
        "--limit",
        type=options.Number(0, 86400, min_open=True),
        metavar="SECONDS",
        help="A run that takes longer has no result.  [default: 60]",
    ),
)
_TOLD = (
    click.option(
        "--feed",
        type=click.Path(path_type=Path),
        metavar="FILE",
        help="Write what happens to a file while it happens, as JSON lines.",
    ),
    click.option("--json", "is_json", is_flag=True, help="Print the result as JSON."),
)


def processes(function: _Decorated) -> _Decorated:
    """Add the options for the processes that do the runs."""
    return reduce(lambda inner, add: add(inner), reversed(_PROCESSES), function)


def engine(function: _Decorated) -> _Decorated:
    """Add the options for the processes that do the runs, and for what is told of them."""
    told = reduce(lambda inner, add: add(inner), reversed(_TOLD), function)
    return processes(told)


def check_processes(jobs: int | None, cluster: str | None) -> None:
    """Raise UsageError for processes in two places."""
    if jobs is not None and cluster is not None:
        raise click.UsageError("`--jobs` and `--cluster` conflict")
