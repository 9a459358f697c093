"""Positions of values in a TOML document."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

import pytest
import tomli
from hypothesis import given
from hypothesis import strategies as st

from swarmdsl.base.diagnostics.collector import Diagnostics
from swarmdsl.base.source import Source
from swarmdsl.driver.config.toml import Document, Keys, parse_toml

DOCUMENT = r'''# A comment with "quotes" and [brackets]
top."quoted key".'literal key' = [1, [ "x" , 'y' ], { q = 1, r.s = "]" }, ] # more
empty = []
nothing = {}
moment = 1979-05-27 07:32:00Z
day = 1979-05-27
number = -1_000.5e-3
infinite = -inf
basic = "\"#\\"
lines = """a"" \""" # no comment
b"""""
literal_lines = \'\'\'a'' \'\'\'
2024 = true

[table]
x = 1
[ spaced . "out" ]
y = [
  1, # one
  2,
]
[[many]]
n = 1
[[many]]
n = [[1, 2], [3]]
[many.below]
k = "k"
'''.replace(r"\'", "'")


def parsed(text: str) -> Document:
    report = Diagnostics()
    document = parse_toml(Source("x.toml", text), report)
    assert not list(report)
    assert document is not None
    return document


def leaves(value: Any, keys: Keys = ()) -> Iterator[tuple[Keys, Any]]:
    """Yield all leaf values with their keys."""
    children = (
        value.items()
        if isinstance(value, dict)
        else enumerate(value)
        if isinstance(value, list)
        else ()
    )
    for key, inside in children:
        yield from leaves(inside, (*keys, key))
    if not children and not isinstance(value, (dict, list)):
        yield keys, value


def holds(document: Document) -> None:
    """Assert that the text at the position of each value parses to this value."""
    for keys, value in leaves(document.values):
        text = document.places[keys].value.text
        assert repr(tomli.loads(f"v = {text}")["v"]) == repr(value)
        if isinstance(keys[-1], str):
            assert list(tomli.loads(f"{document.places[keys].key.text} = 0")) == [keys[-1]]


def test_positions_of_all_values() -> None:
    document = parsed(DOCUMENT)

    assert len(list(leaves(document.values))) > 20
    holds(document)


def test_the_place_of_a_table_is_its_name() -> None:
    places = parsed(DOCUMENT).places

    assert places["table",].key.text == "table"
    assert places["spaced", "out"].key.text == '"out"'
    assert places["many", 1].key.line == places["many", 1, "n"].key.line - 1


TEXTS = st.text(st.characters(codec="utf-8", exclude_characters="\r"), max_size=8)
VALUES = st.recursive(
    TEXTS | st.integers(-(2**40), 2**40) | st.booleans() | st.dates(),
    lambda inner: st.lists(inner, max_size=3) | st.dictionaries(TEXTS, inner, max_size=3),
    max_leaves=6,
)


def written(value: Any) -> str:
    if isinstance(value, str):
        plain = value.isprintable() and not set(value) & set("'\"\\")
        escaped = "".join(f"\\U{ord(character):08x}" for character in value)
        return f"'{value}'" if plain else f'"{escaped}"'
    if isinstance(value, list):
        return f"[ {', '.join(map(written, value))} ]"
    if isinstance(value, dict):
        return "{ " + ", ".join(f"{written(k)} = {written(v)}" for k, v in value.items()) + " }"
    return str(value).lower() if isinstance(value, bool) else str(value)


@given(st.dictionaries(TEXTS, VALUES, max_size=3))
def test_places_of_any_document(values: dict[str, Any]) -> None:
    text = "".join(f"{written(key)} = {written(value)} # {{\n" for key, value in values.items())
    document = parsed(text)

    assert document.values == values
    holds(document)


@pytest.mark.parametrize(
    ("text", "line", "column", "key"),
    [
        ("a = 1\na = 2\n", 2, 1, "a"),
        ("a = 1\n'a' = [[2], {b = '='}] # =\n", 2, 1, "'a'"),
        ('[t]\na = 1\n  a = """\n = """\n', 3, 3, "a"),
        ("a.b = 1\na . b.c = 1\n", 2, 1, "a . b.c"),
        ("a = {}\na.b = 1\n", 2, 1, "a.b"),
        ("a = [{ b = { c = 1, c = 2 } }]\n", 1, 21, "c"),
        ("[t]\na = 1\n[t]\nb = [", 3, 2, "t"),
        ("[t.u]\n[[t . u]]\n", 2, 3, "t . u"),
        ("a = [1]\n[[a]]\n", 2, 3, "a"),
        ("a = 1\n[a.b]\n", 2, 2, "a.b"),
    ],
)
def test_repeated_keys_are_reported(text: str, line: int, column: int, key: str) -> None:
    report = Diagnostics()

    assert parse_toml(Source("x.toml", text), report) is None
    (found,) = report
    assert (
        found.message == f"`x.toml` is not valid TOML: `{key}` overwrites what is given before it"
    )
    assert found.primary is not None
    span = found.primary.span
    assert span.text == key
    assert span.source.line_column(span.start) == (line, column)


@pytest.mark.parametrize(
    ("text", "line", "column"),
    [
        ("[project", 1, 9),
        ("a = 1\nb = [1,\n", 3, 1),
        ('x = "open\n', 1, 10),
        ("x = \x01\n", 1, 5),
        (f"x = {'[' * 500}", None, None),
        (f"x = {'9' * 5000}", None, None),
    ],
)
def test_invalid_toml_is_reported(text: str, line: int | None, column: int | None) -> None:
    report = Diagnostics()

    assert parse_toml(Source("x.toml", text), report) is None
    (found,) = report
    assert found.name == "bad-toml"
    assert found.primary is not None
    if line is not None:
        assert found.primary.span.source.line_column(found.primary.span.start) == (line, column)
