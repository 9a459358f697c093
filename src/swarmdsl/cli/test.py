"""`swarmc test`."""

from __future__ import annotations

import sys
from pathlib import Path
from typing import TYPE_CHECKING

import click

from swarmdsl.cli import options
from swarmdsl.cli.exit_code import ERRORS, OK

if TYPE_CHECKING:
    from swarmdsl.execution.testing.selection import Selection
    from swarmdsl.execution.testing.verdict import Verdict


@click.command(epilog="Example: swarmc test examples/search_and_rescue -k abort --trace")
@click.argument(
    "arguments",
    metavar="[FILE|FOLDER|FILE::TEST]...",
    nargs=-1,
    type=options.TEXT_PLACE,
)
@click.option(
    "-k",
    "pattern",
    metavar="TEXT",
    help="Run only tests with this text in their name or file name.",
)
@click.option(
    "--seed",
    type=int,
    metavar="N",
    help="Run each test with this seed only, to reproduce a failure.",
)
@click.option(
    "--list", "lists", is_flag=True, help="List the tests, and run none; `--format json` too."
)
@click.option("--trace", is_flag=True, help="Show the traces of the tests.")
@click.option("--coverage", is_flag=True, help="Show states and transitions that are not covered.")
@click.option(
    "--fail-under",
    type=options.Number(0, 100),
    metavar="PERCENT",
    help="Fail if the coverage of states and transitions is lower.",
)
@click.option(
    "--play",
    type=click.Path(path_type=Path),
    metavar="FILE",
    help="Write a page that plays the first test that fails, or the only one, as HTML.",
)
@click.option(
    "--junit",
    type=click.Path(path_type=Path),
    metavar="FILE",
    help="Write the results as JUnit XML, for CI.",
)
@click.option(
    "--results",
    type=click.Path(path_type=Path),
    metavar="FILE",
    help="Write results as JSON lines while tests run; `-` is the standard output.",
)
@options.diagnostics_format
@options.debug
def test(
    arguments: tuple[str, ...],
    pattern: str | None,
    seed: int | None,
    lists: bool,
    trace: bool,
    coverage: bool,
    fail_under: float | None,
    play: Path | None,
    junit: Path | None,
    results: Path | None,
    format_: str,
) -> int:
    """Run behaviour tests of models.

    Tests are in files NAME.swarmtest.toml. A FOLDER means all of these below it; without
    arguments, those below the current folder. FILE::TEST is a single test, as `--list` shows it.
    """
    from swarmdsl.execution.testing import command
    from swarmdsl.execution.testing.selection import read_selection

    selection = read_selection(arguments)
    if lists:
        for name, out in {"--play": play, "--junit": junit, "--results": results}.items():
            if out is not None:
                raise click.UsageError(f"`--list` and `{name}` conflict")
        return _list(selection, pattern, format_)
    is_file = results is not None and results != command.STDOUT
    outputs = {"--play": play, "--junit": junit, "--results": results if is_file else None}
    options.check_outputs(outputs, (*selection.whole, *selection.named))
    shown: list[Verdict] = []
    request = command.Request(
        selection.whole,
        selection.named,
        pattern,
        seed,
        junit,
        results,
        trace,
        coverage,
        fail_under,
        format_,
        shown.append if play is not None else None,
    )
    passed = command.run(request, sys.stdout, sys.stderr)
    if play is not None and shown:
        from swarmdsl.cli.play_pages import play_verdict

        play_verdict(shown[0], play)
    return OK if passed else ERRORS


def _list(selection: Selection, pattern: str | None, format_: str) -> int:
    from swarmdsl.execution.testing.listing import list_tests

    return OK if list_tests(selection, pattern, format_, sys.stdout, sys.stderr) else ERRORS
