"""A page of documentation as plain data: what is said of each element, before it is HTML."""

from __future__ import annotations

from collections.abc import Sequence

from markupsafe import Markup

from swarmdsl.base.records import dataclass

Piece = tuple[str, str | None]
"""A text, and the anchor that it leads to."""


@dataclass(frozen=True, slots=True)
class Code:
    """Text of the model, with links where it names something."""

    pieces: tuple[Piece, ...]


@dataclass(frozen=True, slots=True)
class Prose:
    """Documentation from the model, in Markdown."""

    text: str


Inline = str | Code | Prose
Cell = Sequence[Inline]
"""What stands beside each other in a table: words, code, documentation."""


@dataclass(frozen=True, slots=True)
class Row:
    """A line of a table; one with an `anchor` is about an element of this `kind` and `name`."""

    cells: tuple[Cell, ...]
    anchor: str | None = None
    kind: str = ""
    name: str = ""


@dataclass(frozen=True, slots=True)
class Table:
    """A table, whose last column is documentation if there is any."""

    title: str
    columns: tuple[Inline, ...]
    rows: tuple[Row, ...]
    is_matrix: bool = False

    def without_empty_columns(self) -> Table:
        """The same without columns that have nothing in any row."""
        kept = [at for at in range(len(self.columns)) if any(row.cells[at] for row in self.rows)]
        rows = tuple(
            Row(tuple(row.cells[at] for at in kept), row.anchor, row.kind, row.name)
            for row in self.rows
        )
        return Table(self.title, tuple(self.columns[at] for at in kept), rows, self.is_matrix)


@dataclass(frozen=True, slots=True)
class Figure:
    """A diagram as SVG, or why there is none."""

    title: str
    svg: Markup | None
    instead: str = ""


@dataclass(frozen=True, slots=True)
class Entry:
    """All about an element: `code` is how it is declared, `facts` are terms with what they are.

    `note` is where it comes from, if that is not the project itself.
    """

    anchor: str
    kind: str
    name: str
    title: str
    code: Code | None
    doc: str
    place: str
    facts: tuple[tuple[str, Cell], ...] = ()
    blocks: tuple[Table | Figure, ...] = ()
    entries: tuple[Entry, ...] = ()
    note: str = ""


@dataclass(frozen=True, slots=True)
class Section:
    """Entries of one kind, and perhaps a table about all of them."""

    id: str
    title: str
    entries: tuple[Entry, ...]
    table: Table | None = None

    @property
    def table_id(self) -> str:
        """Where the table is."""
        return f"{self.id}-table"


@dataclass(frozen=True, slots=True)
class Page:
    """A whole model."""

    title: str
    doc: str
    tables: tuple[Table, ...]
    sections: tuple[Section, ...]
