"""Documentation page as plain data, before it is rendered as HTML."""

from __future__ import annotations

from collections.abc import Sequence

from markupsafe import Markup

from swarmdsl.base.records import dataclass

Fragment = tuple[str, str | None]
"""A string and the anchor that it links to."""


@dataclass(frozen=True, slots=True)
class Code:
    """Model text with links."""

    pieces: tuple[Fragment, ...]


@dataclass(frozen=True, slots=True)
class Prose:
    """Documentation from the model, in Markdown."""

    text: str


Inline = str | Code | Prose
Cell = Sequence[Inline]
"""Content of a table cell: strings, code and documentation."""


@dataclass(frozen=True, slots=True)
class Row:
    """Row of a table; with an `anchor`, it describes an element."""

    cells: tuple[Cell, ...]
    anchor: str | None = None
    kind: str = ""
    name: str = ""


@dataclass(frozen=True, slots=True)
class Table:
    """A table whose last column is documentation, if there is any."""

    title: str
    columns: tuple[Inline, ...]
    rows: tuple[Row, ...]
    is_matrix: bool = False

    def without_empty_columns(self) -> Table:
        """Return the table without columns that are empty in all rows."""
        kept = [at for at in range(len(self.columns)) if any(row.cells[at] for row in self.rows)]
        rows = tuple(
            Row(tuple(row.cells[at] for at in kept), row.anchor, row.kind, row.name)
            for row in self.rows
        )
        return Table(self.title, tuple(self.columns[at] for at in kept), rows, self.is_matrix)


@dataclass(frozen=True, slots=True)
class Figure:
    """A diagram as SVG, or the text that replaces it.

    `folded` shows it with less and less in its nodes.
    """

    title: str
    svg: Markup | None
    instead: str = ""
    folded: tuple[Markup, ...] = ()


@dataclass(frozen=True, slots=True)
class Entry:
    """Documentation of an element: its declaration as `code`, and `facts` by term.

    `note` is its origin if it is not from the project.
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
    """Entries of one kind, with an optional summary table."""

    id: str
    title: str
    entries: tuple[Entry, ...]
    table: Table | None = None

    @property
    def table_id(self) -> str:
        """Anchor of the table."""
        return f"{self.id}-table"


@dataclass(frozen=True, slots=True)
class Page:
    """Documentation of a model."""

    title: str
    doc: str
    tables: tuple[Table, ...]
    sections: tuple[Section, ...]
