"""`swarmc test`."""

from __future__ import annotations

import sys
from pathlib import Path
from typing import TYPE_CHECKING

import click

from swarmdsl.cli import options
from swarmdsl.cli.exit_code import ERRORS, OK

if TYPE_CHECKING:
    from swarmdsl.execution.testing.verdict import Verdict


@click.command(epilog="Example: swarmc test examples/search_and_rescue -k abort --trace")
@options.files
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
    help="Write a page that plays the first test that fails, as HTML.",
)
@click.option(
    "--junit",
    type=click.Path(path_type=Path),
    metavar="FILE",
    help="Write the results as JUnit XML, for CI.",
)
@options.diagnostics_format
@options.debug
def test(
    paths: tuple[Path, ...],
    pattern: str | None,
    seed: int | None,
    trace: bool,
    coverage: bool,
    fail_under: float | None,
    play: Path | None,
    junit: Path | None,
    format_: str,
) -> int:
    """Run behaviour tests of models.

    Tests are in files NAME.swarmtest.toml. A FOLDER means all of these below it; without
    arguments, those below the current folder.
    """
    from swarmdsl.execution.testing import command

    options.check_outputs({"--play": play, "--junit": junit}, paths)
    failed: list[Verdict] = []
    request = command.Request(
        paths,
        pattern,
        seed,
        junit,
        trace,
        coverage,
        fail_under,
        format_,
        failed.append if play is not None else None,
    )
    passed = command.run(request, sys.stdout, sys.stderr)
    if play is not None and failed:
        from swarmdsl.cli.play_pages import play_failed

        play_failed(failed[0], play)
    return OK if passed else ERRORS
