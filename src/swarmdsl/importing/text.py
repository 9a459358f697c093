"""Text of an imported model and its check."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

from swarmdsl.analysis.checks import validate
from swarmdsl.base.diagnostics.collector import Diagnostics, Severity
from swarmdsl.base.source import Source
from swarmdsl.codegen.swarm_printer.system import UnprintableError, print_system
from swarmdsl.importing.update import read_model
from swarmdsl.ir import System
from swarmdsl.project.loader import Project
from swarmdsl.syntax.formatter import format_source


def model_text(
    system: System,
    path: Path,
    report: Diagnostics,
    why_empty: Callable[[], str | None] = lambda: None,
) -> str | None:
    """Return the formatted text of a system; None if it is empty or cannot be printed.

    `why_empty` returns the reason for a system that is empty.
    """
    if not (report.has_errors or _has_content(system)):
        report.report("nothing-to-import", path=path.as_posix(), help=why_empty())
    if report.has_errors:
        return None
    try:
        plain = print_system(system)
    except UnprintableError as fault:
        report.report("no-model", path=path.as_posix(), reason=str(fault))
        return None
    return format_source(Source(f"{system.name}.swarm", plain), report) or plain


def _has_content(system: System) -> bool:
    found = (system.machines, system.functions, system.components, system.interfaces, system.events)
    return any(found)


def check_model(text: str, path: Path, report: Diagnostics) -> Project | None:
    """Check the text as a model; report its errors without location and return None."""
    found = Diagnostics()
    project = read_model(path, found, texts={str(path): text}, names=found).project
    validate(project, found)
    for error in found:
        if error.severity is Severity.ERROR:
            place = error.primary.span if error.primary is not None else None
            line = place.source.line_text(place.line).strip() if place is not None else ""
            reason = f"{error.message} ({error.code}) in `{line}`"
            report.report("no-model", path=path.as_posix(), reason=reason)
    return None if report.has_errors else project
