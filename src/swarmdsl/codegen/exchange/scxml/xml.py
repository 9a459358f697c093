"""Elements of SCXML documents, in SCXML's namespace and our own."""

from __future__ import annotations

from lxml import etree

from swarmdsl.base.xml_writer import legal

SCXML = "http://www.w3.org/2005/07/scxml"
PAYLOAD = "urn:swarmdsl:scxml"


def root(nsmap: dict[str | None, str], **attributes: str | None) -> etree._Element:
    """Return the outermost element of an SCXML document."""
    # The stubs of lxml do not know that the prefix of a default namespace is None.
    return etree.Element(f"{{{SCXML}}}scxml", _given(attributes), nsmap)  # type: ignore[arg-type]


def add(parent: etree._Element, tag: str, **attributes: str | None) -> etree._Element:
    """Add an SCXML element; attributes that are None are left out."""
    return etree.SubElement(parent, f"{{{SCXML}}}{tag}", _given(attributes))


def add_payload(parent: etree._Element, tag: str, **attributes: str | None) -> etree._Element:
    """Add an element in our own namespace, for what SCXML lacks."""
    return etree.SubElement(parent, f"{{{PAYLOAD}}}{tag}", _given(attributes))


def add_doc(parent: etree._Element, text: str) -> None:
    """Add an element of documentation, if there is any."""
    if text:
        add_payload(parent, "doc").text = legal(text)


def add_text(parent: etree._Element, tag: str, text: str) -> etree._Element:
    """Add an SCXML element that contains a string."""
    element = add(parent, tag)
    element.text = legal(text)
    return element


def _given(attributes: dict[str, str | None]) -> dict[str, str]:
    return {name: legal(value) for name, value in attributes.items() if value is not None}
