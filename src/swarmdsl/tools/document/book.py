"""What all entries of a page are made from."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence

from swarmdsl import ir
from swarmdsl.base.records import dataclass
from swarmdsl.syntax.ast import Node, Param, TypeRef
from swarmdsl.tools.document.elements import Element, Elements, Places
from swarmdsl.tools.document.names import Names, doc_of
from swarmdsl.tools.document.page import Cell, Code, Entry, Figure, Inline, Prose, Row, Table
from swarmdsl.tools.document.traffic import Traffic


@dataclass(frozen=True)
class Book:
    """A model, with all that is known of its elements."""

    system: ir.System
    elements: Elements
    names: Names
    places: Places
    traffic: Traffic
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
        """All about an element; what has nothing in it is left out."""
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
            self.places.place(element),
            tuple((term, cell) for term, cell in facts if cell),
            tuple(block for block in kept if isinstance(block, Figure) or block.rows),
            tuple(entries),
            "library" if element.file.library else "",
        )

    def row(self, element: Element, cells: Sequence[Cell], heir: Element | None = None) -> Row:
        """A row about an element, with its documentation; that of an `heir` only links to it."""
        doc = doc_of(element.node)
        last: Cell = (Prose(doc),) if doc else ()
        if heir is None or element.parent is heir:
            name: Cell = (Code(((element.name, None),)),)
            return Row((name, *cells, last), element.anchor, element.kind, element.name)
        base = element.top
        return Row(((link(element, element.name), " of ", link(base)), *cells, last))

    def code(self, node: Node | None, owner: Element) -> Cell:
        """A part of a declaration as it is written, or nothing."""
        return (self.names.code(node.span, owner),) if node is not None else ()

    def type(self, ref: TypeRef, owner: Element) -> Cell:
        """A type as it is written, and what it stands for where that is something else."""
        written = self.names.code(ref.span, owner)
        text = "".join(text for text, _ in written.pieces)
        full = str(ref.type)
        is_enum = self.names.type(ref.type) is not None
        if full == text or is_enum or full.endswith(f"/{text}"):
            return (written,)
        return (written, " = ", Code(((full, None),)))

    def used_by(self, element: Element) -> Cell:
        """What names an element."""
        return listed(self.names.users(element))

    def params(self, owner: Element, params: Iterable[Param]) -> Table:
        """The params of something, some of which may be inherited."""
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
    """An element by its path, or by another text, as a link to it."""
    return Code(((text or element.path, element.anchor),))


def listed(elements: list[Element]) -> tuple[Inline, ...]:
    """Elements one after the other, each a link."""
    found: list[Inline] = []
    for element in elements:
        found += [", "] if found else []
        found.append(link(element))
    return tuple(found)
