"""Repair nearly valid XML of exporters and manual edits."""

from __future__ import annotations

import re
from functools import partial

from swarmdsl.base.diagnostics.collector import Diagnostics
from swarmdsl.base.source import Source, Span
from swarmdsl.execution.scxml.document import SCXML, Document, parse

# Repairs keep the length of the text, so that locations stay valid: the quote that the Modelio
# exporter forgets replaces a blank at the start of the next line.
_REPAIRS = (
    (
        re.compile(r'(<(?:parallel|state|final)\s+id\s*=\s*"[^"<>\r\n]*)>(\r?\n)[ \t]'),
        r'\1">\2',
        'the closing `"` of the id is missing',
    ),
    (
        re.compile(r"[ \t]<state>(?=\s*(?:<state\s|<parallel\s|</))"),
        "</state>",
        "`<state>` is used instead of `</state>`",
    ),
    (
        re.compile(r"&(?!amp;|lt;|gt;|quot;|apos;|#)\w+;"),
        " ",
        "XML has no such entity",
    ),
    (
        re.compile(r"</?(?:html|body|head|br|p|b|i|u|em|font|span|div)(?:\s[^<>]*)?/?>", re.I),
        " ",
        "this is HTML",
    ),
)


def read(source: Source, report: Diagnostics) -> Document | None:
    """Parse a file, with repairs if necessary; None if they do not help.

    Repairs are reported; otherwise, the errors of the original text.
    """
    found = Diagnostics()
    document = _parsed(source, found)
    if document is not None:
        report.include(found)
        return document
    text = source.text
    repairs = Diagnostics()
    for pattern, replacement, fault in _REPAIRS:
        for match in pattern.finditer(text):
            place = Span(source, *match.span())
            repairs.report("malformed-xml", _trimmed(place), fault=fault)
        text = pattern.sub(partial(_same_length, replacement), text)
    repaired = _parsed(Source(source.name, text, source.path), repairs) if repairs else None
    report.include(found if repaired is None else repairs)
    return repaired


def _parsed(source: Source, report: Diagnostics) -> Document | None:
    """Parse a file; elements without a namespace count as SCXML, with a warning."""
    document = parse(source, report, (SCXML, ""))
    if document is not None and not document.root.namespace:
        fault = "the namespace of SCXML is missing"
        report.report("repaired-dialect", document.at(document.root), fault=fault)
        for node in document.root.walk():
            node.namespace = node.namespace or SCXML
    return document


def _same_length(replacement: str, match: re.Match[str]) -> str:
    new = match.expand(replacement)
    return new.ljust(len(match[0])) if new.strip() else re.sub(r"[^\r\n]", " ", match[0])


def _trimmed(place: Span) -> Span:
    text = place.text
    first = len(text) - len(text.lstrip())
    return Span(place.source, place.start + first, place.start + len(text.rstrip()))
