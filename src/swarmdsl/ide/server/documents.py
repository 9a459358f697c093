"""The texts that an editor shows, changed as it tells.

Those of pygls would do but for one thing: they end lines at each character where Python does, and
the protocol does so at three ends only, so that what is typed behind another one got to the wrong
place.
"""

from __future__ import annotations

import re
from collections.abc import Iterable

from lsprotocol import types as lsp

from swarmdsl.ide.server.positions import units

# Source: LSP 3.17, "Text Documents".
_LINE_END = re.compile(r"\r\n|\n|\r")


class Document:
    """The text of one file as an editor shows it, with its ends of lines."""

    def __init__(self, text: str, version: int) -> None:
        self.text = text
        self.version = version

    def change(self, changes: Iterable[lsp.TextDocumentContentChangeEvent], encoding: str) -> None:
        """Replace the whole text, or parts of it; one after the other."""
        for each in changes:
            if isinstance(each, lsp.TextDocumentContentChangeWholeDocument):
                self.text = each.text
                continue
            first = self._offset(each.range.start, encoding)
            last = self._offset(each.range.end, encoding)
            self.text = self.text[:first] + each.text + self.text[max(first, last) :]

    def _offset(self, at: lsp.Position, encoding: str) -> int:
        start = self._line_start(at.line)
        found = _LINE_END.search(self.text, start)
        end = found.start() if found is not None else len(self.text)
        text = self.text[start:end]
        if encoding == "utf-32" or text.isascii():
            return start + min(at.character, len(text))
        count = 0
        for index, each in enumerate(text):
            if count >= at.character:
                return start + index
            count += units(each, encoding)
        return end

    def _line_start(self, line: int) -> int:
        if "\r" in self.text:
            ends = _LINE_END.finditer(self.text)
            found = next((end for count, end in enumerate(ends, 1) if count >= line), None)
            return 0 if line <= 0 else found.end() if found is not None else len(self.text)
        rows = self.text.split("\n", max(line, 0))
        return len(self.text) - (len(rows[-1]) if len(rows) > line else 0)
