"""Tests of the outline of a file that is being typed."""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator
from pathlib import Path

from swarmdsl.ide.server.models import Models
from swarmdsl.ide.server.symbols import Symbol, outline

from .patrol import PATROL


def each(symbols: Iterable[Symbol]) -> Iterator[Symbol]:
    for symbol in symbols:
        yield symbol
        yield from each(symbol.inside)


def test_symbols_have_names_within_their_spans_after_each_word(tmp_path: Path) -> None:
    """An editor refuses other symbols, with a message in the face of the user."""
    models = Models([tmp_path])
    path = tmp_path / "patrol.swarm"
    names: set[str] = set()
    for word in re.finditer(r"\S+", PATROL):
        text = PATROL[: word.end()]
        models.edit(path, text + "\n}" * (text.count("{") - text.count("}")))
        found = models.file(path)
        assert found is not None
        for symbol in each(outline(found[1])):
            assert symbol.name, text
            inside = range(symbol.span.start, symbol.span.end + 1)
            assert {symbol.selection.start, symbol.selection.end} <= set(inside), text
            names.add(symbol.name)
    assert names >= {"Start", "Stop", "go_round", "Patrol", "Round", "Home", "Rover", "Patrols"}
