"""Parse TOML into values with their source spans.

tomli parses and validates the document but keeps no positions. A second, lenient scan of the
accepted source finds these.
"""

from __future__ import annotations

import re
from collections.abc import Iterable
from contextlib import suppress
from typing import Any, NamedTuple

import tomli

from swarmdsl.base.diagnostics.collector import Diagnostics
from swarmdsl.base.numerals import fits_64_bits
from swarmdsl.base.records import dataclass, field
from swarmdsl.base.source import Source, Span

Keys = tuple[str | int, ...]
"""Path from the top of a document to a value: keys and array indices."""

_BETWEEN = re.compile(r"(?:[ \t\r\n]+|#[^\n]*)*")
_WORD_OF_KEY = re.compile(r"""[A-Za-z0-9_-]+|"(?:\\.|[^"\\\n])*"|'[^'\n]*'""")
_WORD_OF_VALUE = re.compile(
    r"""
    "{3}(?:\\[\s\S]|[^\\])*?"{3,5}(?!") | '{3}[\s\S]*?'{3,5}(?!')
    | "(?:\\.|[^"\\\n])*" | '[^'\n]*'
    | \d{4}-\d\d-\d\d[ ]\d\d:[\d:.]+(?:[zZ]|[+-][\d:]+)? | [^\s,\[\]{}\#"'=]+
    """,
    re.VERBOSE,
)

# How tomli begins the message about a redefinition.
_OVERWRITING = ("cannot overwrite", "cannot declare", "cannot mutate", "duplicate inline table")


class Place(NamedTuple):
    """Span of a value and of the key before it; the same span for an array item."""

    key: Span
    value: Span


@dataclass(frozen=True)
class Document:
    """TOML document; `places` has the spans of every key and item."""

    source: Source
    values: dict[str, Any]
    places: dict[Keys, Place] = field(default_factory=dict)


def parse_toml(source: Source, report: Diagnostics) -> Document | None:
    """Parse a document; None if it is not TOML, which is reported."""
    try:
        values = tomli.loads(source.text)
    except (ValueError, RecursionError) as error:
        at = getattr(error, "pos", 0)
        reason = str(getattr(error, "msg", error))
        place = Span(source, at, at)
        if not reason.startswith("TOML"):
            reason = reason[:1].lower() + reason[1:]
        if reason.startswith(_OVERWRITING):
            place = _last_key(source, at)
            reason = f"`{place.text}` overwrites what is given before it"
        report.report("bad-toml", place, path=source.name, reason=reason)
        return None
    places = _Places(source, len(source.text)).find()
    if (keys := _too_large((), values)) is not None:
        place = places[keys].value if keys in places else Span(source, 0, 0)
        reason = "a number has more than 64 bits"
        report.report("bad-toml", place, path=source.name, reason=reason)
        return None
    return Document(source, values, places)


def _too_large(keys: Keys, value: Any) -> Keys | None:
    """Return the way to a number that TOML does not have, None if there is none."""
    if isinstance(value, int):
        return None if fits_64_bits(value) else keys
    inner: Iterable[tuple[str | int, Any]] = ()
    if isinstance(value, dict):
        inner = value.items()
    elif isinstance(value, list):
        inner = enumerate(value)
    found = (_too_large((*keys, key), each) for key, each in inner)
    return next((each for each in found if each is not None), None)


def _last_key(source: Source, end: int) -> Span:
    """Return the key of the pair or table header that ends at `end`."""
    reader = _Places(source, end)
    with suppress(_Over):
        reader.find()
    return reader.last_key


class _Over(Exception):  # noqa: N818 - no error
    """End of input inside a construct."""


class _Places:
    """Scan valid TOML up to `end`."""

    def __init__(self, source: Source, end: int) -> None:
        self._source = source
        self._end = end
        self._at = 0
        self._stop = 0
        """End of the last token."""
        self._places: dict[Keys, Place] = {}
        self._tables: dict[Keys, int] = {}
        """Number of tables so far in each array of tables."""
        self.last_key = Span(source, end, end)
        """Key of the last completed pair or header."""

    def find(self) -> dict[Keys, Place]:
        """Return the spans of all keys and items. Raises _Over."""
        above: Keys = ()
        self._skip()
        while self._at < self._end:
            if self._take("["):
                above = self._header(many=self._take("["))
            else:
                self._pair(above)
        return self._places

    def _header(self, many: bool) -> Keys:
        keys: Keys = ()
        *_, last = parts = self._key()
        for part in parts:
            keys = (*keys, _name(part))
            self._add(keys, part, part)
            if part is last and many:
                self._tables[keys] = self._tables.get(keys, 0) + 1
            if keys in self._tables:
                keys = (*keys, self._tables[keys] - 1)
                self._add(keys, part, part)
        self.last_key = _whole(parts)
        while self._take("]"):
            pass
        return keys

    def _pair(self, keys: Keys) -> None:
        parts = self._key()
        self._take("=")
        new = []
        for part in parts:
            keys = (*keys, _name(part))
            if keys not in self._places:
                new.append(keys)
                self._add(keys, part, part)
        value = self._value(keys)
        for known in new:
            self._places[known] = self._places[known]._replace(value=value)
        self.last_key = _whole(parts)

    def _value(self, keys: Keys) -> Span:
        start = self._at
        if self._take("["):
            number = 0
            while not self._take("]"):
                place = self._value((*keys, number))
                self._add((*keys, number), place, place)
                number += 1
                self._take(",")
        elif self._take("{"):
            while not self._take("}"):
                self._pair(keys)
                self._take(",")
        else:
            return self._word(_WORD_OF_VALUE)
        return Span(self._source, start, self._stop)

    def _key(self) -> list[Span]:
        parts = [self._word(_WORD_OF_KEY)]
        while self._take("."):
            parts.append(self._word(_WORD_OF_KEY))
        return parts

    def _add(self, keys: Keys, key: Span, value: Span) -> None:
        self._places.setdefault(keys, Place(key, value))

    def _word(self, kind: re.Pattern[str]) -> Span:
        word = kind.match(self._source.text, self._at, self._end)
        if word is None:
            raise _Over
        self._at = self._stop = word.end()
        self._skip()
        return Span(self._source, word.start(), word.end())

    def _take(self, mark: str) -> bool:
        if not self._source.text.startswith(mark, self._at, self._end):
            return False
        self._at += 1
        self._stop = self._at
        self._skip()
        return True

    def _skip(self) -> None:
        between = _BETWEEN.match(self._source.text, self._at, self._end)
        assert between is not None
        self._at = between.end()


def _whole(parts: list[Span]) -> Span:
    return Span(parts[0].source, parts[0].start, parts[-1].end)


def _name(part: Span) -> str:
    """Return the name in a key part, which may be quoted."""
    return part.text if part.text[0] not in "\"'" else next(iter(tomli.loads(f"{part.text} = 0")))
