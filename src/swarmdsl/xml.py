"""XML documents that are made: elements, and the text of them with the places of its lines."""

from __future__ import annotations

import re
from collections.abc import Mapping

from swarmdsl.source import Span
from swarmdsl.source_map import Entry, MappedText

DECLARATION = '<?xml version="1.0" encoding="UTF-8"?>'

# What XML 1.0 does not allow anywhere, not even escaped.
_BAD = "\x00-\x08\x0b\x0c\x0e-\x1f\ud800-\udfff\ufffe\uffff"
_ILLEGAL = re.compile(f"[{_BAD}]")
_IN_TEXT = re.compile(f"[&<>\r{_BAD}]")
_IN_VALUE = re.compile(f'[&<>"\t\n\r{_BAD}]')
# Readers make blanks of other white space, and one line end of all.
_ESCAPES = {
    "&": "&amp;",
    "<": "&lt;",
    ">": "&gt;",
    '"': "&quot;",
    "\t": "&#9;",
    "\n": "&#10;",
    "\r": "&#13;",
}


class Element:
    """An element, with a text or with what is in it: elements, and comments as strings.

    A prefix of its tag is declared by an attribute of an element around it. `origin` is the place
    in a model that it comes from; without one it belongs to what is around it.
    """

    __slots__ = ("attributes", "children", "origin", "tag", "text")

    def __init__(
        self, tag: str, given: Mapping[str, str] | None = None, /, **attributes: str | None
    ) -> None:
        """An element without contents; attributes that are None are left out."""
        self.tag = tag
        self.attributes = {name: of for name, of in attributes.items() if of is not None}
        if given is not None:
            self.attributes = {**given, **self.attributes}
        self.children: list[Element | str] = []
        self.origin: Span | None = None
        self.text = ""

    def add(
        self, tag: str, given: Mapping[str, str] | None = None, /, **attributes: str | None
    ) -> Element:
        """A new element in it."""
        made = Element(tag, given, **attributes)
        self.children.append(made)
        return made

    def add_comment(self, text: str) -> None:
        """A new comment, in which XML allows no `--` and no `-` at the end; none without a text."""
        if text:
            self.children.append(f" {re.sub('-(?=-)', '- ', legal(text))} ")


def legal(text: str) -> str:
    """The text with what XML cannot hold replaced."""
    return _ILLEGAL.sub("\N{REPLACEMENT CHARACTER}", text)


def document(root: Element, declaration: str = DECLARATION) -> MappedText:
    """The file: declaration, two spaces a level, a newline at the end."""
    lines = _Lines(declaration)
    lines.add_element(root, "", None)
    return MappedText("\n".join([*lines.written, ""]), lines.entries)


class _Lines:
    def __init__(self, first: str) -> None:
        self.written = [first]
        self.entries: list[Entry] = []
        self._next = first.count("\n") + 2

    def add_element(self, element: Element, indent: str, around: Span | None) -> None:
        """Add an element, which is in what comes from `around`."""
        origin = element.origin or around
        start = "".join(
            f' {name}="{_escaped(value, _IN_VALUE)}"' for name, value in element.attributes.items()
        )
        start = f"{indent}<{element.tag}{start}"
        if element.children:
            self._add(f"{start}>", origin)
            inner = f"{indent}  "
            for child in element.children:
                if isinstance(child, str):
                    self._add(f"{inner}<!--{child}-->", origin)
                else:
                    self.add_element(child, inner, origin)
            self._add(f"{indent}</{element.tag}>", origin)
        elif element.text:
            self._add(f"{start}>{_escaped(element.text, _IN_TEXT)}</{element.tag}>", origin)
        else:
            self._add(f"{start}/>", origin)

    def _add(self, text: str, origin: Span | None) -> None:
        if origin is not (self.entries[-1].origin if self.entries else None):
            self.entries.append(Entry(self._next, origin))
        self.written.append(text)
        self._next += text.count("\n") + 1


def _escaped(text: str, special: re.Pattern[str]) -> str:
    return special.sub(lambda found: _ESCAPES.get(found[0], "\N{REPLACEMENT CHARACTER}"), text)
