"""Where what a model is made of stands in the files of others.

The model that `swarmc codegen` makes on the way is shown to nobody, so that places in it mean
nothing. What it declares has the names of the files, by which it is found there again; what got
another name is not.
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

# A topic and a server are called by a text, and all else by a name.
_NAME = re.compile(r'(?:in|out|inout|action|service)\b[^"]*"([^"\\]+)"|([A-Za-z_]\w*)\Z')


class Origins:
    """The places in SCXML documents, and then in ADF files, of what a model declares."""

    def __init__(self, documents: Iterable[Source], described: Iterable[Source]) -> None:
        self._documents, self._described = tuple(documents), tuple(described)
        self._found = cache(self._look)

    def told(self, file: OutputFile) -> OutputFile:
        """A file that was made of the model, with these places in place of those of the model."""
        text = file.text
        if isinstance(text, MappedText):
            entries = (Entry(line, self._of(origin)) for line, origin in text.entries)
            text = MappedText(text, entries)
        return replace(file, text=text, origin=self._of(file.origin))

    def _of(self, declared: Span | None) -> Span | None:
        name = _NAME.match(declared.text) if declared is not None else None
        return self._found(name[1] or name[2]) if name is not None else None

    def _look(self, name: str) -> Span | None:
        # A machine begins with a capital letter in a model, which its name need not do.
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
