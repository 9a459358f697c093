"""Comments, texts and brackets, before anything is parsed."""

from __future__ import annotations

import pytest

from swarmdsl.diagnostics import Diagnostics
from swarmdsl.scan import NESTING_LIMIT, Scan, scan
from swarmdsl.source import Source


def scanned(text: str) -> tuple[Scan, list[tuple[str, str, int]]]:
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
        "// /* \n } ) ]",  # closers alone are for the parser
        "",
    ],
)
def test_nothing_to_say(text: str) -> None:
    assert faults(text) == []


def test_the_only_open_bracket() -> None:
    assert faults("a { b ( c }") == [("unclosed-bracket", "(", 6)]
    assert faults("a { b [ c ) }") == [("unclosed-bracket", "[", 6)]
    assert faults("a { b") == [("unclosed-bracket", "{", 2)]


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


def test_blocks_are_comments_and_outermost_brackets() -> None:
    text = "a { b ( ) } /* c */ [ d /* e */ ]"
    result, _ = scanned(text)

    assert [text[start : end + 1].strip() for start, end in result.blocks] == [
        "{ b ( ) }",
        "/* c */",
        "[ d /* e */ ]",
    ]


def test_no_brackets_are_blocks_where_one_is_open() -> None:
    result, _ = scanned("a { } b { /* c */")

    assert result.blocks == ((10, 17),)
