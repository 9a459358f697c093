"""Format files for `swarmc fmt`."""

from __future__ import annotations

import sys
from collections.abc import Sequence
from pathlib import Path

import click

from swarmdsl.base.diagnostics.collector import Diagnostics
from swarmdsl.base.diagnostics.render import counted
from swarmdsl.base.read_files import MOST
from swarmdsl.base.records import dataclass
from swarmdsl.base.rewriting import Layout
from swarmdsl.driver.format_files import STDIN, layout_of, layouts_of, write
from swarmdsl.driver.write_bounds import may_write_models


@dataclass(frozen=True)
class Outcome:
    """Result of a run; `done` is False if a file needs formatting or could not be formatted."""

    done: bool
    summary: str = ""


def inspect(
    paths: Sequence[Path], report: Diagnostics, *, as_diff: bool, migrate: bool = False
) -> Outcome:
    """Print the diffs, or the names, of files that would change."""
    layouts, wrong = _layouts(paths, report, migrate=migrate)
    changed = [layout for layout in layouts if layout.changed]
    for layout in changed:
        click.echo(layout.diff() if as_diff else layout.name, nl=not as_diff)
    summary = _summary("would be formatted", len(changed), len(layouts) - len(changed), wrong)
    return Outcome(not changed, summary)


def rewrite(paths: Sequence[Path], report: Diagnostics, *, migrate: bool = False) -> Outcome:
    """Write changed files in place, or standard input to standard output."""
    layouts, wrong = _layouts(paths, report, migrate=migrate)
    if _is_stdin(paths):
        for layout in layouts:
            click.echo(layout.after, nl=False)
        return Outcome(not wrong)
    changed = [layout for layout in layouts if layout.changed]
    names = [layout.name for layout in changed]
    if not (may_write_models(names, paths, report) and write(changed, report)):
        return Outcome(False)
    return Outcome(True, _summary("formatted", len(changed), len(layouts) - len(changed), wrong))


def _is_stdin(paths: Sequence[Path]) -> bool:
    return list(paths) == [Path("-")]


def _layouts(
    paths: Sequence[Path], report: Diagnostics, *, migrate: bool
) -> tuple[list[Layout], int]:
    if not _is_stdin(paths):
        return layouts_of(paths or (Path(),), report, migrate=migrate)
    content = sys.stdin.buffer.read(MOST + 1)
    if len(content) > MOST:
        report.report("too-large", path=STDIN, most=MOST // 2**20)
        return [], 1
    layout = layout_of(STDIN, content, report, migrate=migrate)
    return ([layout], 0) if layout is not None else ([], 1)


def _summary(done: str, changed: int, unchanged: int, wrong: int) -> str:
    parts = [
        f"{counted(changed, 'file')} {done}" if changed else "",
        f"{counted(unchanged, 'file')} unchanged" if unchanged else "",
        f"{counted(wrong, 'file')} with errors" if wrong else "",
    ]
    return ", ".join(part for part in parts if part) or "no files"
