"""The texts that an editor shows, changed as it tells."""

from __future__ import annotations

import re
from collections.abc import Iterable
from typing import Any

from swarmdsl.server.positions import units

# As the protocol has it: other characters that end lines for Python do not.
_LINE_END = re.compile(r"\r\n|\n|\r")


class Document:
    """The text of one file as an editor shows it, with its ends of lines."""

    def __init__(self, text: str, version: int | None) -> None:
        self.text = text
        self.version = version

    def change(self, changes: Iterable[Any], encoding: str) -> None:
        """Replace the whole text, or parts of it; one after the other."""
        for each in changes:
            text = each["text"]
            if not isinstance(text, str):
                raise TypeError("the text of a change is no text")
            if each.get("range") is None:
                self.text = text
                continue
            start, end = each["range"]["start"], each["range"]["end"]
            first, last = self._offset(start, encoding), self._offset(end, encoding)
            self.text = self.text[:first] + text + self.text[max(first, last) :]

    def _offset(self, at: Any, encoding: str) -> int:
        line, character = int(at["line"]), int(at["character"])
        start = self._line_start(line)
        found = _LINE_END.search(self.text, start)
        end = found.start() if found is not None else len(self.text)
        text = self.text[start:end]
        if encoding == "utf-32" or text.isascii():
            return start + min(max(character, 0), len(text))
        count = 0
        for index, each in enumerate(text):
            if count >= character:
                return start + index
            count += units(each, encoding)
        return end

    def _line_start(self, line: int) -> int:
        if "\r" in self.text:
            ends = _LINE_END.finditer(self.text)
            found = next((end for count, end in enumerate(ends, 1) if count >= line), None)
            return 0 if line <= 0 else found.end() if found is not None else len(self.text)
        start = 0
        for _ in range(line):
            start = self.text.find("\n", start) + 1
            if not start:
                return len(self.text)
        return start
