"""`--watch`: a command that runs again whenever a file changes."""

from __future__ import annotations

import gc
import sys
from collections.abc import Callable
from pathlib import Path
from time import perf_counter, sleep

import click

from swarmdsl.project.settings import Settings
from swarmdsl.workspace import Workspace

_PAUSE = 0.2
"""Seconds between two looks at the files."""

Stamp = tuple[int, int]


def watch_files(settings: Settings, conclude: Callable[[Workspace], object]) -> int:
    """Conclude each time that a file of a model changes; return 0 when the user ends it.

    Looking at the times of a few hundred files takes milliseconds, and works on all file systems.
    """
    try:
        workspace = Workspace(settings.sources, settings)
        gc.collect()
        gc.freeze()
        known = _stamps(workspace)
        _show(workspace, conclude, None)
        while True:
            sleep(_PAUSE)
            found = _stamps(workspace)
            changed = {path for path, _ in known.items() ^ found.items()}
            if changed:
                start = perf_counter()
                workspace.update(dict.fromkeys(changed))
                # Of what changed meanwhile the older time counts, so that it is seen next.
                known = _stamps(workspace)
                known.update((path, found[path]) for path in known.keys() & found.keys())
                _show(workspace, conclude, perf_counter() - start)
                gc.collect()
    except KeyboardInterrupt:
        click.echo(err=True)
        return 0


def _show(
    workspace: Workspace, conclude: Callable[[Workspace], object], seconds: float | None
) -> None:
    if sys.stdout.isatty():
        click.clear()
    conclude(workspace)
    taken = f" after {seconds * 1000:.0f} ms" if seconds is not None else ""
    click.echo(f"waiting for changes{taken}; end with Ctrl-C", err=True)


def _stamps(workspace: Workspace) -> dict[Path, Stamp | None]:
    """When each file was changed, and how long it is; None for one that is not there."""
    return {path: _stamp(path) for path in workspace.watched()}


def _stamp(path: Path) -> Stamp | None:
    try:
        stat = path.stat()
    except OSError:
        return None
    return stat.st_mtime_ns, stat.st_size
