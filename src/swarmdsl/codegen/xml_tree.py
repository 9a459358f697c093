"""XML files from lxml trees."""

from __future__ import annotations

from collections.abc import Iterator

from lxml import etree

from swarmdsl.base.source import Span
from swarmdsl.base.xml_writer import comment_text
from swarmdsl.codegen.source_map import Entry, MappedText

Places = dict[etree._Element, Span | None]
"""The places in a model that elements come from, with what is in them."""

# Greatest line number of libxml2.
_MOST_LINES = 65535


def add_comment(parent: etree._Element, text: str) -> None:
    """Append a comment, without `--` and a final `-`, which XML forbids."""
    if text:
        parent.append(etree.Comment(f" {comment_text(text)} "))


def document(tree: etree._Element, places: Places | None = None) -> str:
    """Return the file: declaration, two blanks a level, a newline at the end."""
    etree.indent(tree, "  ")
    text = etree.tostring(tree, encoding="unicode")
    text = f'<?xml version="1.0" encoding="UTF-8"?>\n{text}\n'
    return MappedText(text, _entries(tree, text, places)) if places else text


def _entries(tree: etree._Element, text: str, places: Places) -> Iterator[Entry]:
    """Yield the origins of lines; the line of an element is known only to a parser."""
    read = etree.fromstring(text.encode(), etree.XMLParser(huge_tree=True))
    last = 0
    for element, again in zip(tree.iter(), read.iter(), strict=True):
        line = again.sourceline or 0
        if line >= _MOST_LINES:
            return
        if element in places and line > last:
            yield Entry(line, places[element])
            last = line
