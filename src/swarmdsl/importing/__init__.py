"""Import models from files of the CPSwarm project and from plain SCXML.

Files are read for their meaning. Errors with a unique fix are repaired, and anything that a model
cannot express is left out; both are reported. `codegen.swarm_printer` writes the result.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from typing import Literal

from swarmdsl.base.diagnostics.collector import Diagnostics
from swarmdsl.base.source import Source
from swarmdsl.execution.scxml.document import Document
from swarmdsl.importing import adf
from swarmdsl.importing.activities import Activities
from swarmdsl.importing.activity_outcomes import resolve_outcomes
from swarmdsl.importing.calls import Call
from swarmdsl.importing.events import Events
from swarmdsl.importing.library import Library
from swarmdsl.importing.machine import MachineBuilder
from swarmdsl.importing.names import is_plain
from swarmdsl.importing.partial_states import PartialState, drop_unsupported, read_partial_states
from swarmdsl.importing.portable import PortableDescription
from swarmdsl.importing.repair import read
from swarmdsl.importing.scxml_patterns import FinalEvents, fold_patterns
from swarmdsl.importing.targets import resolve_targets
from swarmdsl.importing.units import give_units
from swarmdsl.importing.unlower import undo_lowering
from swarmdsl.ir import System

# The same limit as for a state machine with its submachines.
_MAX_STATES = 10_000


def import_adf(
    sources: Iterable[Source],
    name: str,
    report: Diagnostics,
    category: Literal["abstraction", "swarm"] = "abstraction",
    guesses: set[tuple[str, str]] | None = None,
) -> System:
    """Import functions and devices from ADF files or AMF files of the swarm library.

    `guesses` collects what is only assumed, as pairs of name and property.
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
    """Import SCXML documents as state machines; ADF files describe called functions.

    `known` is the model that the import is merged into; for `guesses` see `import_adf`.
    """
    library = Library()
    for source in described:
        adf.read(source, library, report)
    if known is not None:
        library.add_existing(known)
    events = Events(library.devices, known.events if known is not None else ())
    read_ = [each for source in sources for each in _read(source, library, events, report)]
    library.infer_goal_fields(
        [d.call for _, top, _, _ in read_ for d in top.walk() if isinstance(d.call, Call)]
    )
    for document, top, ends, _ in read_:
        if any(d.call is not None or d.monitors for d in top.walk()):
            resolve_outcomes(top, document, report)
        events.collect(top, ends, document, report)
    machines = []
    for document, top, ends, described_ in read_:
        text = document.root.get("name", "") or document.source.name.rpartition("/")[2]
        exact = described_ and is_plain(text) and text not in events.names.taken
        called = text if exact else events.names.new(text.removesuffix(".xml"))
        activities = Activities(document, library, report)
        maker = MachineBuilder(document, top, described_, events, ends, activities, report)
        machines.append(maker.machine(called))
    packages = {described_.package for *_, described_ in read_}
    if len(packages) == 1 and all(packages):
        (name,) = packages
    if guesses is not None:
        guesses |= library.guesses | {(event, "topic") for event in events.guessed}
    system = _system(name, library)
    return give_units(
        System(
            name,
            system.interfaces,
            tuple(dict.fromkeys(events.known.values())),
            system.functions,
            system.components,
            machines=tuple(machines),
        )
    )


def _read(
    source: Source, library: Library, events: Events, report: Diagnostics
) -> Iterator[tuple[Document, PartialState, FinalEvents, PortableDescription]]:
    """Yield the states of a document, if it has any."""
    document = read(source, report)
    if document is None:
        return
    top = read_partial_states(document, report)
    states = sum(1 for _ in top.walk()) - 1
    if states > _MAX_STATES:
        reason = f"it has more than {_MAX_STATES} states"
        report.report("no-model", document.at(document.root), path=source.name, reason=reason)
    if not 0 < states <= _MAX_STATES:
        return
    described = PortableDescription(document, top, report)
    resolve_targets(top, document, report)
    if described:
        undo_lowering(top)
        for interface in described.interfaces():
            library.interfaces.setdefault(interface.type, interface)
        for function in described.functions():
            library.add_portable(function)
        for event in described.events():
            events.add_portable(event, document.at(document.root), report)
    ends = fold_patterns(top, document, report)
    drop_unsupported(top, document, report)
    yield document, top, ends, described


def _system(name: str, library: Library) -> System:
    return System(
        name,
        library.new_interfaces(),
        functions=library.new_functions(),
        components=tuple(library.components),
    )
