"""Diagnostics for people and for programs, one module a format."""

from __future__ import annotations

from collections.abc import Iterable
from importlib import import_module
from typing import TYPE_CHECKING, TextIO

if TYPE_CHECKING:
    from swarmdsl.base.diagnostics.collector import Diagnostic, Diagnostics

_MODULES = {
    "text": "text",
    "concise": "concise",
    "json": "json_lines",
    "github": "github",
    "sarif": "sarif",
}

FORMATS = tuple(_MODULES)
DOCUMENTS = ("sarif",)
"""Formats of which a run writes one document, with all its diagnostics."""
WITH_FIXES = ("json", "sarif")
"""Formats that list the fixes of each diagnostic."""


def render(found: Iterable[Diagnostic], format_: str, stream: TextIO) -> None:
    """Write diagnostics to a stream in one of the FORMATS."""
    import_module(f"{__name__}.{_MODULES[format_]}").render(found, stream)


def summary(report: Diagnostics, files: int) -> str:
    """All in all: "2 errors, 1 warning in 3 files"."""
    from swarmdsl.base.diagnostics.collector import Severity

    counts = [
        counted(number, severity.value)
        for severity in Severity
        if (number := report.count(severity))
    ]
    return f"{', '.join(counts) or 'no errors'} in {counted(files, 'file')}"


def counted(number: int, noun: str) -> str:
    """Return a number of things: "1 file", "3 files"."""
    return f"{number} {noun}" if number == 1 else f"{number} {noun}s"
