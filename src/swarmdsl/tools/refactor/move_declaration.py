"""Move a declaration into a file of its own, beside the one where it is.

The new file has the package of the old one and the imports that the declaration needs. Files
that use the declaration import the new file.
"""

from __future__ import annotations

import os
from pathlib import Path

from swarmdsl.analysis.resolve.scopes import Scopes
from swarmdsl.base.naming import snake_case
from swarmdsl.base.read_files import exists
from swarmdsl.base.rewriting import Change
from swarmdsl.driver.line_insertion import import_statement
from swarmdsl.driver.workspace import Workspace
from swarmdsl.driver.workspace.references import occurrences, occurrences_of, owner_at
from swarmdsl.driver.workspace.renaming import RefusedError
from swarmdsl.project.loader import File
from swarmdsl.syntax.ast import Optimization, TopLevel
from swarmdsl.tools.refactor.changed_texts import applied, statement, tried


def movable(file: File, offset: int) -> TopLevel | None:
    """Return the declaration whose name is at an offset, unless its file has no other."""
    found = owner_at(file, offset)
    if found is None or isinstance(found, Optimization) or len(file.model.declarations) < 2:
        return None
    name = getattr(found, "name", None)
    return found if name is not None and offset <= name.span.absolute.end else None


def new_path(file: File, declaration: TopLevel) -> Path:
    """Return the path of the file for a declaration."""
    assert file.source.path is not None  # sources of a workspace are files
    name = str(getattr(declaration, "name", "")).rpartition("/")[2]
    return file.source.path.with_name(f"{snake_case(name)}.swarm")


def move_declaration(workspace: Workspace, file: File, declaration: TopLevel) -> dict[Path, str]:
    """Return the texts of files, one of them new; raise RefusedError if not possible."""
    here, there = file.source.path, new_path(file, declaration)
    assert here is not None
    if exists(there):
        raise RefusedError(f"there is a file `{there.name}`")
    used = _used_files(workspace, file, declaration)
    users = {
        each.span.source.path
        for each in occurrences_of(declaration, workspace)
        if not _is_in(each.span.start, each.span.source.path, declaration)
    } - {None}
    if here in used and here in users:
        raise RefusedError("it and the rest of the file use each other")
    changes: dict[Path, list[Change]] = {here: []}
    for user in users:
        importer = workspace.file(user) if user is not None else None
        if importer is None or user is None or importer.library:
            continue
        line = f'import "{_relative(there, user)}"'
        changes.setdefault(user, []).append(import_statement(importer, line))
    changes[here].append((*statement(declaration.span.absolute), ""))
    texts = {
        path: applied(other.source.text, made)
        for path, made in changes.items()
        if (other := workspace.file(path)) is not None
    }
    needed = [
        statement_.span.text
        for statement_, target in file.imports
        if not users or target.source.path in used
    ]
    every = [each.span.text for each in file.model.imports]
    try:
        return tried(workspace, {**texts, there: _text(file, declaration, used, needed)})
    except RefusedError:
        return tried(workspace, {**texts, there: _text(file, declaration, used, every)})


def _used_files(workspace: Workspace, file: File, declaration: TopLevel) -> set[Path | None]:
    """Return the paths of the files whose declarations a declaration uses."""
    found: set[Path | None] = set()
    for each in occurrences(declaration, Scopes(workspace.project)[file]):
        span = each.node.span.absolute
        if not _is_in(span.start, span.source.path, declaration):
            found.add(span.source.path)
    return found


def _is_in(offset: int, path: Path | None, declaration: TopLevel) -> bool:
    span = declaration.span.absolute
    return path == span.source.path and span.start <= offset < span.end


def _text(file: File, declaration: TopLevel, used: set[Path | None], imports: list[str]) -> str:
    """Return the text of the new file."""
    here = file.source.path
    lines = [file.model.package.span.text] if file.model.package is not None else []
    own = [f'import "{here.name}"'] if here is not None and here in used else []
    text = file.source.text
    start, end = statement(declaration.span.absolute)
    parts = ["\n".join(lines), "\n".join(dict.fromkeys([*imports, *own])), text[start:end]]
    return "\n\n".join(filter(None, parts)) + "\n"


def _relative(path: Path, importer: Path) -> str:
    return Path(os.path.relpath(path, importer.parent)).as_posix()
