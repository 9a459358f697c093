"""A file that is cut into pieces is the same as the whole."""

import random
import re
from pathlib import Path

import pytest

from swarmdsl.base.diagnostics.collector import Diagnostics
from swarmdsl.base.source import Source
from swarmdsl.syntax.ast import walk
from swarmdsl.syntax.parse import parse, parse_segment
from swarmdsl.syntax.parser import generated
from swarmdsl.syntax.segments import split_declarations

from .test_mutations import MODELS, MUTATIONS

SEEDS = 4


def cut(text: str) -> list[str]:
    return [text[start:end] for start, end in split_declarations(text)]


def said(text: str) -> tuple[list[tuple[object, ...]], list[tuple[str, int, int]]]:
    """Return the diagnostics and nodes of a text that is parsed by segments."""
    found: list[tuple[object, ...]] = []
    nodes: list[tuple[str, int, int]] = []
    for start, end in split_declarations(text):
        report = Diagnostics()
        parsed = parse_segment(Source("m", text[start:end]), report)
        for one in report:
            assert one.primary is not None
            found.append((one.primary.span.start + start, one.code, one.message))
        nodes += (
            (type(node).__name__, node.span.start + start, node.span.end + start)
            for node in list(walk(parsed.model))[1:]
        )
    return found, nodes


@pytest.mark.parametrize(
    ("text", "pieces"),
    [
        ("", 1),
        ("event A : m/A\nevent B : m/B\n", 2),
        ("package a\nimport b.*\n\nevent A : m/A\n", 3),
        ("event A : m/A // about A\n/// about B\n\n// and more\nevent B : m/B", 2),
        ("/*\nevent A : m/A\n*/\nevent B : m/B\n", 1),
        ("event A : m/A /* goes\non */\nevent B : m/B\n", 2),
        ("swarm\nevent A : m/A\nendless\nstatemachine M { }\n", 2),
        ("function f :\nswarm { }\n", 1),
        ("swarm S {\nenvironment E\n}\nevent A : m/A\n", 2),
        ("controller B\nextends C { }\n", 1),
        ("statemachine M {\n  state A {\nevent A : m/A\n", 2),
        ("statemachine M { } }\nevent A : m/A\n", 2),
        ('environment E { world "a { }\nevent A : m/A\n', 2),
        ("<<<<<<< ours\nevent A : m/A\n=======\nevent A : m/B\n>>>>>>> theirs\nevent B : m/B", 2),
    ],
)
def test_cut(text: str, pieces: int) -> None:
    assert "".join(cut(text)) == text
    assert len(cut(text)) == pieces


def test_comments_go_with_what_follows() -> None:
    first, second = cut("event A : m/A // A\n\n/// B\nevent B : m/B\n")
    assert first == "event A : m/A // A\n"
    assert second == "\n/// B\nevent B : m/B\n"


@pytest.mark.parametrize("path", MODELS, ids=lambda path: "/".join(path.parts[-3:]))
def test_models(path: Path) -> None:
    text = path.read_text(encoding="utf-8")
    parsed = parse(Source("m", text), Diagnostics())
    nodes = [
        (type(node).__name__, node.span.start, node.span.end)
        for node in list(walk(parsed.model))[1:]
    ]
    # Of optimizations the tree says only that they stand behind all declarations.
    assert said(text) == ([], sorted(nodes, key=lambda node: node[1]))


@pytest.mark.parametrize("seed", range(SEEDS))
def test_mutants(seed: int, pytestconfig: pytest.Config) -> None:
    """The whole is right if and only if each piece is, and is reported otherwise."""
    dice = random.Random(seed)
    for _ in range(pytestconfig.getoption("--mutants") // SEEDS):
        text = dice.choice(MODELS).read_text(encoding="utf-8")
        for mutate in dice.choices(MUTATIONS, k=dice.choice((1, 1, 2))):
            text = mutate(text, dice) or " "
        if dice.random() < 0.2:
            text = re.sub(r"^(\s*\w+) +", r"\1\n", text, flags=re.MULTILINE)
        whole = generated.parse(Source("m", text), {}, 64)
        report = Diagnostics()
        parse(Source("m", text), report)
        found, _ = said(text)
        if whole is None:
            assert report.has_errors, text
        else:
            assert [(one[0], one[1]) for one in found] == [
                (one.primary.span.start, one.code) for one in report if one.primary
            ], text
