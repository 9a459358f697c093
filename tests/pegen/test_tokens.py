"""The lexer yields the tokens that a parser would match one by one."""

from __future__ import annotations

import pytest

from swarmdsl.base.source import Source
from swarmdsl.syntax.parser.generated import LEXER, parse


def cut(text: str) -> list[tuple[str, int]]:
    """Return the tokens of a text, each with its offset."""
    tokens, ends = LEXER.tokenize(text)
    assert tokens[-2:] == ["", ""]
    assert len(ends) == len(tokens)
    found = [(token, end - len(token)) for token, end in zip(tokens, ends[1:], strict=False)]
    while found and found[-1] == ("", len(text)):
        found.pop()
    return found


@pytest.mark.parametrize(
    ("text", "tokens"),
    [
        ("", []),
        (" \t\r\n", []),
        ("on done->A.b1", ["on", "done", "-", ">", "A", ".", "b1"]),
        ("1 2.5 1..9 5s 1e+5", ["1", "2.5", "1", ".", ".", "9", "5s", "1e", "+", "5"]),
        ('"a // b" "/*" x', ['"a // b"', '"/*"', "x"]),
        (r'"\"" "" x', [r'"\""', '""', "x"]),
        ('"a // b\nc', ['"', "a", "c"]),
        ("// a\nb /* c\n// */ // d\n e//", ["b", "e"]),
        ("/**/a/***/b/ /c", ["a", "b", "/", "/", "c"]),
        ('// "\na // "', ["a"]),
    ],
)
def test_tokens(text: str, tokens: list[str]) -> None:
    found = cut(text)

    assert [token for token, _ in found] == tokens
    assert all(text.startswith(token, at) for token, at in found)


@pytest.mark.parametrize("odd", ["\xe9", "\xa0", "\u2009", "\u0663", "\x0b", "\x85"])
def test_what_the_language_does_not_have_is_no_name(odd: str) -> None:
    for name in (odd, f"A{odd}", f"{odd}A", f"A {odd}"):
        assert parse(Source("", f"event {name} : B"), {}, 64) is None
        assert parse(Source("", f"event A : {name}"), {}, 64) is None


def test_what_is_not_ascii_may_stand_in_texts_and_comments() -> None:
    text = '// \xe9\na "\xe9" /* \xe9 */ b'

    assert [token for token, _ in cut(text)] == ["a", '"\xe9"', "b"]


def test_a_piece_has_its_places_in_the_text() -> None:
    tokens, ends = LEXER.tokenize("a // b\n(c d", 4, 9)

    assert tokens[:4] == ["b", "(", "c", ""]
    assert ends[:4] == [4, 6, 8, 9]


def test_comments_without_an_end_are_looked_at_once() -> None:
    assert len(cut("a " + "/* " * 20_000)) == 2
