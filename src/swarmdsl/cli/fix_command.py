"""Fixes of `swarmc check`: written, shown as a diff, or listed with each diagnostic."""

from __future__ import annotations

import sys
from collections.abc import Sequence
from pathlib import Path

from swarmdsl.base.diagnostics.collector import Diagnostic, Diagnostics
from swarmdsl.base.diagnostics.render import WITH_FIXES, counted
from swarmdsl.base.rewriting import Layout
from swarmdsl.cli.exit_code import ERRORS, conclude
from swarmdsl.driver.config.settings import Settings
from swarmdsl.driver.fixes import SLOW, add_fixes, fixes_of
from swarmdsl.driver.fixes.application import Fixed, fix_all, layouts_of
from swarmdsl.driver.format_files import write
from swarmdsl.driver.pipeline import Result
from swarmdsl.driver.workspace import Workspace
from swarmdsl.driver.write_bounds import may_write_models

_TRIALS = 40
"""Trials of fixes to tell how many there are; each takes a check of what has changed."""


def with_fixes(settings: Settings) -> Result:
    """Check a model; each diagnostic has its fixes."""
    workspace = Workspace(settings.sources, settings)
    return Result(add_fixes(workspace.report, workspace), workspace.files)


def fixable(settings: Settings) -> str | None:
    """Return how many problems of a model can be fixed, and which options do so.

    The fixes are tried, as `--fix` does, unless this takes too many trials.
    """
    workspace = Workspace(settings.sources, settings)
    # It takes long to find out which new names fit.
    kept = [each for each in workspace.report if each.name != SLOW]
    if not any(fixes_of(each, workspace) for each in kept):
        return None
    bound = "at least " if len(kept) < len(list(workspace.report)) else ""
    every = fix_all(workspace, unsafe=True, slow=False, trials=_TRIALS)
    workspace = Workspace(settings.sources, settings)
    safe = fix_all(workspace, slow=False, trials=_TRIALS)
    if not (every.complete and safe.complete):
        return "some problems can be fixed: `--diff` and `--diff --unsafe-fixes` show which"
    count = len(every.applied)
    if not count:
        return None
    problems = f"{bound}{counted(count, 'problem')} can be fixed with `--fix"
    if len(safe.applied) == count:
        return f"{problems}`"
    alone = f", {len(safe.applied)} of them with `--fix` alone" if safe.applied else ""
    return f"{problems} --unsafe-fixes`{alone}"


def write_fixes(paths: Sequence[Path], settings: Settings, format_: str, *, unsafe: bool) -> int:
    """Write the fixes of a model, and print what was fixed and what remains."""
    workspace = Workspace(settings.sources, settings)
    fixed = fix_all(workspace, unsafe=unsafe)
    failed = Diagnostics()
    layouts = _layouts(fixed, paths, failed)
    if layouts is None or not write(layouts, failed):
        return conclude(Result(failed, workspace.files), format_, sys.stdout)
    for found, fix in fixed.applied:
        sys.stderr.write(f"{_where(found)}{found.code}: {fix.title}\n")
    if fixed.applied:
        sys.stderr.write(f"{_counted(fixed)} fixed\n")
    _tell_refused(fixed)
    report = workspace.report
    if format_ in WITH_FIXES:
        report = add_fixes(report, workspace)
    return conclude(Result(report, workspace.files), format_, sys.stdout)


def show_fixes(paths: Sequence[Path], settings: Settings, format_: str, *, unsafe: bool) -> int:
    """Print the fixes of a model as a diff; diagnostics that remain go to standard error."""
    workspace = Workspace(settings.sources, settings)
    fixed = fix_all(workspace, unsafe=unsafe)
    failed = Diagnostics()
    layouts = _layouts(fixed, paths, failed)
    if layouts is None:
        return conclude(Result(failed, workspace.files), format_, sys.stderr)
    for layout in layouts:
        sys.stdout.write(layout.diff())
    if fixed.applied:
        sys.stderr.write(f"{_counted(fixed)} would be fixed\n")
    _tell_refused(fixed)
    code = conclude(Result(workspace.report, workspace.files), format_, sys.stderr)
    return ERRORS if fixed.after else code


def _layouts(fixed: Fixed, paths: Sequence[Path], failed: Diagnostics) -> list[Layout] | None:
    """Return the changed files; report why they cannot be written, and return None."""
    if not may_write_models(map(str, fixed.after), paths, failed):
        return None
    return layouts_of(fixed, failed)


def _counted(fixed: Fixed) -> str:
    return f"{counted(len(fixed.applied), 'problem')} in {counted(len(fixed.after), 'file')}"


def _tell_refused(fixed: Fixed) -> None:
    """Print the fixes that were undone, each with the reason."""
    for each in fixed.refused:
        title = f"{each.found.code}: {each.fix.title}"
        sys.stderr.write(f"{_where(each.found)}not fixed: {title}: {each.reason}\n")


def _where(found: Diagnostic) -> str:
    place = found.primary.span if found.primary is not None else None
    return f"{place.source.name}:{place.line}: " if place is not None else ""
