"""`--watch`: a command that runs again whenever a file changes."""

from __future__ import annotations

import gc
import os
import sys
from collections.abc import Callable, Iterable, Mapping
from pathlib import Path
from time import perf_counter, sleep, strftime

import click

from swarmdsl.base import interrupts
from swarmdsl.base.diagnostics.collector import Diagnostics
from swarmdsl.base.errors import UsageError
from swarmdsl.base.records import dataclass
from swarmdsl.driver.config import places
from swarmdsl.driver.config.settings import FILE_NAME, Settings
from swarmdsl.driver.pipeline import Result
from swarmdsl.driver.workspace import Workspace

_PAUSE = 0.2
"""Seconds between two polls."""

Stamp = tuple[int, int]
Stamps = Mapping[str, Stamp | None]


@dataclass(frozen=True)
class Concluded:
    """Result of a run: `say` prints it and returns a summary of a few words.

    `has_more` is True if `say` prints anything.
    """

    has_more: bool
    say: Callable[[], str]


Conclude = Callable[[Result, Settings], Concluded]
"""Report a check, or build what it found valid."""


def watch_files(
    paths: tuple[Path, ...],
    read_settings: Callable[[Diagnostics], Settings],
    conclude: Conclude,
) -> int:
    """Conclude after each change of a file of the model or project; return 0 when the user ends it.

    Polling the times of a few hundred files takes milliseconds, and works on all file systems.
    Errors in the settings are reported until they are fixed.
    """
    try:
        changed: set[str] = set()
        screen = _Screen(conclude)
        while True:
            start = perf_counter()
            before = _stamps(places(paths[0] if paths else Path()))
            report = Diagnostics()
            settings = read_settings(report)
            if report.has_errors:
                screen.show(Result(report, files=1), settings, changed, start)
                while _stamps(before) == before:
                    _pause()
            else:
                _watch(before, settings, screen, changed, start)
            changed = {FILE_NAME}
    except KeyboardInterrupt:
        click.echo(err=True)
        return 0


def _watch(
    project: Stamps, settings: Settings, screen: _Screen, changed: set[str], start: float
) -> None:
    """Watch the files of a model until the project file changes, which it last did at `start`."""
    workspace = Workspace(settings.sources, settings)
    gc.collect()
    gc.freeze()
    known = _stamps(workspace.watched())
    screen.show(_result(workspace, settings), settings, changed, start)
    while _stamps(project) == project:
        _pause()
        found = _stamps(workspace.watched())
        changed = {path for path, _ in known.items() ^ found.items()}
        if changed:
            start = perf_counter()
            workspace.update({Path(path): None for path in changed})
            # Files that changed meanwhile keep their older time, so that the next poll sees them.
            known = _stamps(workspace.watched())
            known.update((path, found[path]) for path in known.keys() & found.keys())
            screen.show(_result(workspace, settings), settings, changed, start)
            gc.collect()


def _pause() -> None:
    sleep(_PAUSE)
    interrupts.raise_lost()


def _result(workspace: Workspace, settings: Settings) -> Result:
    report = workspace.report
    valid = None if report.has_errors else workspace.project
    return Result(report, workspace.files, valid, settings.name)


class _Screen:
    """Output of each run: diagnostics, then one line."""

    def __init__(self, conclude: Conclude) -> None:
        self._conclude = conclude
        self._had_more = False

    def show(
        self, result: Result, settings: Settings, changed: Iterable[str], start: float
    ) -> None:
        """Show the result of a run that began at `start`, after files had changed."""
        try:
            concluded = self._conclude(result, settings)
        except UsageError as error:  # the project file leaves something open
            fault = f"Error: {error}"
            concluded = Concluded(False, lambda: fault)
        if sys.stdout.isatty():
            click.clear()
        names = ", ".join(sorted(Path(each).name for each in changed))
        if names and (concluded.has_more or self._had_more):
            # By this line an editor knows that earlier diagnostics are outdated.
            click.echo(f"changed: {names}", err=True)
        self._had_more = concluded.has_more
        said = concluded.say()
        sys.stdout.flush()
        about = f"{strftime('%H:%M:%S')}, {(perf_counter() - start) * 1000:.0f} ms"
        if names:
            about = f"{names}, {about}"
        # In parentheses: terminals make the address before it clickable.
        ending = "" if names else " (end with Ctrl-C)"
        click.echo(f"waiting for changes ({about}): {said}{ending}", err=True)


def _stamps(paths: Iterable[str | Path]) -> dict[str, Stamp | None]:
    """Time of change and size of each file and folder; None for a missing one."""
    return {os.fspath(path): _stamp(path) for path in paths}


def _stamp(path: str | Path) -> Stamp | None:
    try:
        stat = os.stat(path)  # noqa: PTH116 - takes any path, however long
    except (OSError, ValueError):
        return None
    return stat.st_mtime_ns, stat.st_size
