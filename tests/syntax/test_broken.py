"""Diagnostics of models with typical mistakes, and the rest of their trees.

A case is a file in `broken/`; the `.txt` file next to it has its diagnostics and an outline of the
tree. `pytest --bless` rewrites these: read them before you commit.
"""

from __future__ import annotations

import re
from collections.abc import Iterator
from io import StringIO
from pathlib import Path

import pytest

from swarmdsl.base.diagnostics.collector import Diagnostics
from swarmdsl.base.diagnostics.render import render
from swarmdsl.base.source import Source
from swarmdsl.driver import pipeline
from swarmdsl.syntax.ast import Node
from swarmdsl.syntax.ast.walk import children
from swarmdsl.syntax.errors.report import TERMINALS
from swarmdsl.syntax.parse import parse
from swarmdsl.syntax.parser import generated

FOLDER = Path(__file__).parent / "broken"
IMPORTED = "types.swarm"
CASES = sorted(path.name for path in FOLDER.glob("*.swarm") if path.name != IMPORTED)
# What an outline is for, not the details.
DEPTH = 4


def outline(node: Node, depth: int = 0) -> Iterator[str]:
    """The names of what is in a tree, as far as they were written, indented."""
    for child in children(node):
        name = getattr(child, "name", None)
        if hasattr(name, "span") and depth < DEPTH:
            shown = name if name.span.text else "(no name)"
            yield f"{'  ' * depth}{type(child).__name__} {shown}\n"
            yield from outline(child, depth + 1)


@pytest.mark.parametrize("case", CASES)
def test_broken(case: str, bless: bool, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(FOLDER)
    report = pipeline.check([Path(case)]).report
    stream = StringIO()
    render(report, "text", stream)
    text = (FOLDER / case).read_text(encoding="utf-8")
    tree = parse(Source(case, text), Diagnostics()).model
    found = f"{stream.getvalue()}In the tree:\n{''.join(outline(tree))}"
    expected = (FOLDER / case).with_suffix(".txt")
    if bless:
        expected.write_text(found, encoding="utf-8")

    assert found == expected.read_text(encoding="utf-8")
    assert report.has_errors


def test_every_expected_text_has_its_case() -> None:
    assert [path.stem for path in sorted(FOLDER.glob("*.txt"))] == [
        Path(case).stem for case in CASES
    ]
    assert len(CASES) >= 100


def test_every_terminal_that_can_be_missing_has_a_name_in_messages() -> None:
    """An expression that also matches the empty string is never missing."""
    nameless = [
        regex
        for regex, name, literal in generated.TERMINALS
        if name not in TERMINALS and not literal and re.match(regex, "") is None
    ]

    assert nameless == []
