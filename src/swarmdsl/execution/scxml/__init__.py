"""Read SCXML documents as machines of the engine.

Control flow is supported completely; data are numbers, strings, booleans, and lists and objects of
these. Unsupported content is reported with its span.
"""

from __future__ import annotations

from swarmdsl.base.diagnostics.collector import Diagnostics
from swarmdsl.base.source import Source
from swarmdsl.execution.engine import Machine
from swarmdsl.execution.scxml.document import parse
from swarmdsl.execution.scxml.states import machine
from swarmdsl.execution.scxml.vocabulary import check


def read(source: Source, report: Diagnostics) -> Machine | None:
    """Read the machine of a document; None if it has errors, which are reported."""
    found = Diagnostics()
    document = parse(source, found)
    made = None
    if document is not None:
        check(document, found)
        if not found.has_errors:
            made = machine(document, found)
    report.include(found)
    return made if not found.has_errors else None
