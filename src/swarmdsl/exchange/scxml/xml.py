"""XML elements in the two namespaces of our files, and files as text."""

from __future__ import annotations

import re

from lxml import etree

SCXML = "http://www.w3.org/2005/07/scxml"
PAYLOAD = "urn:swarmdsl:scxml"

# What XML 1.0 does not allow anywhere, not even escaped.
_ILLEGAL = re.compile("[^\t\n\r\x20-\ud7ff\ue000-\ufffd\U00010000-\U0010ffff]")


def root(nsmap: dict[str | None, str], **attributes: str | None) -> etree._Element:
    """The outermost element of an SCXML document."""
    # The stubs of lxml do not know that the prefix of a default namespace is None.
    return etree.Element(f"{{{SCXML}}}scxml", _given(attributes), nsmap)  # type: ignore[arg-type]


def add(parent: etree._Element, tag: str, **attributes: str | None) -> etree._Element:
    """A new SCXML element; attributes that are None are left out."""
    return etree.SubElement(parent, f"{{{SCXML}}}{tag}", _given(attributes))


def add_payload(parent: etree._Element, tag: str, **attributes: str | None) -> etree._Element:
    """A new element of what SCXML has no words for, in our own namespace."""
    return etree.SubElement(parent, f"{{{PAYLOAD}}}{tag}", _given(attributes))


def add_text(parent: etree._Element, tag: str, text: str) -> etree._Element:
    """A new SCXML element with text in it."""
    element = add(parent, tag)
    element.text = legal(text)
    return element


def add_comment(parent: etree._Element, text: str) -> None:
    """A new comment, in which XML allows no `--` and no `-` at the end."""
    if text:
        parent.append(etree.Comment(f" {re.sub('-(?=-)', '- ', legal(text))} "))


def legal(text: str) -> str:
    """The text with what XML cannot hold replaced."""
    return _ILLEGAL.sub("\N{REPLACEMENT CHARACTER}", text)


def document(tree: etree._Element) -> str:
    """The file: declaration, two spaces a level, a newline at the end."""
    etree.indent(tree, "  ")
    text = etree.tostring(tree, encoding="unicode")
    return f'<?xml version="1.0" encoding="UTF-8"?>\n{text}\n'


def _given(attributes: dict[str, str | None]) -> dict[str, str]:
    return {name: legal(value) for name, value in attributes.items() if value is not None}
