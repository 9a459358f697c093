"""Fixes of `swarmc check`: written, shown as a diff, or listed with each diagnostic."""

from __future__ import annotations

import sys
from collections.abc import Sequence
from pathlib import Path

from swarmdsl.base.diagnostics.collector import Diagnostics
from swarmdsl.base.diagnostics.render import counted, render
from swarmdsl.cli.exit_code import ERRORS, conclude, exit_code
from swarmdsl.driver.config.settings import Settings
from swarmdsl.driver.fixes import add_fixes
from swarmdsl.driver.fixes.application import Fixed, fix_all, layouts_of
from swarmdsl.driver.format_files import write
from swarmdsl.driver.pipeline import Result
from swarmdsl.driver.workspace import Workspace
from swarmdsl.driver.write_bounds import may_write_models


def with_fixes(settings: Settings) -> Result:
    """Check a model; each diagnostic has its fixes."""
    workspace = Workspace(settings.sources, settings)
    return Result(add_fixes(workspace.report, workspace), workspace.files)


def write_fixes(paths: Sequence[Path], settings: Settings, format_: str, *, unsafe: bool) -> int:
    """Write the fixes of a model, and print what was fixed and what remains."""
    workspace = Workspace(settings.sources, settings)
    fixed = fix_all(workspace, unsafe=unsafe)
    layouts = layouts_of(fixed)
    failed = Diagnostics()
    names = [layout.name for layout in layouts]
    if not (may_write_models(names, paths, failed) and write(layouts, failed)):
        render(failed, format_, sys.stdout)
        return exit_code(failed)
    for found, fix in fixed.applied:
        place = found.primary.span if found.primary is not None else None
        where = f"{place.source.name}:{place.line}: " if place is not None else ""
        sys.stderr.write(f"{where}{found.code}: {fix.title}\n")
    if fixed.applied:
        sys.stderr.write(f"{_counted(fixed)} fixed\n")
    report = add_fixes(workspace.report, workspace)
    return conclude(Result(report, workspace.files), format_, sys.stdout)


def show_fixes(_paths: Sequence[Path], settings: Settings, format_: str, *, unsafe: bool) -> int:
    """Print the fixes of a model as a diff; diagnostics that remain go to standard error."""
    workspace = Workspace(settings.sources, settings)
    fixed = fix_all(workspace, unsafe=unsafe)
    for layout in layouts_of(fixed):
        sys.stdout.write(layout.diff())
    if fixed.applied:
        sys.stderr.write(f"{_counted(fixed)} would be fixed\n")
    code = conclude(Result(workspace.report, workspace.files), format_, sys.stderr)
    return ERRORS if fixed.after else code


def _counted(fixed: Fixed) -> str:
    return f"{counted(len(fixed.applied), 'problem')} in {counted(len(fixed.after), 'file')}"
