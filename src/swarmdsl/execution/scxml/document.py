"""Parse SCXML files into elements with spans; never read other files."""

from __future__ import annotations

import re
from bisect import bisect_right
from collections.abc import Collection, Iterator
from xml.parsers import expat

from swarmdsl.base.diagnostics.collector import Diagnostics
from swarmdsl.base.source import Source, Span

SCXML = "http://www.w3.org/2005/07/scxml"

_ATTRIBUTE = re.compile(r"""\s+([^\s=/>]+)\s*=\s*("[^"]*"|'[^']*')""")
_NAME = re.compile(r"[^\s/>]+")
_WORD = re.compile(r"\S+")
_NOT_ASCII = re.compile(r"[^\x00-\x7f]")
_DOCTYPE = "<!DOCTYPE"
_DEEPEST = 250
_LONGEST = 1_000_000
"""Maximum length of an attribute or text: expressions take hundreds of times as much memory."""


Place = tuple[int, int]


class Node:
    """Element without the SCXML namespace in its name and attributes.

    `children` are SCXML elements and `ours` those of swarmdsl, after the vocabulary check.
    Attributes in other namespaces are dropped. `comment` is the preceding comment.
    """

    __slots__ = (
        *("attributes", "children", "comment", "get", "line", "name", "namespace", "ours"),
        *("parent", "start", "text"),
    )

    def __init__(
        self, qualified: str, attributes: dict[str, str], parent: Node | None, start: int, line: int
    ) -> None:
        self.namespace, _, self.name = qualified.rpartition("}")
        self.attributes = attributes
        self.get = attributes.get
        self.parent = parent
        self.start = start
        self.line = line
        self.text = ""
        self.comment = ""
        self.children: list[Node] = []
        self.ours: tuple[Node, ...] = ()

    def walk(self) -> Iterator[Node]:
        """Yield the node and all inside it, in document order."""
        waiting = [self]
        while waiting:
            node = waiting.pop()
            yield node
            waiting += reversed(node.children)


class Document:
    """A file and its root element."""

    def __init__(self, source: Source, root: Node) -> None:
        self.source = source
        self.root = root
        # Ends of multi-byte characters.
        self.wide = [] if source.text.isascii() else list(_wide(source.text))
        # By the offset of an element: its attributes, and the words in those that were asked for.
        self._attributes: dict[int, dict[str, Place]] = {}
        self._words: dict[tuple[int, str], dict[str, Place]] = {}

    def at(self, node: Node, attribute: str = "", word: str = "") -> Span:
        """Return the span of an element name, attribute value or word in the value."""
        text = self.source.text
        start = node.start - bisect_right(self.wide, node.start) + 1
        named = _NAME.match(text, start)
        assert named is not None
        place = self._attributes_at(named.end()).get(attribute) if attribute else None
        if place is None:
            return Span(self.source, *named.span())
        if word:
            place = self._words_in(named.end(), attribute, place).get(word, place)
        return Span(self.source, *place)

    def _attributes_at(self, start: int) -> dict[str, Place]:
        """Return the values of the attributes behind the name of an element; the first counts."""
        if start not in self._attributes:
            found: dict[str, Place] = {}
            given = _ATTRIBUTE.match(self.source.text, start)
            while given is not None:
                name = given[1].rpartition(":")[2]
                found.setdefault(name, (given.start(2) + 1, given.end(2) - 1))
                given = _ATTRIBUTE.match(self.source.text, given.end())
            self._attributes[start] = found
        return self._attributes[start]

    def _words_in(self, start: int, attribute: str, place: Place) -> dict[str, Place]:
        """Return the words of a value, which can be thousands; of equal ones the first counts."""
        key = (start, attribute)
        if key not in self._words:
            found: dict[str, Place] = {}
            for word in _WORD.finditer(self.source.text, *place):
                found.setdefault(word[0], word.span())
            self._words[key] = found
        return self._words[key]


def parse(
    source: Source, report: Diagnostics, namespaces: Collection[str] = (SCXML,)
) -> Document | None:
    """Parse a file; None if it is not SCXML, which is reported.

    The root element must be in one of the namespaces; "" stands for none. A document type is an
    error, because its entities could grow without limit or read other files.
    """
    builder = _Builder()
    parser = builder.parser
    try:
        parser.Parse(source.text.encode("utf-8"), True)
    except _DocumentType:
        # Comments before it may mention document types, but nothing is in between.
        end = _characters(source.text, builder.reached) + len(_DOCTYPE)
        start = source.text.rfind(_DOCTYPE, 0, end)
        place = Span(source, start, start + len(_DOCTYPE))
        report.report("xml-document-type", place, help="remove it: SCXML needs none")
        return None
    except _TooLarge as fault:
        start = _characters(source.text, builder.reached)
        report.report("not-xml", Span(source, start, start + 1), reason=str(fault))
        return None
    except expat.ExpatError as error:
        start = min(_characters(source.text, parser.ErrorByteIndex), len(source.text))
        place = Span(source, start, min(start + 1, len(source.text)))
        is_json = source.text.lstrip()[:1] in ("{", "[")
        help_ = "it looks like JSON: `swarmc import adf` or `amf` reads that" if is_json else None
        report.report("not-xml", place, reason=expat.ErrorString(error.code), help=help_)
        return None
    assert builder.root is not None
    document = Document(source, builder.root)
    if builder.root.name != "scxml" or builder.root.namespace not in namespaces:
        report.report(
            "not-scxml",
            document.at(builder.root),
            name=builder.root.name,
            help=f'it begins with `<scxml xmlns="{SCXML}" version="1.0">`',
        )
        return None
    return document


class _DocumentType(Exception):  # noqa: N818 - it only ends the parser
    """A document type was found."""


class _TooLarge(Exception):  # noqa: N818 - it only ends the parser
    """The elements are nested too deeply, or have too much text."""


class _Builder:
    """Builder of the nodes of a file."""

    def __init__(self) -> None:
        self.root: Node | None = None
        self.inside: list[Node] = []
        self.reached = 0
        # Parts of the text of the elements in `inside`, and of the comment before the next one.
        self.texts: list[list[str]] = []
        self.comments: list[str] = []
        self.parser = parser = expat.ParserCreate("utf-8", "}")
        parser.buffer_text = True
        parser.StartElementHandler = self.start
        parser.EndElementHandler = self.end
        parser.CharacterDataHandler = self.add_text
        parser.StartDoctypeDeclHandler = self.refuse
        parser.CommentHandler = self.add_comment

    def start(self, name: str, attributes: dict[str, str]) -> None:
        inside = self.inside
        parent = inside[-1] if inside else None
        for each in attributes:
            if "}" in each:
                attributes = _without_namespace(attributes)
                break
        parser = self.parser
        node = Node(name, attributes, parent, parser.CurrentByteIndex, parser.CurrentLineNumber)
        if self.comments:
            node.comment = "\n".join(self.comments)
            self.comments = []
        if parent is None:
            self.root = node
        else:
            parent.children.append(node)
        inside.append(node)
        self.texts.append([])
        self.reached = parser.CurrentByteIndex
        if len(inside) > _DEEPEST:
            raise _TooLarge(f"elements are nested more than {_DEEPEST} levels deep")
        for name, value in attributes.items():
            if len(value) > _LONGEST:
                raise _TooLarge(f"attribute `{name}` has more than {_LONGEST:,} characters")

    def end(self, name: str) -> None:
        node, parts = self.inside.pop(), self.texts.pop()
        if parts:
            node.text = "".join(parts)
            if len(node.text) > _LONGEST:
                self.reached = node.start
                raise _TooLarge(f"an element has more than {_LONGEST:,} characters of text")
        self.comments = []

    def add_comment(self, text: str) -> None:
        plain = text[1:-1] if text[:1] == text[-1:] == " " else text.strip()
        if plain or self.comments:
            self.comments.append(plain)

    def add_text(self, text: str) -> None:
        # White space matters inside of text only: after a comment, say.
        if self.texts[-1] or not text.isspace():
            self.texts[-1].append(text)

    def refuse(self, *declared: object) -> None:
        self.reached = self.parser.CurrentByteIndex
        raise _DocumentType


def _without_namespace(attributes: dict[str, str]) -> dict[str, str]:
    """Return the SCXML attributes by local name."""
    return {
        name.rpartition("}")[2]: value
        for name, value in attributes.items()
        if "}" not in name or name.startswith(f"{SCXML}}}")
    }


def _wide(text: str) -> Iterator[int]:
    """Yield the end of each multi-byte character, once per extra byte."""
    offset = 0
    for found in _NOT_ASCII.finditer(text):
        more = len(found[0].encode("utf-8")) - 1
        end = found.end() + offset + more
        offset += more
        yield from [end] * more


def _characters(text: str, offset: int) -> int:
    """Convert a byte offset to a character offset."""
    return offset if text.isascii() else len(text.encode("utf-8")[:offset].decode("utf-8"))
