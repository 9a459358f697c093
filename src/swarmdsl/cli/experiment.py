"""`swarmc experiment`."""

from __future__ import annotations

import os
import sys
from contextlib import ExitStack
from io import StringIO
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import TYPE_CHECKING

import click

from swarmdsl.base.diagnostics.render import DOCUMENTS, render
from swarmdsl.base.read_files import exists
from swarmdsl.cli import options
from swarmdsl.cli.engine_options import check_processes, engine
from swarmdsl.cli.exit_code import ERRORS, INTERRUPTED, OK

if TYPE_CHECKING:
    from swarmdsl.base.diagnostics.collector import Diagnostic, Diagnostics


@click.command(epilog="Example: swarmc experiment examples/agriculture/resilience.toml")
@click.argument("file", metavar="FILE", type=options.PLACE)
@click.option(
    "-o",
    "--output",
    metavar="FOLDER",
    type=click.Path(path_type=Path),
    help="Folder for the runs and the results.  [default: NAME-results for NAME.toml]",
)
@engine
@click.option(
    "--play",
    "plays",
    is_flag=True,
    help="Write the pages that play the worst and the best run of the best point.",
)
@click.option("--resume", is_flag=True, help="Go on with the runs in the folder.")
@options.diagnostics_format
@options.debug
def experiment(
    file: Path,
    output: Path | None,
    jobs: int | None,
    cluster: str | None,
    limit: float | None,
    feed: Path | None,
    plays: bool,
    resume: bool,
    is_json: bool,
    format_: str,
) -> int:
    """Run an experiment: factors with levels, and what they change.

    FILE is TOML: it names the model, the factors, the design and the number of repetitions. All
    points of the design run with the same seeds. The folder gets all runs in a file of SQLite,
    the results as JSON, and a page with charts, which needs no network.
    """
    from swarmdsl.cli.play_pages import play_runs
    from swarmdsl.execution.experiments.study.command import Request, run_study

    check_processes(jobs, cluster)
    is_document = format_ in DOCUMENTS
    if is_document and is_json:
        raise click.UsageError(f"`--format {format_}` and `--json` both print")
    options.check_outputs({"--feed": feed}, (file,))
    request = Request(
        file, output, jobs or os.cpu_count() or 1, cluster, resume, is_json, limit, feed
    )
    found: list[Diagnostic] = []
    with ExitStack() as stack:
        succeeded = run_study(
            request,
            lambda text, folder, report: _open(text, folder, report, stack),
            # What is found has one document on standard output.
            StringIO() if is_document else sys.stdout,
            found.extend if is_document else lambda each: render(each, format_, sys.stderr),
            play_runs if plays else None,
        )
    if is_document:
        render(found, format_, sys.stdout)
    return INTERRUPTED if succeeded is None else OK if succeeded else ERRORS


def _open(text: str, folder: Path, report: Diagnostics, stack: ExitStack) -> Path | None:
    """Return the path of a model, or of a revision of one in a folder that is removed later."""
    from swarmdsl.tools.compare.revisions import Revision, extract

    revision, colon, path = text.partition(":")
    if exists(folder / text) or not colon or len(revision) < 2:
        return folder / text
    # The name of the folder is part of the digest of the model.
    place = Path(os.path.realpath(stack.enter_context(TemporaryDirectory()))) / "revision"
    place.mkdir()
    return extract(Revision(revision, str(folder / path)), place, report)
