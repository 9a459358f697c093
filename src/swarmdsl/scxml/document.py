"""SCXML files to elements that know their places; nothing outside of the text is ever read."""

from __future__ import annotations

import re
from collections.abc import Iterator
from functools import cached_property
from xml.parsers import expat

from lxml import etree

from swarmdsl.diagnostics import Diagnostics
from swarmdsl.source import Source, Span

SCXML = "http://www.w3.org/2005/07/scxml"
Element = etree._Element

_ATTRIBUTE = re.compile(r"""\s+([^\s=/>]+)\s*=\s*("[^"]*"|'[^']*')""")


class Document:
    """The elements of a file, without comments and processing instructions."""

    def __init__(self, source: Source, root: Element) -> None:
        self.source = source
        self.root = root

    def at(self, element: Element, attribute: str = "", word: str = "") -> Span:
        """The name of an element, or the value of its attribute, or a word of that."""
        text = self.source.text
        start = self._starts[element] + 1
        named = re.compile(r"[^\s/>]+").match(text, start)
        assert named is not None
        end = named.end()
        given = _ATTRIBUTE.match(text, end) if attribute else None
        while given is not None:
            if given[1].rpartition(":")[2] == attribute:
                start, end = given.start(2) + 1, given.end(2) - 1
                found = re.compile(rf"(?<!\S){re.escape(word)}(?!\S)").search(text, start, end)
                return Span(self.source, *(found.span() if word and found else (start, end)))
            given = _ATTRIBUTE.match(text, given.end())
        return Span(self.source, named.start(), end)

    @cached_property
    def _starts(self) -> dict[Element, int]:
        """Where each element begins: lxml knows lines only."""
        data = self.source.text.encode("utf-8")
        found: list[int] = []
        parser = expat.ParserCreate("utf-8")
        parser.StartElementHandler = lambda *_: found.append(parser.CurrentByteIndex)
        parser.Parse(data, True)
        starts: dict[Element, int] = {}
        offset = characters = 0
        for element, start in zip(self.root.iter(), found, strict=True):
            characters += len(data[offset:start].decode("utf-8"))
            offset = start
            starts[element] = characters
        return starts


def parse(source: Source, report: Diagnostics) -> Document | None:
    """Parse a file; None when it is no SCXML, which has been reported then.

    A document type could define entities, which grow beyond all bounds or stand for other
    files: there must be none.
    """
    prolog = _prolog_end(source.text)
    if source.text.startswith("<!DOCTYPE", prolog):
        place = Span(source, prolog, prolog + len("<!DOCTYPE"))
        report.report("xml-document-type", place, help="remove it: SCXML needs none")
        return None
    parser = etree.XMLParser(
        encoding="utf-8",
        resolve_entities=False,
        no_network=True,
        load_dtd=False,
        remove_comments=True,
        remove_pis=True,
    )
    try:
        root = etree.fromstring(source.text.encode("utf-8"), parser)
    except etree.XMLSyntaxError as error:
        report.report("not-xml", _place(source, error), reason=_reason(error))
        return None
    document = Document(source, root)
    if root.tag != f"{{{SCXML}}}scxml":
        report.report(
            "not-scxml",
            document.at(root),
            name=etree.QName(root).localname,
            help=f'it begins with `<scxml xmlns="{SCXML}" version="1.0">`',
        )
        return None
    return document


def children(element: Element) -> Iterator[tuple[str, Element]]:
    """The SCXML elements directly inside one, with their names."""
    for child in element:
        namespace, _, name = child.tag.rpartition("}")
        if namespace[1:] == SCXML:
            yield name, child


def _prolog_end(text: str) -> int:
    """Where the declaration, comments and instructions at the beginning of a file end."""
    at = 0
    while True:
        at += len(text[at:]) - len(text[at:].lstrip("\ufeff \t\r\n"))
        for opening, closing in (("<?", "?>"), ("<!--", "-->")):
            if text.startswith(opening, at):
                end = text.find(closing, at)
                if end < 0:
                    return at
                at = end + len(closing)
                break
        else:
            return at


def _place(source: Source, error: etree.XMLSyntaxError) -> Span:
    line, column = error.position
    starts = source.line_starts
    start = starts[min(max(line, 1), len(starts)) - 1] + max(column - 1, 0)
    start = min(start, max(len(source.text) - 1, 0))
    return Span(source, start, min(start + 1, len(source.text)))


def _reason(error: etree.XMLSyntaxError) -> str:
    """What lxml says, without the place at its end."""
    text = re.sub(r",? line \d+, column \d+.*", "", str(error.msg or "it is empty"))
    return text[:1].lower() + text[1:]
