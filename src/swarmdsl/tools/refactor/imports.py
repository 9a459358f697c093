"""Imports that a new element needs, from files of the model."""

from __future__ import annotations

import re
from collections.abc import Iterable, Sequence
from pathlib import Path

from swarmdsl.base.diagnostics.collector import Diagnostic
from swarmdsl.base.rewriting import Change
from swarmdsl.driver.line_insertion import import_statement
from swarmdsl.driver.workspace import Workspace
from swarmdsl.project.loader import File

_HELP = re.compile(r"add `(import [^`]+)`")


def missing_import(workspace: Workspace, found: Iterable[Diagnostic]) -> tuple[File, Change] | None:
    """Return the insertion of the first import that a diagnostic asks for; None if none does.

    Only of a file of the model: a name that a library has, too, may be a typing error.
    """
    for each in found:
        line = _HELP.fullmatch(each.help or "")
        if each.name == "unresolved-name" and line and each.related and each.primary is not None:
            file = workspace.file(Path(each.primary.span.absolute.source.name))
            if file is not None:
                return file, import_statement(file, line[1])
    return None


def importable_files(files: Sequence[File], importer: File) -> list[File]:
    """Return the files that a file can import, which do not import it themselves, and the file."""
    importers = {id(importer)}
    while True:
        more = {
            id(file) for file in files if any(id(target) in importers for _, target in file.imports)
        }
        if more <= importers:
            return [file for file in files if file is importer or id(file) not in importers]
        importers |= more
