"""Small documents of XML as text, without lxml, which takes longer to import than to check a model.

It is for what is only written; what is read, looked up or compared is for lxml.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping

# What XML 1.0 does not allow anywhere, not even escaped.
_ILLEGAL = "[\x00-\x08\x0b\x0c\x0e-\x1f\ud800-\udfff\ufffe\uffff]"
# What a parser would take for markup, or for another blank (XML 1.0, 2.11 and 3.3.3).
_IN_TEXT = str.maketrans({"&": "&amp;", "<": "&lt;", ">": "&gt;", "\r": "&#13;"})
_IN_ATTRIBUTE = {**_IN_TEXT, **str.maketrans({'"': "&quot;", "\n": "&#10;", "\t": "&#9;"})}


class Element:
    """An element with its attributes, and either a text or other elements and comments in it."""

    def __init__(
        self, tag: str, attributes: Mapping[str, str] | None = None, text: str | None = None
    ) -> None:
        self.tag = tag
        self.attributes = dict(attributes or {})
        self.text = text
        self.inside: list[Element | str] = []

    def add(
        self, tag: str, attributes: Mapping[str, str] | None = None, text: str | None = None
    ) -> Element:
        """A new element inside, after what is there."""
        made = Element(tag, attributes, text)
        self.inside.append(made)
        return made

    def comment(self, text: str) -> None:
        """A new comment inside, if there is anything to say."""
        if text:
            self.inside.append(f"<!-- {comment_text(text)} -->")


def document(root: Element, declaration: str = '<?xml version="1.0" encoding="UTF-8"?>') -> str:
    """The file: declaration, two spaces a level, a newline at the end."""
    return "".join(f"{line}\n" for line in (declaration, *_lines(root)))


def legal(text: str) -> str:
    """The text with what XML cannot hold replaced."""
    if text.isprintable():
        return text
    return re.sub(_ILLEGAL, "\N{REPLACEMENT CHARACTER}", text)


def comment_text(text: str) -> str:
    """The text as a comment can hold it, in which XML allows no `--` and no `-` at the end."""
    return re.sub("-(?=-)", "- ", legal(text))


def _lines(element: Element) -> Iterator[str]:
    words = [
        f'{name}="{legal(value).translate(_IN_ATTRIBUTE)}"'
        for name, value in element.attributes.items()
    ]
    start = " ".join([element.tag, *words])
    if element.text is not None:
        yield f"<{start}>{legal(element.text).translate(_IN_TEXT)}</{element.tag}>"
    elif not element.inside:
        yield f"<{start}/>"
    else:
        yield f"<{start}>"
        for inner in element.inside:
            for line in (inner,) if isinstance(inner, str) else _lines(inner):
                yield f"  {line}"
        yield f"</{element.tag}>"
