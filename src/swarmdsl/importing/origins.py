"""Map locations in an intermediate model to the files that it was imported from.

The user never sees the intermediate model of `swarmc codegen`. Its declarations are found in the
imported files by name; renamed ones are not found.
"""

from __future__ import annotations

import json
import re
from collections.abc import Iterable
from functools import cached_property

from swarmdsl.base.records import replace
from swarmdsl.base.source import Source, Span
from swarmdsl.codegen.api import OutputFile
from swarmdsl.codegen.source_map import Entry, MappedText

# Topics and servers are string literals, everything else has an identifier.
_NAME = re.compile(r'(?:in|out|inout|action|service)\b[^"]*"([^"\\]+)"|([A-Za-z_]\w*)\Z')
_ELEMENT = re.compile(r"""\b(?:id|name)\s*=\s*("[^"]*"|'[^']*')""")
_STRING = re.compile(r'"(?:[^"\\]|\\.)*"')


class Origins:
    """Locations of declarations in SCXML documents, then in ADF files."""

    def __init__(self, documents: Iterable[Source], described: Iterable[Source]) -> None:
        self._documents, self._described = tuple(documents), tuple(described)

    def relocate(self, file: OutputFile) -> OutputFile:
        """Replace locations in the model by locations in the imported files."""
        text = file.text
        if isinstance(text, MappedText):
            entries = (Entry(line, self._of(origin)) for line, origin in text.entries)
            text = MappedText(text, entries)
        return replace(file, text=text, origin=self._of(file.origin))

    def _of(self, declared: Span | None) -> Span | None:
        name = _NAME.match(declared.text) if declared is not None else None
        return self._find(name[1] or name[2]) if name is not None else None

    def _find(self, name: str) -> Span | None:
        # The model capitalizes the name of a machine, so a second look ignores case.
        elements, in_any_case = self._elements
        quoted = json.dumps(name, ensure_ascii=False)
        known = elements.get(name) or in_any_case.get(name.lower())
        return known or self._strings.get(quoted)

    @cached_property
    def _elements(self) -> tuple[dict[str, Span], dict[str, Span]]:
        """The first place of each name in the documents, and of each name in lower case."""
        found: dict[str, Span] = {}
        in_lower_case: dict[str, Span] = {}
        for source in self._documents:
            for given in _ELEMENT.finditer(source.text):
                start, end = given.start(1) + 1, given.end(1) - 1
                place = Span(source, start, end)
                found.setdefault(source.text[start:end], place)
                in_lower_case.setdefault(source.text[start:end].lower(), place)
        return found, in_lower_case

    @cached_property
    def _strings(self) -> dict[str, Span]:
        """The first place of each string in the descriptions."""
        found: dict[str, Span] = {}
        for source in self._described:
            for given in _STRING.finditer(source.text):
                found.setdefault(given[0], Span(source, given.start() + 1, given.end() - 1))
        return found
