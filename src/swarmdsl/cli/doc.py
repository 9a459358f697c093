"""`swarmc doc`."""

from __future__ import annotations

import sys
from pathlib import Path

import click

from swarmdsl.cli import options
from swarmdsl.cli.exit_code import exit_code


@click.command(epilog="Example: swarmc doc examples/search_and_rescue -o sar.html")
@options.files
@click.option(
    "-o",
    "--output",
    "out",
    metavar="FILE|FOLDER",
    type=click.Path(path_type=Path),
    help="The output.  [default: the name of the model with .html, in the current folder]",
)
@click.option(
    "--libraries",
    is_flag=True,
    help="Include everything in libraries, not only what the model uses.",
)
@options.diagnostics_format
@options.debug
def doc(paths: tuple[Path, ...], out: Path | None, libraries: bool, format_: str) -> int:
    """Write a documentation page about a model.

    A FOLDER means all .swarm files below it. Without arguments: the sources of swarm.toml, or
    the current folder. The page is one self-contained file with all elements and their
    comments, diagrams, tables, links and a search. A model with errors is not documented.
    """
    from swarmdsl.base.diagnostics.render import render, summary
    from swarmdsl.tools.document.command import run

    documented = run(paths, out, libraries=libraries)
    render(documented.report, format_, sys.stderr)
    if documented.written is not None:
        click.echo(documented.written.as_posix(), err=True)
    click.echo(summary(documented.report, documented.files), err=True)
    return exit_code(documented.report)
