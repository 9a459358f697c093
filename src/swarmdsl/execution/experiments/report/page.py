"""A report as plain data, and as one HTML file.

The page has no script. Its policy allows nothing but its own style sheet, by its digest.
"""

from __future__ import annotations

from base64 import b64encode
from collections.abc import Iterable, Sequence
from dataclasses import dataclass, field
from hashlib import sha256
from pathlib import Path

from swarmdsl.base.read_files import read_text
from swarmdsl.base.xml_writer import legal

_FILES = Path(__file__).resolve().parent / "files"


@dataclass(frozen=True)
class Table:
    """Table with a head; columns of numbers, by index, are aligned to the right.

    The text in `commands`, a column by index, is something to copy.
    """

    head: Sequence[str]
    rows: Sequence[Sequence[str]]
    numbers: frozenset[int] = frozenset()
    commands: frozenset[int] = frozenset()


@dataclass(frozen=True)
class Figure:
    """Drawing as SVG, with what it shows."""

    svg: str
    caption: str


@dataclass(frozen=True)
class Section:
    """Part of a page with a title: text, tables and figures."""

    title: str
    parts: Sequence[str | Table | Figure]


@dataclass(frozen=True)
class Page:
    """Title, the conditions of all numbers by name, what follows from them, and the details."""

    title: str
    facts: Sequence[tuple[str, str]]
    answers: Sequence[str] = ()
    sections: Sequence[Section] = field(default=())


def html(page: Page) -> str:
    """Return the page as an HTML file."""
    from jinja2 import Environment, FileSystemLoader, StrictUndefined
    from markupsafe import Markup

    environment = Environment(
        loader=FileSystemLoader(_FILES),
        autoescape=True,
        trim_blocks=True,
        lstrip_blocks=True,
        undefined=StrictUndefined,
    )
    environment.tests["table"] = lambda part: isinstance(part, Table)
    environment.tests["figure"] = lambda part: isinstance(part, Figure)
    environment.filters["svg"] = Markup
    styles = read_text(_FILES / "report.css")
    text = environment.get_template("report.html.jinja").render(
        page=page,
        styles=Markup(styles),
        digest=b64encode(sha256(styles.encode()).digest()).decode(),
    )
    return legal(text)


def text_table(head: Sequence[str], rows: Iterable[Sequence[str]]) -> Table:
    """Return a table whose columns are aligned by what is in them."""
    rows = [tuple(row) for row in rows]
    columns = list(zip(*rows, strict=True))
    numbers = frozenset(at for at, column in enumerate(columns) if all(map(_is_number, column)))
    return Table(tuple(head), rows, numbers)


def _is_number(text: str) -> bool:
    return not text or text[:1] in "+-.0123456789"
