"""Tables about the whole model: packages and events."""

from __future__ import annotations

from swarmdsl.project.loader import File
from swarmdsl.syntax.ast import Component, Event, Member
from swarmdsl.tools.document.elements import Element
from swarmdsl.tools.document.entry_builder import EntryBuilder, link, links
from swarmdsl.tools.document.page import Cell, Code, Fragment, Inline, Prose, Row, Table


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
    """Matrix of events and the state machines that send or handle them."""
    traffic = builder.traffic
    machines = traffic.machines()
    rows = []
    for event in builder.system.events:
        sent, handled = traffic.sent.get(event.name, {}), traffic.handled.get(event.name, {})
        element = builder.elements.at(event.origin)
        declared = element is not None and isinstance(element.node, Event)
        if not (sent or handled or declared):
            continue
        head: Inline = Code(((f'monitor "{event.topic}"', None),))
        if declared and element is not None:
            head = link(element)
        cells: list[Cell] = [(head,)]
        for machine in machines:
            marks = ["sends"] if machine in sent else []
            marks += ["handles"] if machine in handled else []
            cells.append((" and ".join(marks),) if marks else ())
        rows.append(Row(tuple(cells)))
    columns: tuple[Inline, ...] = (
        "event",
        *(_machine_header(machine, builder) for machine in machines),
    )
    return Table("Senders and handlers of events", columns, tuple(rows), is_matrix=True)


def _machine_header(machine: Element, builder: EntryBuilder) -> Code:
    """State machine and the members and components that it is the behavior of."""
    owners = (each for each in builder.names.users(machine) if each.parent is None)
    whose = [each for each in owners if isinstance(each.node, (Member, Component))]
    pieces: list[Fragment] = [(machine.path, machine.anchor)]
    for owner in whose:
        pieces += [(" of " if len(pieces) == 1 else ", ", None), (owner.path, owner.anchor)]
    return Code(tuple(pieces))
