"""Writer of small XML documents, without lxml, whose import takes longer than a check.

`xml.etree.ElementTree` writes `<a />` for `<a/>`, keeps carriage returns in text, and lets
characters through that XML does not allow; the output would differ from that of lxml.
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
    """Element with attributes, and with either text or other elements and comments."""

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
        """Append a new element."""
        made = Element(tag, attributes, text)
        self.inside.append(made)
        return made

    def comment(self, text: str) -> None:
        """Append a comment, unless it is empty."""
        if text:
            self.inside.append(f"<!-- {comment_text(text)} -->")


def document(root: Element, declaration: str = '<?xml version="1.0" encoding="UTF-8"?>') -> str:
    """Return the file: declaration, two spaces a level, a newline at the end."""
    return "".join(f"{line}\n" for line in (declaration, *_lines(root)))


def legal(text: str) -> str:
    """Replace characters that XML does not allow."""
    if text.isprintable():
        return text
    return re.sub(_ILLEGAL, "\N{REPLACEMENT CHARACTER}", text)


def comment_text(text: str) -> str:
    """Return a text that a comment can hold: without `--` and without `-` at the end."""
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
