"""`swarmc check`."""

from __future__ import annotations

import sys
from pathlib import Path

import click

from swarmdsl.cli import options
from swarmdsl.cli.outcome import conclude


@click.command(epilog="Example: swarmc check examples/search_and_rescue --format concise")
@options.files
@options.watch
@options.allow
@options.warn
@options.deny
@options.diagnostics_format
@options.debug
def check(
    paths: tuple[Path, ...],
    watch: bool,
    allow: tuple[str, ...],
    warn: tuple[str, ...],
    deny: tuple[str, ...],
    format_: str,
) -> int:
    """Find mistakes in models.

    A FOLDER stands for all .swarm files below it; nothing, for the sources that swarm.toml
    names, or for the current folder.
    """
    from swarmdsl import compiler
    from swarmdsl.diagnostics import Diagnostics, Level
    from swarmdsl.project.command_line import run_settings

    report = Diagnostics()
    levels = {Level.ALLOW: allow, Level.WARN: warn, Level.DENY: deny}
    settings = run_settings(paths, levels, report)
    if report.has_errors:
        return conclude(compiler.Result(report, files=1), format_, sys.stdout)
    if watch:
        from swarmdsl.cli.watch import watch_files

        return watch_files(
            settings,
            lambda workspace: conclude(
                compiler.Result(workspace.report, workspace.files), format_, sys.stdout
            ),
        )
    return conclude(compiler.check(settings.sources, settings), format_, sys.stdout)
