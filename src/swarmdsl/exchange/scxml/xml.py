"""The namespaces of SCXML documents, and elements in ours."""

from __future__ import annotations

from swarmdsl.xml import Element

SCXML = "http://www.w3.org/2005/07/scxml"
PAYLOAD = "urn:swarmdsl:scxml"
_PREFIX = "sw"
NAMESPACES = {"xmlns": SCXML, f"xmlns:{_PREFIX}": PAYLOAD}


def add_payload(parent: Element, tag: str, /, **attributes: str | None) -> Element:
    """A new element of what SCXML has no words for, in our own namespace."""
    return parent.add(f"{_PREFIX}:{tag}", **attributes)


def add_doc(parent: Element, text: str) -> None:
    """A new element of documentation, where there is any."""
    if text:
        add_payload(parent, "doc").text = text
