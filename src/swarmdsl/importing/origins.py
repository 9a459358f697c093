"""Map locations in an intermediate model to the files that it was imported from.

The user never sees the intermediate model of `swarmc codegen`. Its declarations are found in the
imported files by name; renamed ones are not found.
"""

from __future__ import annotations

import json
import re
from collections.abc import Iterable
from functools import cache

from swarmdsl.base.records import replace
from swarmdsl.base.source import Source, Span
from swarmdsl.codegen.api import OutputFile
from swarmdsl.codegen.source_map import Entry, MappedText

# Topics and servers are string literals, everything else has an identifier.
_NAME = re.compile(r'(?:in|out|inout|action|service)\b[^"]*"([^"\\]+)"|([A-Za-z_]\w*)\Z')


class Origins:
    """Locations of declarations in SCXML documents, then in ADF files."""

    def __init__(self, documents: Iterable[Source], described: Iterable[Source]) -> None:
        self._documents, self._described = tuple(documents), tuple(described)
        self._found = cache(self._search)

    def relocate(self, file: OutputFile) -> OutputFile:
        """Replace locations in the model by locations in the imported files."""
        text = file.text
        if isinstance(text, MappedText):
            entries = (Entry(line, self._of(origin)) for line, origin in text.entries)
            text = MappedText(text, entries)
        return replace(file, text=text, origin=self._of(file.origin))

    def _of(self, declared: Span | None) -> Span | None:
        name = _NAME.match(declared.text) if declared is not None else None
        return self._found(name[1] or name[2]) if name is not None else None

    def _search(self, name: str) -> Span | None:
        # The model capitalizes the name of a machine, so a second search ignores case.
        of_element = rf"""\b(?:id|name)\s*=\s*(["']){re.escape(name)}\1"""
        for flags in (re.RegexFlag(0), re.IGNORECASE):
            for source in self._documents:
                if (found := re.search(of_element, source.text, flags)) is not None:
                    return Span(source, found.end() - 1 - len(name), found.end() - 1)
        quoted = json.dumps(name, ensure_ascii=False)
        for source in self._described:
            if (start := source.text.find(quoted)) >= 0:
                return Span(source, start + 1, start + len(quoted) - 1)
        return None
