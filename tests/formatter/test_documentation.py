"""The pages about the language show files in the layout they describe."""

import pytest

from swarmdsl.base.diagnostics.collector import Diagnostics
from swarmdsl.base.source import Source
from swarmdsl.syntax.formatter import format_source

from ..docs.pages import blocks

SHOWN = [block for block in blocks("swarm") if str(block.page) == "docs/formatting.md"]


@pytest.mark.parametrize("block", SHOWN, ids=str)
def test_blocks_are_formatted(block):
    assert format_source(Source("block", block.text), Diagnostics()) == block.text


def test_broken_lines():
    """Long lines in the handbook are wrapped as shown."""
    (lines,) = (
        block.text
        for block in blocks("text")
        if str(block.page) == "docs/formatting.md" and block.text.startswith("do ")
    )
    inside = "".join(f"    {line}\n" for line in lines.splitlines())
    text = f"statemachine M {{\n  state S {{\n{inside}  }}\n}}\n"
    flat = text.replace("\n      gives", " gives").replace("(\n        auct", "(auct")
    assert flat != text
    assert format_source(Source("block", flat), Diagnostics()) == text
