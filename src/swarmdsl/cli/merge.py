"""`swarmc merge`."""

from __future__ import annotations

import sys
from pathlib import Path
from typing import TYPE_CHECKING

import click

from swarmdsl.cli import options
from swarmdsl.cli.exit_code import OK

if TYPE_CHECKING:
    from swarmdsl.base.diagnostics.collector import Diagnostics

# As git expects of a merge driver: 1 for conflicts, more without a result.
CONFLICTS, TROUBLE = 1, 2
_FILE = click.Path(path_type=Path)


@click.command(epilog="Example: swarmc merge base.swarm ours.swarm theirs.swarm -o ours.swarm")
@click.argument("base", type=_FILE)
@click.argument("ours", type=_FILE)
@click.argument("theirs", type=_FILE)
@click.option("-o", "--out", type=_FILE, metavar="FILE", help="The output, instead of stdout.")
@options.debug
def merge(base: Path, ours: Path, theirs: Path, out: Path | None) -> int:
    """Merge two versions of a model file, by declarations.

    BASE is the common ancestor. A change of one side is taken; different changes of both sides
    are marked like conflicts of git. A file with syntax errors is merged by lines. The exit
    code is 0 for a clean merge, 1 for conflicts, and 2 if a file cannot be read.
    """
    from swarmdsl.base.diagnostics.collector import Diagnostics
    from swarmdsl.base.diagnostics.render import render
    from swarmdsl.tools.merge.files import merge_files

    report = Diagnostics()
    merged = merge_files(base, ours, theirs, report)
    if merged is not None and out is not None:
        _write(out, merged.content, report)
    if report.has_errors:
        render(report, "concise", sys.stderr)
    if merged is None or any(found.name == "cannot-write" for found in report):
        return TROUBLE
    if out is None:
        sys.stdout.flush()
        sys.stdout.buffer.write(merged.content)
    if merged.by_lines:
        click.echo("merged by lines", err=True)
    if merged.conflicts:
        conflicts = "conflict" if merged.conflicts == 1 else "conflicts"
        click.echo(f"{merged.conflicts} {conflicts} in {out or ours}", err=True)
    return CONFLICTS if merged.conflicts else OK


def _write(out: Path, content: bytes, report: Diagnostics) -> None:
    from swarmdsl.base.atomic_write import Staging

    try:
        with Staging() as staging:
            staging.add(out, content)
            for _ in staging.move_in_place():
                pass
    except OSError as error:
        reason = (error.strerror or str(error)).lower()
        report.report("cannot-write", path=error.filename or out, reason=reason)
