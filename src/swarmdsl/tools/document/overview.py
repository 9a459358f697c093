"""What is said of a model as a whole: its packages, and who sends and handles which event."""

from __future__ import annotations

from swarmdsl.project.loader import File
from swarmdsl.syntax.ast import Component, Event, Member
from swarmdsl.tools.document.book import Book, link, listed
from swarmdsl.tools.document.elements import Element
from swarmdsl.tools.document.page import Cell, Code, Inline, Piece, Prose, Row, Table


def packages(book: Book) -> Table:
    """The files, each with what it declares."""
    of_file: dict[File, list[Element]] = {}
    for top in book.elements.tops:
        of_file.setdefault(top.file, []).append(top)
    rows = tuple(
        Row(
            (
                (Code(((file.package, None),)), *((" library",) if file.library else ())),
                (Code(((book.places.file(file), None),)),),
                listed(tops),
                (Prose(file.model.package.doc),) if file.model.package is not None else (),
            )
        )
        for file, tops in of_file.items()
    )
    return Table("Packages", ("package", "file", "declares", "description"), rows)


def events_matrix(book: Book) -> Table:
    """A row for each event, a column for each state machine that sends or handles any."""
    traffic = book.traffic
    machines = traffic.machines()
    rows = []
    for event in book.system.events:
        sent, handled = traffic.sent.get(event.name, {}), traffic.handled.get(event.name, {})
        element = book.elements.at(event.origin)
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
    columns: tuple[Inline, ...] = ("event", *(_run(machine, book) for machine in machines))
    return Table("Who sends and who handles which event", columns, tuple(rows), is_matrix=True)


def _run(machine: Element, book: Book) -> Code:
    """A state machine, and whose behaviour it is."""
    owners = (each for each in book.names.users(machine) if each.parent is None)
    whose = [each for each in owners if isinstance(each.node, (Member, Component))]
    pieces: list[Piece] = [(machine.path, machine.anchor)]
    for owner in whose:
        pieces += [(" of " if len(pieces) == 1 else ", ", None), (owner.path, owner.anchor)]
    return Code(tuple(pieces))
