"""Options of commands that run a model: how long, with which seed, and as a candidate of what."""

from __future__ import annotations

from collections.abc import Callable
from functools import reduce
from pathlib import Path
from typing import Any, TypeVar

import click

from swarmdsl.cli.suggestions import Choice

_Decorated = TypeVar("_Decorated", bound=Callable[..., Any])


def parse_duration(
    _context: click.Context, _param: click.Parameter, text: str | None
) -> int | None:
    """Parse a duration with its unit, to nanoseconds."""
    from swarmdsl.execution.simulate.scenario.durations import duration

    length = duration(text) if text is not None else None
    if text is not None and length is None:
        raise click.BadParameter(f"`{text}` is not a duration like `90s`, `500ms` or `10min`")
    return length


def _until(help_: str) -> Callable[[_Decorated], _Decorated]:
    return click.option("--until", metavar="DURATION", callback=parse_duration, help=help_)


one_seed = click.option(
    "--seed", type=int, help="Seed of random decisions.  [default: the scenario's, or 0]"
)
until_after_events = _until(
    "End after this virtual time.  [default: the scenario's, or 10min after the last of `--events`]"
)

_CANDIDATES = (
    click.option("--swarm", metavar="NAME", help="Run candidates of this swarm."),
    click.option(
        "--scenario",
        "scenarios",
        type=click.Path(path_type=Path),
        metavar="FILE",
        multiple=True,
        help="Environment of the runs, as TOML; may be repeated.",
    ),
    click.option(
        "--together",
        type=Choice(("mean", "worst")),
        default="mean",
        show_default=True,
        help="Value of several scenarios: their mean, or the worst of them.",
    ),
    click.option(
        "--subject-to",
        "properties",
        metavar="NAME",
        multiple=True,
        help="A property that no run of a candidate may violate, beside those of `optimize`; may "
        "be repeated.",
    ),
    _until("End each run after this virtual time.  [default: the scenario's, or 10min]"),
    click.option(
        "--world",
        type=Choice(("abstract", "flat", "physics")),
        help="Space of the runs, as for `swarmc simulate`.",
    ),
)


def candidates(function: _Decorated) -> _Decorated:
    """Add the options for what candidates run in, and what makes them impossible."""
    return reduce(lambda inner, add: add(inner), reversed(_CANDIDATES), function)


def check_scenarios(scenarios: tuple[Path, ...]) -> None:
    """Raise UsageError for a scenario that is given twice."""
    if len(set(scenarios)) != len(scenarios):
        raise click.UsageError("a `--scenario` is given twice")
