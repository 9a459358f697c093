"""Tests of the lexical search."""

import re

import pytest

from swarmdsl.base.source import Source
from swarmdsl.ide.server.code import find_tokens
from swarmdsl.ide.server.folding_range import folding_ranges

WORD = re.compile(r"//[^\n]*|/\*|\w+")


@pytest.mark.parametrize(
    ("text", "found"),
    [
        ("a /* b */ c", ["a", "/* b */", "c"]),
        ("a /* b /* c */ d */", ["a", "/* b /* c */", "d"]),
        ("a /* b", ["a", "b"]),
        ("a */ /* b /* c", ["a", "b", "c"]),
        ("/*/ a */ b", ["/*/ a */", "b"]),
        ("a /*/", ["a"]),
        ("a // /* */ b\nc", ["a", "// /* */ b", "c"]),
    ],
)
def test_whole_comments_are_found(text, found):
    assert [word for _, word in find_tokens(text, WORD)] == found
    assert all(text.startswith(word, at) for at, word in find_tokens(text, WORD))


def test_search_in_a_part():
    text = "a b /* c */ d"
    assert list(find_tokens(text, WORD, 2, 8)) == [(2, "b"), (7, "c")]


@pytest.mark.timeout(60)
@pytest.mark.parametrize("end", ["", "*/"])
def test_many_unterminated_comments(end):
    """With a pattern for whole comments, this takes minutes."""
    text = "/*\n" * 40_000 + end + "{\n\n}"
    found = [(fold.first, fold.last, fold.kind) for fold in folding_ranges(Source("a.swarm", text))]
    comment = [(0, 40_000, "comment")] if end else []
    assert found == [*comment, (40_000, 40_001, "")]
