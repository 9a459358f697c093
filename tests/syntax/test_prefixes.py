"""Every beginning of every example, and every example without one token: what is left of them.

Whoever types has a file like these at every moment. A diagnostic or a valid model comes out,
never an exception, and the tree holds nearly all that the text declares.
"""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import get_args

import pytest

from swarmdsl.base.diagnostics.collector import Diagnostics
from swarmdsl.base.source import Source, Span
from swarmdsl.syntax.ast import Declaration, Model, Node, Vertex, walk
from swarmdsl.syntax.parse import parse

EXAMPLES = sorted((Path(__file__).resolve().parents[2] / "examples").rglob("*.swarm"))
_TOKEN = re.compile(r'//[^\n]*|"[^"\n]*"|\w+|->|=>|[^\w\s]')
_NAMED = (*get_args(Declaration), *get_args(Vertex))
# One token out of so many is cut at, or left out: all of them take a minute.
EVERY = 17
# Of the declarations and states that such a text still names, the share that is in the tree.
# With every token of every example it is 99.83 % for beginnings, 99.69 % without a token.
FLOOR = 0.995


def tokens(text: str) -> list[re.Match[str]]:
    return [token for token in _TOKEN.finditer(text) if not token[0].startswith("//")]


def prefixes(text: str) -> Iterator[tuple[str, int, int]]:
    """Each text, and the piece of the original that it lacks."""
    for token in tokens(text)[::EVERY]:
        yield text[: token.end()], token.end(), len(text)


def without_a_token(text: str) -> Iterator[tuple[str, int, int]]:
    for token in tokens(text)[::EVERY]:
        yield text[: token.start()] + text[token.end() :], *token.span()


def read(text: str) -> tuple[Model, bool]:
    report = Diagnostics()
    parsed = parse(Source("model.swarm", text), report)
    return parsed.model, report.has_errors


def names(model: Node) -> Iterator[tuple[str, Span]]:
    """The declarations and states in a tree, each with the place of its name."""
    for node in walk(model):
        if isinstance(node, _NAMED):
            yield f"{type(node).__name__} {node.name}", node.name.span


@pytest.mark.parametrize("broken", [prefixes, without_a_token])
def test_what_is_left(
    broken: Callable[[str], Iterator[tuple[str, int, int]]],
    record_property: Callable[[str, object], None],
) -> None:
    there = left = 0
    for example in EXAMPLES:
        original = example.read_text(encoding="utf-8")
        model, wrong = read(original)
        assert not wrong
        whole = list(names(model))
        for text, start, end in broken(original):
            tree, wrong = read(text)
            # What the text still says: names in front of what is lacking, or behind it.
            said = Counter(name for name, at in whole if at.end <= start or at.start >= end)
            found = Counter(name for name, _ in names(tree))
            there += said.total()
            left += (said & found).total()
            if not wrong:  # it is valid: then nothing of it is lost
                assert not said - found, text[max(0, start - 200) : start + 50]
    record_property("figure", f"{broken.__name__}: {left / there:.2%} of {there} names are left")

    assert left / there > FLOOR
