"""TOML to values, each with its place in the text.

tomli reads the values and finds what is wrong with the text, but does not keep places. So
the text is parsed a second time for these alone, when tomli has accepted it: the grammar
here tells apart no more than it needs to.
"""

from __future__ import annotations

from collections.abc import Iterator
from functools import cache
from typing import Any, NamedTuple

import tomli
from lark import Lark, Token, Tree

from swarmdsl.dataclass import dataclass, field
from swarmdsl.diagnostics import Diagnostics
from swarmdsl.source import Source, Span

Keys = tuple[str | int, ...]
"""The way from the top of a document to a value: names of keys, positions in arrays."""

_GRAMMAR = r"""
start: (table | tables | pair)*
table: "[" key "]"
tables: "[[" key "]]"
pair: key "=" _value
key: (BARE | BASIC | LITERAL) ("." (BARE | BASIC | LITERAL))*
_value: BASIC | LITERAL | BASIC_LINES | LITERAL_LINES | SCALAR | array | inline_table
array: "[" [_value ("," _value)* ","?] "]"
inline_table: "{" [pair ("," pair)* ","?] "}"

BARE: /[A-Za-z0-9_-]+/
BASIC: /"(\\.|[^"\\\n])*"/
LITERAL: /'[^'\n]*'/
BASIC_LINES.1: /\"{3}(\\[\s\S]|[^\\])*?\"{3,5}(?!\")/
LITERAL_LINES.1: /'''[\s\S]*?'{3,5}(?!')/
SCALAR: /\d{4}-\d\d-\d\d \d\d:[\d:.]+([zZ]|[+-][\d:]+)?|[^\s,\[\]{}#"'=]+/
%ignore /[ \t\n]+|#[^\n]*/
"""

# How tomli begins to say that something is given twice, or inside of what is closed.
_OVERWRITING = ("cannot overwrite", "cannot declare", "cannot mutate", "duplicate inline table")


class Place(NamedTuple):
    """Where a value stands, and the key before it; the same for an item of an array."""

    key: Span
    value: Span


@dataclass(frozen=True)
class Document:
    """A TOML document; `places` has the place of every key and item in it."""

    source: Source
    values: dict[str, Any]
    places: dict[Keys, Place] = field(default_factory=dict)


def parse_toml(source: Source, report: Diagnostics) -> Document | None:
    """The document that a source holds; None when it is not TOML, which is reported."""
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
    return Document(source, values, _Places(source).find())


def _last_key(source: Source, end: int) -> Span:
    """The key of the pair, or of the header but for its brackets, that ends at `end`."""
    parser = _parser().parse_interactive(source.text[:end])
    tokens = list(parser.exhaust_lexer())
    last = len(tokens) - 1
    depth = 0
    for at in reversed(range(len(tokens))):
        depth += (tokens[at] in ("]", "}")) - (tokens[at] in ("[", "[[", "{"))
        if depth < 0:
            break
        if tokens[at] == "=" and depth == 0:
            last = at - 1
            break
    first = last
    while first > 1 and tokens[first - 1] == ".":
        first -= 2
    begin, stop = tokens[first].start_pos, tokens[last].end_pos
    assert begin is not None
    assert stop is not None
    return Span(source, begin, stop)


@cache
def _parser() -> Lark:
    return Lark(_GRAMMAR, parser="lalr", propagate_positions=True, maybe_placeholders=False)


class _Places:
    def __init__(self, source: Source) -> None:
        self._source = source
        self._places: dict[Keys, Place] = {}
        self._tables: dict[Keys, int] = {}
        """How many tables there are so far in each array of tables."""

    def find(self) -> dict[Keys, Place]:
        above: Keys = ()
        for statement in _parser().parse(self._source.text).children:
            assert isinstance(statement, Tree)
            if statement.data == "pair":
                self._pair(statement, above)
                continue
            above = self._header(statement)
        return self._places

    def _header(self, header: Tree[Token]) -> Keys:
        (key,) = header.children
        keys: Keys = ()
        *_, last = parts = list(_parts(key))
        for part in parts:
            keys = (*keys, _name(part))
            self._add(keys, part, part)
            if part is last and header.data == "tables":
                self._tables[keys] = self._tables.get(keys, 0) + 1
            if keys in self._tables:
                keys = (*keys, self._tables[keys] - 1)
                self._add(keys, part, part)
        return keys

    def _pair(self, pair: Tree[Token], keys: Keys) -> None:
        key, value = pair.children
        for part in _parts(key):
            keys = (*keys, _name(part))
            self._add(keys, part, value)
        self._value(value, keys)

    def _value(self, value: Token | Tree[Token], keys: Keys) -> None:
        if isinstance(value, Token):
            return
        for number, child in enumerate(value.children):
            if value.data == "array":
                self._add((*keys, number), child, child)
                self._value(child, (*keys, number))
            else:
                assert isinstance(child, Tree)
                self._pair(child, keys)

    def _add(self, keys: Keys, key: Token | Tree[Token], value: Token | Tree[Token]) -> None:
        self._places.setdefault(keys, Place(self._span(key), self._span(value)))

    def _span(self, node: Token | Tree[Token]) -> Span:
        if isinstance(node, Token):
            start, end = node.start_pos, node.end_pos
        else:
            start, end = node.meta.start_pos, node.meta.end_pos
        assert start is not None
        assert end is not None
        return Span(self._source, start, end)


def _parts(key: Token | Tree[Token]) -> Iterator[Token]:
    assert isinstance(key, Tree)
    for part in key.children:
        assert isinstance(part, Token)
        yield part


def _name(part: Token) -> str:
    """The name that a part of a key stands for, which may be quoted."""
    return next(iter(tomli.loads(f"{part} = 0")))
