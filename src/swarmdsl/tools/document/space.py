"""Parts of entries about space: geometry, weather, equipment of members, sight of components."""

from __future__ import annotations

from collections.abc import Iterable, Iterator

from swarmdsl.analysis.resolve.inheritance import all_items
from swarmdsl.ir.space_settings import SPACE_SETTINGS
from swarmdsl.syntax.ast import (
    Area,
    Component,
    Environment,
    Equipment,
    Member,
    Node,
    Obstacle,
    PartValue,
    Rain,
    Sight,
    Targets,
    Wall,
    Wind,
    Zone,
)
from swarmdsl.tools.document.elements import Element
from swarmdsl.tools.document.entry_builder import EntryBuilder, link
from swarmdsl.tools.document.page import Cell, Code, Prose, Row, Table


def geometry_tables(element: Element, builder: EntryBuilder) -> Iterator[Table]:
    """Yield the tables of areas, zones, obstacles, walls and targets of an environment."""
    assert isinstance(element.node, Environment)
    named: dict[type[Node], list[Row]] = {Area: [], Zone: [], Obstacle: [], Targets: []}
    walls = []
    for item in element.node.items:
        inner = builder.elements.of(item)
        if isinstance(item, Wall):
            walls.append(Row((builder.code(item, element), _doc(item.doc))))
        elif inner is not None and type(item) in named:
            cells = (builder.code(item, inner), builder.used_by(inner))
            named[type(item)].append(builder.row(inner, cells))
    for kind, title in ((Area, "Areas"), (Zone, "Zones"), (Obstacle, "Obstacles")):
        columns = (title.lower()[:-1], "place", "used by", "description")
        yield Table(title, columns, tuple(named[kind]))
    yield Table("Walls", ("wall", "description"), tuple(walls))
    yield Table("Targets", ("target", "place", "used by", "description"), tuple(named[Targets]))


def weather(element: Element, builder: EntryBuilder) -> Iterator[tuple[str, Cell]]:
    """Yield wind and rain of an environment."""
    assert isinstance(element.node, Environment)
    for item in element.node.items:
        if isinstance(item, (Wind, Rain)):
            doc = (" ", Prose(item.doc)) if item.doc else ()
            yield type(item).__name__.lower(), (*builder.code(item, element), *doc)


def equipment_table(element: Element, node: Member, builder: EntryBuilder) -> Table:
    """Table of the body, battery and radio of a member, with the meaning of each value."""
    rows = [
        row
        for item in all_items(node, Equipment)
        for row in _settings(item.kind, item.doc, item.values, element, builder)
    ]
    return Table("In space", ("part", "setting", "value", "meaning", "description"), tuple(rows))


def sights_table(element: Element, node: Component, builder: EntryBuilder) -> Table:
    """Table of what a component finds in space, and how well."""
    rows = []
    for item in all_items(node, Sight):
        owner = builder.elements.at(item.span) or element
        target = builder.elements.of(item.target.target)
        name: Cell = (link(target),) if target is not None else (item.target.name,)
        rows += [
            Row((name, *row.cells[1:]))
            for row in _settings("senses", item.doc, item.values, owner, builder)
        ]
        if not item.values:
            rows.append(Row((name, (), (), (), _doc(item.doc))))
    return Table("Senses", ("target", "setting", "value", "meaning", "description"), tuple(rows))


def _settings(
    kind: str, doc: str, values: Iterable[PartValue], element: Element, builder: EntryBuilder
) -> Iterator[Row]:
    for value in values:
        known = SPACE_SETTINGS[kind].get(str(value.name))
        owner = builder.elements.at(value.span) or element
        name: Cell = (Code(((str(value.name), None),)),)
        cells = (name, builder.code(value.value, owner), (known.doc if known else "",))
        comment = "\n".join(filter(None, (doc, value.doc)))
        yield Row(((kind,), *cells, _doc(comment)))
        doc = ""


def _doc(doc: str) -> Cell:
    return (Prose(doc),) if doc else ()
