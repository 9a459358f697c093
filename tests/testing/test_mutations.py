"""Test files with random mistakes: whatever is wrong is reported, and nothing fails in swarmc."""

from __future__ import annotations

import random
import re
from io import StringIO
from pathlib import Path

import pytest

from swarmdsl.execution.testing.command import Request, run

pytestmark = pytest.mark.long


EXAMPLES = Path(__file__).resolve().parents[2] / "examples"
# Keys, texts, numbers, inner tables: mistakes between these are those of TOML.
_PIECE = re.compile(r'"[^"\n]*"|\b[a-z_]+\b(?= *=)|\{[^{}\n]*\}|\b\d+(?:\.\d+)?\b')
_VALUES = (
    *("3", "-1", "true", "[]", "{}", "1979-05-27", "nan", "inf", "[[]]", "[{}]", "[3]"),
    *('""', '[""]', '"1 s"', '"0 s"', '"9999999 h"', '"Off"', '"\\u0000"', '"*"', '"."', '".."'),
    "99999999999999999999",
)
_MUTANTS = 40


def mutant(text: str, chance: random.Random) -> str:
    """A text with one of its pieces in the place of another, or something else there."""
    pieces = list(_PIECE.finditer(text))
    chosen = chance.choice(pieces)
    is_key = chosen[0][0].isalpha()
    others = [piece[0] for piece in pieces if piece[0][0].isalpha() == is_key]
    new = chance.choice(others if is_key else [*others, *_VALUES])
    return text[: chosen.start()] + new + text[chosen.end() :]


def test_mutants(tmp_path: Path, capsys) -> None:
    chance = random.Random(0)
    models = {
        file.read_text(encoding="utf-8"): file.parent
        for file in sorted(EXAMPLES.rglob("*.swarmtest.toml"))
    }
    wrong = 0
    for _ in range(_MUTANTS):
        text = chance.choice(list(models))
        path = tmp_path / "it.swarmtest.toml"
        model = f"model = {models[text].as_posix()!r}\n"
        path.write_text(model + mutant(text, chance), encoding="utf-8")
        out = StringIO()
        passed = run(Request((path,), format="concise"), out, StringIO())
        wrong += not passed
        assert passed or re.search(r": error\[SW\d{4}\]", out.getvalue())

    assert wrong > _MUTANTS / 2
