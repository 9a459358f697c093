"""Places in the text of a file."""

import pytest
from hypothesis import given
from hypothesis import strategies as st

from swarmdsl.base.diagnostics.collector import Diagnostics
from swarmdsl.base.source import Source
from swarmdsl.project.read_source import without_control_characters


@given(st.text("ab\n\r\u2028é", max_size=40), st.data())
def test_lines_and_columns(text, data):
    source = Source("a.swarm", text)
    for _ in range(30):  # the first few are looked for, the rest found in an index
        offset = data.draw(st.integers(0, len(text)))
        before = text[:offset].split("\n")
        assert source.line_column(offset) == (len(before), len(before[-1]) + 1)
    assert [text[start - 1 : start] for start in source.line_starts[1:]] == ["\n"] * text.count(
        "\n"
    )


@pytest.mark.parametrize("text", ["a\tb\n", "é\u2028 😀\n", ""])
def test_text_without_control_characters_is_left_alone(text):
    report = Diagnostics()
    source = Source("a.swarm", text)
    assert without_control_characters(source, report) is source
    assert not list(report)


@pytest.mark.parametrize("character", [chr(code) for code in (1, 8, 11, 12, 14, 31, 127, 0xD800)])
def test_control_characters_become_spaces(character):
    report = Diagnostics()
    source = without_control_characters(Source("a.swarm", f"é{character}b"), report)
    assert source.text == "é b"
    assert [found.name for found in report] == ["control-character"]
