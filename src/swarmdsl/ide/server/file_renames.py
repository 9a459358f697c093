"""Imports that change when files or folders get another name."""

from __future__ import annotations

import os
from collections.abc import Iterable, Iterator, Sequence
from pathlib import Path

from swarmdsl.base.source import Span
from swarmdsl.driver.workspace import Workspace
from swarmdsl.ide.server.links import unquoted
from swarmdsl.project.libraries import place_of
from swarmdsl.project.loader import File
from swarmdsl.syntax.ast import ImportFile, ImportRos

Move = tuple[Path, Path]


def import_changes(
    workspaces: Iterable[Workspace], moves: Sequence[Move]
) -> Iterator[tuple[Span, str]]:
    """Yield the edits of imports for files and folders that move: to them, and in them."""
    seen: set[Path] = set()
    for workspace in workspaces:
        for file in workspace.project.files:
            path = file.source.path
            if path is not None and path not in seen and not file.library:
                seen.add(path)
                yield from _changes(file, path, moves)


def _changes(file: File, path: Path, moves: Sequence[Move]) -> Iterator[tuple[Span, str]]:
    folder = _moved(path, moves).parent
    for statement in file.model.imports:
        if not isinstance(statement, (ImportFile, ImportRos)) or Path(statement.path).is_absolute():
            continue
        before = Path(os.path.normpath(path.parent / statement.path))
        after = _moved(before, moves)
        if after == before and folder == path.parent:
            continue
        text = Path(os.path.relpath(after, folder)).as_posix()
        if text != Path(os.path.normpath(statement.path)).as_posix():
            yield unquoted(place_of(statement).absolute), text


def _moved(path: Path, moves: Sequence[Move]) -> Path:
    """Return the new path of a file: its own, or that of a folder around it."""
    for old, new in moves:
        if path == old or path.is_relative_to(old):
            return new / path.relative_to(old)
    return path
