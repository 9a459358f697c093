"""`swarmc fmt`."""

from __future__ import annotations

import sys
from pathlib import Path

import click

from swarmdsl.base.diagnostics.render import render
from swarmdsl.cli import options
from swarmdsl.cli.exit_code import ERRORS, OK, exit_code


@click.command(epilog="Example: swarmc fmt examples --diff")
@options.files
@click.option(
    "--check", "check_only", is_flag=True, help="List the files that would change; write nothing."
)
@click.option("--diff", is_flag=True, help="Show the changes; write nothing.")
@click.option(
    "--migrate",
    is_flag=True,
    help="Accept statements that share a line without a separator, as releases up to 0.2.0 did.",
)
@options.diagnostics_format
@options.debug
def fmt(paths: tuple[Path, ...], check_only: bool, diff: bool, migrate: bool, format_: str) -> int:
    """Format models.

    A FOLDER means all .swarm files below it; without arguments, those below the current folder.
    `-` formats standard input to standard output. A file with syntax errors is left as it is.
    With `--check` and `--diff`, the exit code is 1 if a file would change.
    """
    from swarmdsl.base.diagnostics.collector import Diagnostics
    from swarmdsl.cli import format_command

    if Path("-") in paths and len(paths) > 1:
        raise click.UsageError("`-` cannot be combined with other paths")
    report = Diagnostics()
    if check_only or diff:
        outcome = format_command.inspect(paths, report, as_diff=diff, migrate=migrate)
    else:
        outcome = format_command.rewrite(paths, report, migrate=migrate)
    render(report, format_, sys.stderr)
    if outcome.summary:
        click.echo(outcome.summary, err=True)
    return exit_code(report) or (OK if outcome.done else ERRORS)
