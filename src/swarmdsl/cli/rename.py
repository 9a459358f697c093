"""`swarmc rename`."""

from __future__ import annotations

import sys
from pathlib import Path

import click

from swarmdsl.cli import options
from swarmdsl.cli.exit_code import exit_code


@click.command(epilog="Example: swarmc rename UavSearch.TakeOff Climb --dry-run")
@click.argument("old", metavar="OLD")
@click.argument("new", metavar="NEW")
@options.files
@click.option("--dry-run", is_flag=True, help="Show the changes; write nothing.")
@options.diagnostics_format
@options.debug
def rename(old: str, new: str, paths: tuple[Path, ...], dry_run: bool, format_: str) -> int:
    """Rename an element in the model, its tests and scenarios.

    OLD is its name, or its path where the name is ambiguous: `Uav.altitude` is a param of a
    member, `Search.Rise` a state of a machine, `Dive.goal.depth` a field of an action. NEW is one
    word. A new name that would cause an error, or change the meaning of another name, is refused.
    """
    from swarmdsl.base.diagnostics.render import counted, render
    from swarmdsl.tools.refactor.rename import rename as renamed

    done = renamed(paths, old, new, dry_run=dry_run)
    render(done.report, format_, sys.stderr)
    if dry_run:
        for layout in done.layouts:
            click.echo(layout.diff(), nl=False)
    elif done.layouts:
        files = counted(len(done.layouts), "file")
        click.echo(f"{counted(done.places, 'place')} in {files} changed", err=True)
    return exit_code(done.report)
