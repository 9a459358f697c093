"""Models from files of the CPSwarm project and from plain SCXML, which `printer` writes as text.

A file is read for what it means. What is wrong with it is repaired where that can be done in one
way, and what a model cannot say is left out; either is reported at its place.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from typing import Literal

from swarmdsl.base.diagnostics.collector import Diagnostics
from swarmdsl.base.source import Source
from swarmdsl.execution.scxml.document import Document
from swarmdsl.importing import adf
from swarmdsl.importing.activities import Activities
from swarmdsl.importing.activity_outcomes import settle
from swarmdsl.importing.calls import Call
from swarmdsl.importing.events import Events
from swarmdsl.importing.library import Library
from swarmdsl.importing.machine import MachineMaker
from swarmdsl.importing.names import is_plain
from swarmdsl.importing.partial_states import Draft, drop_rest, read_drafts
from swarmdsl.importing.portable import Described
from swarmdsl.importing.repair import read
from swarmdsl.importing.scxml_patterns import Ends, fold_idioms
from swarmdsl.importing.targets import resolve
from swarmdsl.importing.unlower import fold_lowered
from swarmdsl.ir import System

# As many as a machine may have with all that it reuses.
_MOST_STATES = 10_000


def import_adf(
    sources: Iterable[Source],
    name: str,
    report: Diagnostics,
    category: Literal["abstraction", "swarm"] = "abstraction",
    guesses: set[tuple[str, str]] | None = None,
) -> System:
    """The functions and devices that ADF files describe, or AMF files of the swarm library.

    What is only assumed of one, `communication` for instance, is added to the guesses.
    """
    library = Library()
    for source in sources:
        adf.read(source, library, report, category)
    if guesses is not None:
        guesses |= library.guesses
    return _system(name, library)


def import_scxml(
    sources: Iterable[Source],
    described: Iterable[Source],
    name: str,
    report: Diagnostics,
    known: System | None = None,
    guesses: set[tuple[str, str]] | None = None,
) -> System:
    """The machines of SCXML documents, one a document; ADF files describe what they call.

    What a model has that they go into is `known`; guesses are as those of `import_adf`.
    """
    library = Library()
    for source in described:
        adf.read(source, library, report)
    if known is not None:
        library.know(known)
    events = Events(library.devices, known.events if known is not None else ())
    read_ = [each for source in sources for each in _read(source, library, events, report)]
    library.learn(
        [d.call for _, top, _, _ in read_ for d in top.walk() if isinstance(d.call, Call)]
    )
    for document, top, ends, _ in read_:
        if any(d.call is not None or d.monitors for d in top.walk()):
            settle(top, document, report)
        events.collect(top, ends, document, report)
    machines = []
    for document, top, ends, described_ in read_:
        text = document.root.get("name", "") or document.source.name.rpartition("/")[2]
        exact = described_ and is_plain(text) and text not in events.names.taken
        called = text if exact else events.names.new(text.removesuffix(".xml"))
        activities = Activities(document, library, report)
        maker = MachineMaker(document, top, described_, events, ends, activities, report)
        machines.append(maker.machine(called))
    packages = {described_.package for *_, described_ in read_}
    if len(packages) == 1 and all(packages):
        (name,) = packages
    if guesses is not None:
        guesses |= library.guesses | {(event, "topic") for event in events.guessed}
    system = _system(name, library)
    return System(
        name,
        system.interfaces,
        tuple(dict.fromkeys(events.known.values())),
        system.functions,
        system.components,
        machines=tuple(machines),
    )


def _read(
    source: Source, library: Library, events: Events, report: Diagnostics
) -> Iterator[tuple[Document, Draft, Ends, Described]]:
    """The states of a document; nothing where there are none."""
    document = read(source, report)
    if document is None:
        return
    top = read_drafts(document, report)
    states = sum(1 for _ in top.walk()) - 1
    if states > _MOST_STATES:
        reason = f"it has more than {_MOST_STATES} states"
        report.report("no-model", document.at(document.root), path=source.name, reason=reason)
    if not 0 < states <= _MOST_STATES:
        return
    described = Described(document, top, report)
    resolve(top, document, report)
    if described:
        fold_lowered(top)
        for interface in described.interfaces():
            library.interfaces.setdefault(interface.type, interface)
        for function in described.functions():
            library.take(function)
        for event in described.events():
            events.take(event, document.at(document.root), report)
    ends = fold_idioms(top, document, report)
    drop_rest(top, document, report)
    yield document, top, ends, described


def _system(name: str, library: Library) -> System:
    return System(
        name,
        library.new_interfaces(),
        functions=library.new_functions(),
        components=tuple(library.components),
    )
