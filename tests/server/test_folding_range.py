"""Tests of folding ranges, also in incomplete and in long text."""

from __future__ import annotations

import pytest

from swarmdsl.base.source import Source
from swarmdsl.ide.server.folding_range import FoldingRange, folding_ranges


def test_folding_ranges() -> None:
    text = '/* a\n { */\nimport "a"\nimport "b"\n// c\n// d\nstruct S {\n  a : T\n}\n'
    assert folding_ranges(Source("model.swarm", text)) == [
        FoldingRange(0, 1, "comment"),
        FoldingRange(2, 3, "imports"),
        FoldingRange(4, 5, "comment"),
        FoldingRange(6, 7),
    ]


@pytest.mark.parametrize("begin", ["/*", '"', "// */ /*"])
def test_unterminated_token_hides_no_blocks(begin: str) -> None:
    text = f"struct S {{\n  a : T\n}}\n{begin} x\nstruct U {{\n  a : T\n}}\n"
    assert folding_ranges(Source("model.swarm", text)) == [FoldingRange(0, 1), FoldingRange(4, 5)]


@pytest.mark.parametrize("text", ['"' + r"\"" * 100_000, "/* " * 70_000, "/*\n" * 70_000])
def test_many_unterminated_tokens(text: str) -> None:
    """With a separate search for each end, this takes minutes."""
    assert folding_ranges(Source("model.swarm", text)) == []
