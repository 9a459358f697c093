"""What XML can hold, and documents as files."""

from __future__ import annotations

import re

from lxml import etree

# What XML 1.0 does not allow anywhere, not even escaped.
_ILLEGAL = re.compile("[\x00-\x08\x0b\x0c\x0e-\x1f\ud800-\udfff\ufffe\uffff]")


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
