"""Scan of comments, strings and brackets before parsing."""

from __future__ import annotations

import pytest

from swarmdsl.base.diagnostics.collector import Diagnostics
from swarmdsl.base.source import Source
from swarmdsl.syntax.parser.result import NESTING_LIMIT
from swarmdsl.syntax.recovery.prescan import ScanResult, scan


def scanned(text: str) -> tuple[ScanResult, list[tuple[str, str, int]]]:
    """The result, and for each diagnostic its name, the text it marks and its offset."""
    report = Diagnostics()
    result = scan(Source("model.swarm", text), report)
    return result, [
        (found.name, found.primary.span.text, found.primary.span.start)
        for found in report
        if found.primary
    ]


def faults(text: str) -> list[tuple[str, str, int]]:
    result, found = scanned(text)
    assert list(result.faults) == [at for _, _, at in found]
    return found


@pytest.mark.parametrize(
    "text",
    [
        "a { b ( c [ d ] ) } e",
        '"{ ( [" // { ( [\n/* { ( [ */',
        r'"\"{" "\\" { }',
        '/* " */ " /* "',
        "a { b ( c\nd ) }",
        "",
    ],
)
def test_nothing_to_say(text: str) -> None:
    assert faults(text) == []


def test_the_only_open_bracket() -> None:
    assert faults("a { b ( c }") == [("unclosed-bracket", "(", 6)]
    assert faults("a { b [ c ) }") == [("syntax-error", ")", 10)]
    assert faults("a { b") == [("unclosed-bracket", "{", 2)]


def test_closers_alone() -> None:
    assert faults("// /* \n } ) ]") == [("syntax-error", "}", 8)]
    assert faults("a { } }\nb ) c") == [("syntax-error", "}", 6), ("syntax-error", ")", 10)]


def test_a_block_without_its_opener() -> None:
    assert faults("m {\n  a b\n    c\n  }\n}\n") == [("syntax-error", "b", 8)]


def test_indentation_tells_whose_closer_is_missing() -> None:
    text = "m {\n  a {\n    x\n  b {\n    y\n  }\n}\n"

    assert faults(text) == [("unclosed-bracket", "{", text.index("a {") + 2)]


def test_the_last_line_may_be_missing() -> None:
    text = "m {\n  a {\n    x\n  }\n"

    assert faults(text) == [("unclosed-bracket", "{", 2)]


def test_indentation_does_not_matter_where_all_is_closed() -> None:
    assert faults("m {\n    a {\n x }\n  }") == []


def test_tabs_count_four_columns() -> None:
    text = "m {\n\ta {\n\t    x\n    b {\n\t}\n}\n"

    assert faults(text) == [("unclosed-bracket", "{", text.index("a {") + 2)]


def test_a_text_ends_on_its_line() -> None:
    text = 'a "b  \n{ c "d" "e\\"\n'

    assert faults(text) == [
        ("unterminated-text", '"b', 2),
        ("unclosed-bracket", "{", 7),
        ("unterminated-text", '"e\\"', text.index('"e')),
    ]


def test_nothing_counts_after_a_comment_without_end() -> None:
    assert faults('a /* { " ') == [("unterminated-comment", "/*", 2)]


def test_escapes_are_no_faults() -> None:
    result, found = scanned(r'"a\n\t\"\\" "\x"')

    assert found == [("syntax-error", r"\x", 13)]
    assert result.faults == ()


def test_the_first_bracket_that_is_too_deep() -> None:
    assert faults("{" * NESTING_LIMIT + "}" * NESTING_LIMIT) == []
    assert faults("{" * (NESTING_LIMIT + 2)) == [("nested-too-deeply", "{", NESTING_LIMIT)]


def test_lines_of_documentation_that_stand_together() -> None:
    text = "/// One.\n///  Two.\n\n/// Three.\na /// not one\n//// nor this\n  ///\tFour.\n"
    result, _ = scanned(text)

    assert [doc.text for doc in result.docs] == ["One.\n Two.", "Three.", "\tFour."]


def test_what_documentation_stands_before() -> None:
    text = "/// One.\n// aside\n/* and\nmore */ a\n/// Two.\n"
    result, _ = scanned(text)

    assert [text[doc.next :] for doc in result.docs] == ["a\n/// Two.\n", ""]


@pytest.mark.parametrize(
    ("text", "repaired"),
    [
        ("m {\n  a {\n    x\n  b {\n  }\n}\n", "m {\n  a {\n    x\n}\n  b {\n  }\n}\n"),
        ("m {\n  a\n    x\n  }\n}\n", "m {\n  a {\n    x\n  }\n}\n"),
        ("a {\n  b } }\n} c", "a {\n  b }  \n  c"),
        ("a [ b -> c", "a [ b] -> c"),
        ("a (b, c\nd", "a (b, c)\nd"),
        ("a [(b] c", "a [(b)] c"),
        ('in "a/b : c', 'in "a/b" : c'),
        ('on a"', 'on "a"'),
        ("on \u201ca b\u201d", 'on "a b"'),
        ("a \u2192 b\u00a0c", "a -> b c"),
        ("a /* b\nc", "a /* b*/\nc"),
        ("<<<<<<< HEAD\na\n=======\nb\n>>>>>>> x\nc", " " * 12 + "\na\n       \n \n         \nc"),
    ],
)
def test_what_is_repaired_can_be_read(text: str, repaired: str) -> None:
    result, found = scanned(text)
    for start, end, instead in reversed(result.repairs):
        text = text[:start] + instead + text[end:]

    assert text == repaired
    assert found
