"""SCXML documents for the engine: what `swarmdsl.runtime` runs, from a file.

Control flow is read wholly, data as far as they are numbers, texts, truth values, and lists and
objects of these. What is not understood is reported at its place.
"""

from __future__ import annotations

from swarmdsl.diagnostics import Diagnostics
from swarmdsl.runtime import Machine
from swarmdsl.scxml.document import parse
from swarmdsl.scxml.states import machine
from swarmdsl.scxml.vocabulary import check
from swarmdsl.source import Source


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
