"""Source text with repairs, and a map from its characters back to the source."""

from __future__ import annotations

import re
from collections.abc import Sequence
from typing import Any, NamedTuple

from swarmdsl.base.records import dataclass, fields_of
from swarmdsl.base.source import Source, Span
from swarmdsl.syntax.ast import Expression, Node, Ref, Word

_WORD = r"[A-Za-z_][A-Za-z0-9_]*"


class Repair(NamedTuple):
    """Replacement of a range of the text that lets the parser read what is around it."""

    start: int
    end: int
    text: str


@dataclass(frozen=True, slots=True)
class PatchedText:
    """Repaired text.

    `origins` are the offsets in the source of its characters and of its end. Inserted characters
    have the offset at which they were inserted.
    """

    text: str
    origins: Sequence[int]

    @classmethod
    def of(cls, text: str) -> PatchedText:
        """Return a text without repairs."""
        return cls(text, range(len(text) + 1))

    def piece(self, start: int, end: int) -> PatchedText:
        """Return the text between two offsets."""
        return PatchedText(self.text[start:end], self.origins[start : end + 1])

    def repaired(self, *repairs: Repair) -> PatchedText:
        """Apply more repairs, which are sorted; of overlapping ones only the first."""
        texts: list[str] = []
        origins: list[int] = []
        done = 0
        for start, end, text in repairs:
            if start < done:
                continue
            first, last = self.origins[start], self.origins[end]
            texts += (self.text[done:start], text)
            origins += self.origins[done:start]
            origins += (min(first + at, last) for at in range(len(text)))
            done = end
        return PatchedText("".join([*texts, self.text[done:]]), [*origins, *self.origins[done:]])

    def blanked(self, start: int, end: int) -> PatchedText:
        """Replace a range by spaces, except for line breaks."""
        return PatchedText(
            self.text[:start] + re.sub(r"[^\n]", " ", self.text[start:end]) + self.text[end:],
            self.origins,
        )

    def restore(self, node: Node, source: Source) -> set[Expression]:
        """Map all spans of a tree that was parsed from this text to the source.

        Return the expressions with a repair in them: they differ from the source.
        """
        repaired: set[Expression] = set()
        self._restore(node, source, repaired)
        return repaired

    def _restore(self, value: Any, source: Source, repaired: set[Expression]) -> Any:
        if isinstance(value, (list, tuple)):
            return type(value)(self._restore(item, source, repaired) for item in value)
        if isinstance(value, Word):
            span = self._place(value.span, source)
            if value.strip("_") or not re.fullmatch(_WORD, value):
                return Word(value, span)
            # A placeholder, for a keyword of the same length or for nothing.
            return Word(span.text if re.fullmatch(_WORD, span.text) else f"_{span.start}", span)
        if isinstance(value, Ref):
            value.span = self._place(value.span, source)
        elif isinstance(value, Node):
            span = self._place(value.span, source)
            if isinstance(value, Expression) and span.text != value.span.text:
                repaired.add(value)
            for name in fields_of(type(value)):
                inside = getattr(value, name)
                if isinstance(inside, (list, tuple, Word, Ref, Node)) and inside != value.span:
                    setattr(value, name, self._restore(inside, source, repaired))
            value.span = span
        return value

    def _place(self, span: Span, source: Source) -> Span:
        start = self.origins[span.start]
        return Span(source, start, max(start, self.origins[span.end]))


def is_placeholder(name: Word) -> bool:
    """Return True if a name is a placeholder for a missing one."""
    return name.startswith("_") and name[1:].isdecimal() and name.span.text != name
