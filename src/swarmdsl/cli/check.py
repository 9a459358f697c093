"""`swarmc check`."""

from __future__ import annotations

import sys
from pathlib import Path

from swarmdsl.base.diagnostics.render import WITH_FIXES
from swarmdsl.base.errors import UsageError
from swarmdsl.cli.exit_code import briefly, conclude
from swarmdsl.cli.parameters import FORMAT, LEVELS, WATCH, Option

EPILOG = "Example: swarmc check examples/search_and_rescue --format concise"
FIXES = (
    Option("fix", ("--fix",), "Write what the help of diagnostics says, where that is certain."),
    Option("unsafe_fixes", ("--unsafe-fixes",), "With --fix or --diff: also fix what is a guess."),
    Option("diff", ("--diff",), "Show the fixes as a diff; write nothing."),
)
OPTIONS = (WATCH, *FIXES, *LEVELS, FORMAT)


def check(
    paths: tuple[Path, ...],
    watch: bool,
    fix: bool,
    unsafe_fixes: bool,
    diff: bool,
    allow: tuple[str, ...],
    warn: tuple[str, ...],
    deny: tuple[str, ...],
    format_: str,
) -> int:
    """Check models.

    A FOLDER means all .swarm files below it. Without arguments: the sources of swarm.toml, or
    the current folder. `--fix` writes the fixes of diagnostics, again until nothing changes; in a
    file with syntax errors, only these are fixed. With `--diff`, the exit code is 1 if a file would
    change.
    """
    from swarmdsl.base.diagnostics.collector import Diagnostics, Level
    from swarmdsl.driver import pipeline
    from swarmdsl.driver.config.command_line import run_settings

    levels = {Level.ALLOW: allow, Level.WARN: warn, Level.DENY: deny}
    if unsafe_fixes and not (fix or diff):
        raise UsageError("`--unsafe-fixes` needs `--fix` or `--diff`")
    if watch and (fix or diff):
        raise UsageError(f"`--watch` cannot be combined with `--{'fix' if fix else 'diff'}`")
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
    if fix or diff:
        from swarmdsl.cli.fix_command import show_fixes, write_fixes

        act = show_fixes if diff else write_fixes
        return act(paths, settings, format_, unsafe=unsafe_fixes)
    if format_ in WITH_FIXES:
        from swarmdsl.cli.fix_command import with_fixes

        return conclude(with_fixes(settings), format_, sys.stdout)
    result = pipeline.check(settings.sources, settings)
    code = conclude(result, format_, sys.stdout)
    if format_ == "text" and any(found.help for found in result.report):
        from swarmdsl.cli.fix_command import fixable

        if (said := fixable(settings)) is not None:
            sys.stderr.write(f"{said}\n")
    return code
