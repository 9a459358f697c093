"""Insert whole lines into a file: imports, and lines above or below statements."""

from __future__ import annotations

import re

from swarmdsl.base.rewriting import Change
from swarmdsl.base.text_edits import Edits
from swarmdsl.project.loader import File

# Comments at the beginning of a file, with a blank line below: they are about no declaration.
_HEADER = re.compile(
    r"\s*(?:(?:[ \t]*(?://(?!/)[^\n]*|/\*(?:[^*]|\*(?!/))*\*/[ \t]*)\n)+[ \t]*\n\s*)*"
)


def import_statement(file: File, line: str) -> Change:
    """Insert an import below the others, or above all declarations."""
    imports = file.model.imports
    if imports:
        return below(file, max(each.span.absolute.end for each in imports), line)
    return below_head(file, line if file.model.package is not None else f"{line}\n")


def below_head(file: File, lines: str) -> Change:
    """Insert lines below the package and the imports, or else above all declarations."""
    model = file.model
    head = [*([model.package] if model.package is not None else []), *model.imports]
    if head:
        return below(file, max(each.span.absolute.end for each in head), f"\n{lines}")
    found = _HEADER.match(file.source.text)
    return above(file, found.end() if found is not None else 0, lines)


def below(file: File, at: int, lines: str) -> Change:
    """Insert lines below the statement that ends at an offset, and its trailing comments."""
    edits = Edits(file.source)
    edits.below(at, lines)
    (change,) = edits.changes()
    return change


def above(file: File, at: int, lines: str) -> Change:
    """Insert lines above the statement at an offset."""
    edits = Edits(file.source)
    edits.above(at, lines)
    (change,) = edits.changes()
    return change
