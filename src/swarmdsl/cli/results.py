"""`swarmc results`."""

from __future__ import annotations

import sys
from io import StringIO
from pathlib import Path
from typing import TYPE_CHECKING, Literal

import click

from swarmdsl.base.diagnostics.render import DOCUMENTS, render
from swarmdsl.cli import options
from swarmdsl.cli.exit_code import ERRORS, OK
from swarmdsl.cli.suggestions import Choice

if TYPE_CHECKING:
    from swarmdsl.base.diagnostics.collector import Diagnostic
    from swarmdsl.execution.experiments.results.conditions import Condition


def _conditions(
    _context: click.Context, _param: click.Parameter, texts: tuple[str, ...]
) -> tuple[Condition, ...]:
    """Parse conditions."""
    from swarmdsl.execution.experiments.results.conditions import read_condition

    found = []
    for text in texts:
        condition = read_condition(text)
        if condition is None:
            raise click.BadParameter(
                f"`{text}` is no condition like `count of robot >= 4` or `Safe = false`"
            )
        found.append(condition)
    return tuple(found)


@click.command(
    epilog='Example: swarmc results resilience-results --where "scenario network.loss > 0"'
)
@click.argument("folder", metavar="FOLDER", type=options.PLACE)
@click.option(
    "--where",
    "conditions",
    metavar="CONDITION",
    multiple=True,
    callback=_conditions,
    help="Leave out runs for which this does not hold: a setting, a measure, a property, `seed`, "
    "`model`, `scenario` or `failure`, with `=`, `!=`, `<`, `<=`, `>` or `>=`; may be repeated.",
)
@click.option(
    "--measure",
    metavar="NAME",
    help="Show this measure or property.  [default: that of the experiment]",
)
@click.option("--runs", is_flag=True, help="List single runs.")
@click.option(
    "--compare",
    "pair",
    nargs=2,
    type=int,
    metavar="A B",
    help="Compare two groups by their numbers in the list: is A better than B?",
)
@click.option(
    "--goal",
    type=Choice(("maximize", "minimize")),
    help="What is better.  [default: as in the experiment]",
)
@click.option(
    "--confidence",
    type=options.Number(0, 1, min_open=True, max_open=True),
    default=0.95,
    show_default=True,
    help="Level of intervals.",
)
@click.option(
    "--export",
    metavar="FILE",
    type=click.Path(path_type=Path),
    help="Write the runs with all that is known of each, as CSV or as Parquet by the name of the "
    "file: `.csv`, `.parquet`.",
)
@click.option("--json", "is_json", is_flag=True, help="Print the results as JSON.")
@options.diagnostics_format
@options.debug
def results(
    folder: Path,
    conditions: tuple[Condition, ...],
    measure: str | None,
    runs: bool,
    pair: tuple[int, int] | None,
    goal: Literal["maximize", "minimize"] | None,
    confidence: float,
    export: Path | None,
    is_json: bool,
    format_: str,
) -> int:
    """List, filter, compare and export the runs of an experiment or a search.

    FOLDER is that of the results. Runs with the same model, scenario and settings are a group. The
    folder can be read while runs go on.
    """
    from swarmdsl.execution.experiments.results.command import Request, show_results

    if pair is not None and runs:
        raise click.UsageError("`--compare` and `--runs` conflict")
    if export is not None:
        if pair is not None or runs or is_json:
            raise click.UsageError("`--export` writes runs: leave the other outputs out")
        if export.suffix.lower() not in (".csv", ".parquet"):
            raise click.BadParameter(
                f"`{export}` does not end with `.csv` or `.parquet`", param_hint="'--export'"
            )
        options.check_outputs({"--export": export}, ())
    request = Request(folder, conditions, measure, pair, goal, confidence, runs, export, is_json)
    is_document = format_ in DOCUMENTS
    if is_document and is_json:
        raise click.UsageError(f"`--format {format_}` and `--json` both print")
    found: list[Diagnostic] = []
    succeeded = show_results(
        request,
        # What is found has one document on standard output.
        StringIO() if is_document else sys.stdout,
        found.extend if is_document else lambda each: render(each, format_, sys.stderr),
    )
    if is_document:
        render(found, format_, sys.stdout)
    return OK if succeeded else ERRORS
