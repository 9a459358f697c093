"""Models from files of the CPSwarm project and from plain SCXML, which `printer` writes as text.

A file is read for what it means. What is wrong with it is repaired where that can be done in one
way, and what a model cannot say is left out; either is reported at its place.
"""

from __future__ import annotations

from collections.abc import Iterable

from swarmdsl.diagnostics import Diagnostics
from swarmdsl.importing import adf
from swarmdsl.importing.activities import Activities, Library
from swarmdsl.importing.calls import Call
from swarmdsl.importing.drafts import Draft, read_drafts
from swarmdsl.importing.events import Events
from swarmdsl.importing.machine import MachineMaker
from swarmdsl.importing.outcomes import settle
from swarmdsl.importing.repair import read
from swarmdsl.ir import System
from swarmdsl.scxml.document import Document
from swarmdsl.source import Source


def import_adf(sources: Iterable[Source], name: str, report: Diagnostics) -> System:
    """The functions and devices that ADF files describe."""
    library = Library()
    for source in sources:
        adf.read(source, library, report)
    return _system(name, library)


def import_scxml(
    sources: Iterable[Source], described: Iterable[Source], name: str, report: Diagnostics
) -> System:
    """The machines of SCXML documents, one a document; ADF files describe what they call."""
    library = Library()
    for source in described:
        adf.read(source, library, report)
    events = Events(library.devices)
    read_: list[tuple[Document, Draft]] = []
    for source in sources:
        document = read(source, report)
        if document is not None:
            top = read_drafts(document, report)
            if not top.children:
                continue
            read_.append((document, top))
    library.learn([d.call for _, top in read_ for d in top.walk() if isinstance(d.call, Call)])
    for document, top in read_:
        if any(d.call is not None or d.monitors for d in top.walk()):
            settle(top, document, report)
        events.collect(top, document, report)
    machines = []
    for document, top in read_:
        text = document.root.get("name", "") or document.source.name.rpartition("/")[2]
        maker = MachineMaker(document, events, Activities(document, library, report), report)
        machines.append(maker.machine(top, events.names.new(text.removesuffix(".xml"))))
    system = _system(name, library)
    return System(
        name,
        system.interfaces,
        tuple(events.known.values()),
        system.functions,
        system.components,
        machines=tuple(machines),
    )


def _system(name: str, library: Library) -> System:
    return System(
        name,
        tuple(library.interfaces.values()),
        functions=tuple(library.functions.values()),
        components=tuple(library.components),
    )
