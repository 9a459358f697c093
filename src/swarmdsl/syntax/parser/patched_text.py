"""A text with repairs in it, which knows where each of its characters stood before them."""

from __future__ import annotations

import re
from collections.abc import Sequence
from typing import Any, NamedTuple

from swarmdsl.base.records import dataclass, fields_of
from swarmdsl.base.source import Source, Span
from swarmdsl.syntax.ast import Expression, Node, Ref, Word

_WORD = r"[A-Za-z_][A-Za-z0-9_]*"


class Repair(NamedTuple):
    """What to put in the place of a piece of text so that what is around it can be read."""

    start: int
    end: int
    text: str


@dataclass(frozen=True, slots=True)
class Draft:
    """A repaired text; `origins` are the offsets of its characters, and of its end, in the source.

    What was put in has the place where it was put in.
    """

    text: str
    origins: Sequence[int]

    def piece(self, start: int, end: int) -> Draft:
        """The part between two offsets."""
        return Draft(self.text[start:end], self.origins[start : end + 1])

    def repaired(self, *repairs: Repair) -> Draft:
        """The same with more repairs, in order; of those that overlap the first is made."""
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
        return Draft("".join([*texts, self.text[done:]]), [*origins, *self.origins[done:]])

    def blanked(self, start: int, end: int) -> Draft:
        """The same with spaces in place of a piece."""
        return Draft(
            self.text[:start] + re.sub(r"[^\n]", " ", self.text[start:end]) + self.text[end:],
            self.origins,
        )

    def restore(self, node: Node, source: Source) -> set[Expression]:
        """Give all in a tree that was made of this text its place in the source.

        Return the expressions with a repair in them: what they say is not in the source.
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
            # A placeholder: for a keyword, which it is as long as, or for nothing.
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


def stands_for_nothing(name: Word) -> bool:
    """Whether a name was put in where none could be read."""
    return name.startswith("_") and name[1:].isdecimal() and name.span.text != name


def untouched(text: str) -> Draft:
    """A text without repairs."""
    return Draft(text, range(len(text) + 1))
