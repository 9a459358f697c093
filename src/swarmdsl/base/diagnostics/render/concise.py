"""One line a diagnostic, for editors and grep: `file:line:column: error[SW0202] message`."""

from __future__ import annotations

from collections.abc import Iterable
from typing import TextIO

from swarmdsl.base.diagnostics.collector import Diagnostic
from swarmdsl.base.diagnostics.render.printable import printable


def render(found: Iterable[Diagnostic], stream: TextIO) -> None:
    """Write the diagnostics; one without a place starts with its severity."""
    for diagnostic in found:
        place = ""
        if diagnostic.primary is not None:
            source, start, _ = diagnostic.primary.span
            line, column = source.line_column(start)
            place = f"{printable(source.name)}:{line}:{column}: "
        message = printable(diagnostic.message)
        stream.write(f"{place}{diagnostic.severity.value}[{diagnostic.code}] {message}\n")
