"""Elements of SCXML documents, in the two namespaces of ours."""

from __future__ import annotations

from lxml import etree

from swarmdsl.base.xml_writer import legal

SCXML = "http://www.w3.org/2005/07/scxml"
PAYLOAD = "urn:swarmdsl:scxml"


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


def add_doc(parent: etree._Element, text: str) -> None:
    """A new element of documentation, where there is any."""
    if text:
        add_payload(parent, "doc").text = legal(text)


def add_text(parent: etree._Element, tag: str, text: str) -> etree._Element:
    """A new SCXML element with text in it."""
    element = add(parent, tag)
    element.text = legal(text)
    return element


def _given(attributes: dict[str, str | None]) -> dict[str, str]:
    return {name: legal(value) for name, value in attributes.items() if value is not None}
