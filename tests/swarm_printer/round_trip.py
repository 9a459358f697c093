"""Print a system and compile the text."""

from __future__ import annotations

from pathlib import Path

from swarmdsl.base.diagnostics.collector import Severity
from swarmdsl.codegen.swarm_printer.system import print_system
from swarmdsl.driver import pipeline
from swarmdsl.ir import System


def compiled(*paths: Path) -> System:
    """Return the system of a valid model; warnings are allowed."""
    result = pipeline.check(list(paths))
    errors = [
        (found.code, found.message, found.primary and found.primary.span.text)
        for found in result.report
        if found.severity is Severity.ERROR
    ]
    assert result.system is not None, errors
    return result.system


def printed_and_compiled(system: System, folder: Path) -> System:
    """Return the system compiled from the text of a system."""
    path = folder / f"{system.name}.swarm"
    path.write_text(print_system(system), encoding="utf-8")
    try:
        return compiled(path)
    except AssertionError as error:
        raise AssertionError(f"{error}\n{path.read_text(encoding='utf-8')}") from None
