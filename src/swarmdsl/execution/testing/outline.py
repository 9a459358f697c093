"""Names and places of the tests of a file, also of one with mistakes."""

from __future__ import annotations

import re

from swarmdsl.base.diagnostics.collector import Diagnostics
from swarmdsl.base.records import dataclass
from swarmdsl.base.source import Source, Span
from swarmdsl.driver.config.toml import Document, parse_toml

_HEADER = re.compile(r"^[ \t]*\[\[[ \t]*test[ \t]*\]\]", re.MULTILINE)
_NAME = re.compile(r"""^[ \t]*name[ \t]*=[ \t]*(?:"([^"\n]*)"|'([^'\n]*)')""", re.MULTILINE)


@dataclass(frozen=True)
class Outlined:
    """A test as far as its file tells: its name, or its number as one, and where it is."""

    name: str
    place: Span


def outline(source: Source) -> list[Outlined]:
    """Return the tests of a file in their order, with the names that its readers give them.

    In a file that is no TOML, tests are found by their headers.
    """
    document = parse_toml(source, Diagnostics())
    found = _scanned(source) if document is None else _tabled(document)
    return [
        Outlined(
            name
            if isinstance(name, str) and name.strip() and name.isprintable()
            else f"test {number}",
            place,
        )
        for number, (name, place) in enumerate(found, 1)
    ]


def _tabled(document: Document) -> list[tuple[object, Span]]:
    tests = document.values.get("test")
    return [
        (
            table.get("name"),
            document.places[("test", at, "name") if "name" in table else ("test", at)].value,
        )
        for at, table in enumerate(tests if isinstance(tests, list) else ())
        if isinstance(table, dict)
    ]


def _scanned(source: Source) -> list[tuple[object, Span]]:
    headers = list(_HEADER.finditer(source.text))
    ends = [*(each.start() for each in headers), len(source.text)][1:]
    found: list[tuple[object, Span]] = []
    for header, end in zip(headers, ends, strict=True):
        name = _NAME.search(source.text, header.end(), end)
        if name is None:
            found.append((None, Span(source, header.start(), header.end())))
        else:
            group = 1 if name[1] is not None else 2
            found.append((name[group], Span(source, name.start(group) - 1, name.end(group) + 1)))
    return found
