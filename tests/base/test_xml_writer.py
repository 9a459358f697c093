"""The output equals that of lxml, and lxml reads it back."""

from hypothesis import given
from hypothesis import strategies as st
from lxml import etree

from swarmdsl.base.xml_writer import Element, comment_text, document, legal

TEXTS = st.text(st.sampled_from("a<>&\"'\r\n\t \x0b\ufffe\u00e9-\U0001f916]"), max_size=6)


@given(TEXTS, TEXTS)
def test_texts_and_attributes_are_escaped_as_lxml_does(text, value):
    root = Element("launch")
    root.comment(text)
    root.add("param", {"name": value, "to": "b"})
    root.add("group").add("value", text=text)

    theirs = etree.Element("launch")
    if text:
        theirs.append(etree.Comment(f" {comment_text(text)} "))
    etree.SubElement(theirs, "param", name=legal(value), to="b")
    etree.SubElement(etree.SubElement(theirs, "group"), "value").text = legal(text)
    etree.indent(theirs, "  ")
    written = document(root)
    head, _, rest = written.partition("\n")
    assert head == '<?xml version="1.0" encoding="UTF-8"?>'
    assert rest == etree.tostring(theirs, encoding="unicode") + "\n"
    assert etree.fromstring(written.encode())[-2].get("name") == legal(value)
