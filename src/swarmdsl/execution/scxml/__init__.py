"""SCXML documents for the engine: what `swarmdsl.execution.engine` runs, from a file.

Control flow is read wholly, data as far as they are numbers, texts, truth values, and lists and
objects of these. What is not understood is reported at its place.
"""

from __future__ import annotations

from swarmdsl.base.diagnostics.collector import Diagnostics
from swarmdsl.base.source import Source
from swarmdsl.execution.engine import Machine
from swarmdsl.execution.scxml.document import parse
from swarmdsl.execution.scxml.states import machine
from swarmdsl.execution.scxml.vocabulary import check


def read(source: Source, report: Diagnostics) -> Machine | None:
    """The machine of a document; None when something is wrong with it, which has been reported."""
    found = Diagnostics()
    document = parse(source, found)
    made = None
    if document is not None:
        check(document, found)
        if not found.has_errors:
            made = machine(document, found)
    report.include(found)
    return made if not found.has_errors else None
