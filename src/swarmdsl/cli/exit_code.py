"""Exit codes, and the last lines of output.

It is imported before a Ctrl-C is caught, and so imports little.
"""

from __future__ import annotations

import signal
import sys
from typing import TYPE_CHECKING, TextIO

if TYPE_CHECKING:
    from swarmdsl.base.diagnostics.collector import Diagnostic, Diagnostics
    from swarmdsl.driver.pipeline import Result

OK, ERRORS, USAGE, INTERNAL = range(4)
# As shells report a program that a signal ended.
INTERRUPTED, TERMINATED = 128 + signal.SIGINT, 128 + signal.SIGTERM

# Errors on the command line that only the pipeline can find.
_USAGE_FAULTS = frozenset({"unknown-target", "bad-option"})


def conclude(result: Result, format_: str, stream: TextIO, *, about_files: bool = True) -> int:
    """Print diagnostics, written files and a summary; return the exit code."""
    from swarmdsl.base.diagnostics.render import render, summary

    render(result.report, format_, stream)
    if result.written is not None and about_files:
        from swarmdsl.output.report_written import render_written

        render_written(result.written, sys.stderr)
    if result.files or len(result.report):
        sys.stderr.write(f"{summary(result.report, result.files)}\n")
    return exit_code(result.report)


def briefly(result: Result, format_: str, stream: TextIO) -> str:
    """Print the diagnostics; return a summary in one line."""
    from swarmdsl.base.diagnostics.render import render, summary

    render(result.report, format_, stream)
    said = summary(result.report, result.files)
    if result.written is None:
        return said
    from swarmdsl.output.report_written import line

    return f"{line(result.written)}; {said}"


def exit_code(report: Diagnostics) -> int:
    """Return 0 without errors, 2 if all errors are on the command line, else 1."""
    from swarmdsl.base.diagnostics.collector import Severity

    errors = [found for found in report if found.severity is Severity.ERROR]
    if not errors:
        return OK
    return USAGE if all(map(_is_usage_fault, errors)) else ERRORS


def _is_usage_fault(found: Diagnostic) -> bool:
    # With a place in a file they are in swarm.toml.
    in_file = found.primary is not None and not found.primary.span.on_command_line
    return found.name in _USAGE_FAULTS and not in_file
