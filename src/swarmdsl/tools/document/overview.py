"""Tables about the whole model: packages and events."""

from __future__ import annotations

from collections.abc import Iterator
from typing import NamedTuple

from swarmdsl.project.loader import File
from swarmdsl.syntax.ast import Component, Event, Member
from swarmdsl.tools.document.elements import Element
from swarmdsl.tools.document.entry_builder import EntryBuilder, link, links
from swarmdsl.tools.document.page import Cell, Code, Fragment, Inline, Prose, Row, Table
from swarmdsl.tools.document.traffic import States

# A table with more columns cannot be read, and has a cell for each event and machine.
_MOST_COLUMNS = 20
_TITLE = "Senders and handlers of events"


class _Users(NamedTuple):
    """State machines that send or handle an event."""

    sent: dict[Element, States]
    handled: dict[Element, States]


def packages_table(builder: EntryBuilder) -> Table:
    """Table of files and their declarations."""
    of_file: dict[File, list[Element]] = {}
    for top in builder.elements.tops:
        of_file.setdefault(top.file, []).append(top)
    rows = tuple(
        Row(
            (
                (Code(((file.package, None),)), *((" library",) if file.library else ())),
                (Code(((builder.locations.file(file), None),)),),
                links(tops),
                (Prose(file.model.package.doc),) if file.model.package is not None else (),
            )
        )
        for file, tops in of_file.items()
    )
    return Table("Packages", ("package", "file", "declares", "description"), rows)


def events_table(builder: EntryBuilder) -> Table:
    """Table of events and the state machines that send or handle them."""
    machines = builder.traffic.machines()
    if len(machines) > _MOST_COLUMNS:
        rows = [
            Row((head, links([*users.sent]), links([*users.handled])))
            for head, users in _events(builder)
        ]
        return Table(_TITLE, ("event", "sent by", "handled by"), tuple(rows))
    headers = (_machine_header(machine, builder) for machine in machines)
    rows = [
        Row((head, *(_marks(machine, users) for machine in machines)))
        for head, users in _events(builder)
    ]
    return Table(_TITLE, ("event", *headers), tuple(rows), is_matrix=True)


def _events(builder: EntryBuilder) -> Iterator[tuple[Cell, _Users]]:
    """Yield the name of each event of the model and its users."""
    traffic = builder.traffic
    for event in builder.system.events:
        users = _Users(traffic.sent.get(event.name, {}), traffic.handled.get(event.name, {}))
        element = builder.elements.at(event.origin)
        declared = element is not None and isinstance(element.node, Event)
        if not (users.sent or users.handled or declared):
            continue
        shown = event.name if event.predefined else f'monitor "{event.topic}"'
        head: Inline = Code(((shown, None),))
        if declared and element is not None:
            head = link(element)
        yield (head,), users


def _marks(machine: Element, users: _Users) -> Cell:
    marks = ["sends"] if machine in users.sent else []
    marks += ["handles"] if machine in users.handled else []
    return (" and ".join(marks),) if marks else ()


def _machine_header(machine: Element, builder: EntryBuilder) -> Code:
    """State machine and the members and components that it is the behavior of."""
    owners = (each for each in builder.names.users(machine) if each.parent is None)
    whose = [each for each in owners if isinstance(each.node, (Member, Component))]
    pieces: list[Fragment] = [(machine.path, machine.anchor)]
    for owner in whose:
        pieces += [(" of " if len(pieces) == 1 else ", ", None), (owner.path, owner.anchor)]
    return Code(tuple(pieces))
