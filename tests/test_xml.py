"""XML documents that are made are read by others as they were meant."""

from lxml import etree

from swarmdsl.source import Source, Span
from swarmdsl.xml import Element, document

PARSER = etree.XMLParser(huge_tree=True)
MODEL = Source("a model", "abc")
CHARACTERS = " <>&'\"\t\n-\u00e9\u2028\U0001f41d"


def read(root):
    return etree.fromstring(document(root).encode(), PARSER)


def test_texts_and_attributes_are_read_as_they_were_written():
    root = Element("a", {"class": CHARACTERS}, left_out=None, b="\r")
    root.add("c").text = f"{CHARACTERS}]]>"
    again = read(root)
    assert dict(again.attrib) == {"class": CHARACTERS, "b": "\r"}
    assert again[0].text == f"{CHARACTERS}]]>"


def test_what_xml_cannot_hold_is_replaced():
    root = Element("a", b="1\x002")
    root.text = "3\ud8004\uffff"
    again = read(root)
    assert (again.get("b"), again.text) == ("1\ufffd2", "3\ufffd4\ufffd")


def test_comments_hold_what_looks_like_their_end():
    root = Element("a")
    root.add_comment("one --> two ---")
    root.add_comment("")
    assert [child.text for child in read(root)] == [" one - -> two - - - "]


def test_lines_come_from_the_element_that_they_are_of():
    places = [Span(MODEL, start, start + 1) for start in range(3)]
    root = Element("a")
    first = root.add("b")
    first.origin = places[0]
    first.add_comment("of two\nlines")
    first.add("c").text = "of\nthree\nlines"
    second = first.add("d")
    second.origin = places[1]
    root.add("e")
    root.add("f").origin = places[2]
    text = document(root)
    lines = text.splitlines()
    found = [(lines[line - 1].strip(), origin) for line, origin in text.entries]
    assert found == [
        ("<b>", places[0]),
        ("<d/>", places[1]),
        ("</b>", places[0]),
        ("<e/>", None),
        ("<f/>", places[2]),
        ("</a>", None),
    ]
