"""Open documents, with incremental changes.

pygls splits lines like `str.splitlines`, the protocol only at three line ends. With pygls, an edit
after another separator (such as U+2028) ends up in the wrong place.
"""

from __future__ import annotations

import re
from collections.abc import Iterable

from lsprotocol import types as lsp

from swarmdsl.ide.server.positions import units

# Source: LSP 3.17, "Text Documents".
_LINE_END = re.compile(r"\r\n|\n|\r")


class Document:
    """Text of an open file, with its original line ends.

    `typed_line` is the line at the end of the last change, None if it is not being typed.
    """

    def __init__(self, text: str, version: int) -> None:
        self.text = text
        self.version = version
        self.typed_line: int | None = None

    def change(self, changes: Iterable[lsp.TextDocumentContentChangeEvent], encoding: str) -> None:
        """Apply changes of the whole text or of ranges, in order."""
        for each in changes:
            if isinstance(each, lsp.TextDocumentContentChangeWholeDocument):
                self.text = each.text
                self.typed_line = None
                continue
            start = self._offset(each.range.start, encoding)
            end = self._offset(each.range.end, encoding)
            self.text = self.text[:start] + each.text + self.text[max(start, end) :]
            self.typed_line = self.text.count("\n", 0, start + len(each.text))

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
