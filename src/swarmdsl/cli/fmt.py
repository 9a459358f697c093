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
@click.option("--check", "check_only", is_flag=True, help="List what would change, write nothing.")
@click.option("--diff", is_flag=True, help="Show what would change, write nothing.")
@options.diagnostics_format
@options.debug
def fmt(paths: tuple[Path, ...], check_only: bool, diff: bool, format_: str) -> int:
    """Bring files into the canonical layout.

    A FOLDER stands for all .swarm files below it; nothing, for the current folder; `-`, for
    standard input, whose layout goes to standard output. A file with syntax errors is left
    as it is. With `--check` and `--diff`, the exit code is 1 when there is something to change.
    """
    from swarmdsl.base.diagnostics.collector import Diagnostics
    from swarmdsl.cli import format_command

    if Path("-") in paths and len(paths) > 1:
        raise click.UsageError("`-` stands alone")
    report = Diagnostics()
    if check_only or diff:
        outcome = format_command.inspect(paths, report, as_diff=diff)
    else:
        outcome = format_command.rewrite(paths, report)
    render(report, format_, sys.stderr)
    if outcome.summary:
        click.echo(outcome.summary, err=True)
    return exit_code(report) or (OK if outcome.done else ERRORS)
