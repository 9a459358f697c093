"""`swarmc check`."""

from __future__ import annotations

import sys
from pathlib import Path

from swarmdsl.cli.exit_code import briefly, conclude
from swarmdsl.cli.parameters import FORMAT, LEVELS, WATCH

EPILOG = "Example: swarmc check examples/search_and_rescue --format concise"
OPTIONS = (WATCH, *LEVELS, FORMAT)


def check(
    paths: tuple[Path, ...],
    watch: bool,
    allow: tuple[str, ...],
    warn: tuple[str, ...],
    deny: tuple[str, ...],
    format_: str,
) -> int:
    """Check models.

    A FOLDER means all .swarm files below it. Without arguments: the sources of swarm.toml, or
    the current folder.
    """
    from swarmdsl.base.diagnostics.collector import Diagnostics, Level
    from swarmdsl.driver import pipeline
    from swarmdsl.driver.config.command_line import run_settings

    levels = {Level.ALLOW: allow, Level.WARN: warn, Level.DENY: deny}
    if watch:
        from swarmdsl.cli.watch import Concluded, watch_files

        return watch_files(
            paths,
            lambda report: run_settings(paths, levels, report),
            lambda result, _: Concluded(
                len(result.report) > 0, lambda: briefly(result, format_, sys.stdout)
            ),
        )
    report = Diagnostics()
    settings = run_settings(paths, levels, report)
    if report.has_errors:
        return conclude(pipeline.Result(report, files=1), format_, sys.stdout)
    return conclude(pipeline.check(settings.sources, settings), format_, sys.stdout)
