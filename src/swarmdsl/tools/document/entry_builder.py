"""Builders of page entries."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence

from swarmdsl import ir
from swarmdsl.base.records import dataclass
from swarmdsl.syntax.ast import Node, Param, TypeRef
from swarmdsl.syntax.types import written
from swarmdsl.tools.document.elements import Element, Elements, SourceLocations
from swarmdsl.tools.document.names import NameResolver, doc_of
from swarmdsl.tools.document.page import Cell, Code, Entry, Figure, Inline, Prose, Row, Table
from swarmdsl.tools.document.traffic import EventTraffic


@dataclass(frozen=True)
class EntryBuilder:
    """A model with the lookup tables from which entries are built."""

    system: ir.System
    elements: Elements
    names: NameResolver
    locations: SourceLocations
    traffic: EventTraffic
    figures: Mapping[Element, Figure]
    functions: Mapping[Element, Sequence[ir.Function]]
    events: Mapping[Element, Sequence[ir.Event]]

    def entry(
        self,
        element: Element,
        facts: Iterable[tuple[str, Cell]] = (),
        blocks: Iterable[Table | Figure | None] = (),
        entries: Iterable[Entry] = (),
        has_code: bool = True,
    ) -> Entry:
        """Entry of an element without its empty facts and tables."""
        kept = (
            block.without_empty_columns() if isinstance(block, Table) else block
            for block in blocks
            if block is not None
        )
        return Entry(
            element.anchor,
            element.kind,
            element.name,
            element.path,
            self.names.head(element) if has_code else None,
            doc_of(element.node),
            self.locations.location(element),
            tuple((term, cell) for term, cell in facts if cell),
            tuple(block for block in kept if isinstance(block, Figure) or block.rows),
            tuple(entries),
            "library" if element.file.library else "",
        )

    def row(self, element: Element, cells: Sequence[Cell], heir: Element | None = None) -> Row:
        """Row of an element with its documentation.

        In the table of an `heir` that inherits the element, the row links to its entry instead.
        """
        doc = doc_of(element.node)
        last: Cell = (Prose(doc),) if doc else ()
        if heir is None or element.parent is heir:
            name: Cell = (Code(((element.name, None),)),)
            return Row((name, *cells, last), element.anchor, element.kind, element.name)
        base = element.top
        return Row(((link(element, element.name), " of ", link(base)), *cells, last))

    def code(self, node: Node | None, owner: Element) -> Cell:
        """Source text of a node, or nothing."""
        return (self.names.code(node.span, owner),) if node is not None else ()

    def type(self, ref: TypeRef, owner: Element) -> Cell:
        """Source text of a type, followed by the full type if that differs."""
        source = self.names.code(ref.span, owner)
        text = "".join(text for text, _ in source.pieces)
        full = written(ref.type)
        is_enum = self.names.type(ref.type) is not None
        if full == text or is_enum or full.endswith(f"/{text}"):
            return (source,)
        return (source, " = ", Code(((full, None),)))

    def used_by(self, element: Element) -> Cell:
        """Links to the elements that refer to an element."""
        return links(self.names.users(element))

    def params(self, owner: Element, params: Iterable[Param]) -> Table:
        """Table of params, including inherited ones."""
        rows = []
        for param in params:
            element = self.elements.of(param)
            if element is not None:
                cells = (
                    self.type(param.type, element),
                    self.code(param.default, element),
                    self.used_by(element),
                )
                rows.append(self.row(element, cells, owner))
        return Table("Params", ("name", "type", "default", "used by", "description"), tuple(rows))


def link(element: Element, text: str | None = None) -> Code:
    """Link to an element with its path or another text."""
    return Code(((text or element.path, element.anchor),))


def links(elements: list[Element]) -> tuple[Inline, ...]:
    """Links to elements, separated by commas."""
    found: list[Inline] = []
    for element in elements:
        found += [", "] if found else []
        found.append(link(element))
    return tuple(found)
