"""Formatting any file keeps its content, and is idempotent."""

from __future__ import annotations

import re
from collections.abc import Callable, Sequence
from functools import cache
from itertools import pairwise
from pathlib import Path
from random import Random

import pytest
from hypothesis import assume, given, settings
from hypothesis import strategies as st

from swarmdsl.base.diagnostics.collector import Diagnostics
from swarmdsl.base.source import Source
from swarmdsl.driver import pipeline
from swarmdsl.ir import System
from swarmdsl.syntax.formatter import format_source
from swarmdsl.syntax.formatter.tokens import Kind, content_of, tokenize
from swarmdsl.syntax.units import UNITS

from ..docs.pages import blocks

ROOT = Path(__file__).resolve().parents[2]
FILES = [
    path
    for folder in ("examples", "tests/golden", "tests/diagnostics", "src/swarmdsl/library")
    for path in sorted((ROOT / folder).rglob("*.swarm"))
]


def parsed(text: str) -> bool:
    return format_source(Source("model", text), Diagnostics(), migrate=True) is not None


def layout(text: str) -> str:
    report = Diagnostics()
    result = format_source(Source("model", text), report, migrate=True)
    assert result is not None, [found.message for found in report]
    return result


def read(path: Path) -> str:
    return path.read_bytes().decode("utf-8-sig", "replace").replace("\r\n", "\n")


@cache
def models() -> dict[str, str]:
    """Return the texts of all files and blocks that can be parsed, by name."""
    texts = {str(path.relative_to(ROOT)): read(path) for path in FILES}
    texts |= {str(block): block.text for block in blocks("swarm")}
    return {name: text for name, text in texts.items() if parsed(text)}


# They compile on their own.
WHOLE = [
    read(ROOT / path)
    for path in (
        "tests/golden/everything/model.swarm",
        "tests/golden/submachine/model.swarm",
        "examples/flocking/flocking.swarm",
        "examples/emergency_exit/emergency_exit.swarm",
    )
]


def without_space(text: str) -> str:
    return re.sub(r"[\s,;]+", "", text)


def check_layout(text: str) -> str:
    result = layout(text)
    assert content_of(tokenize(result)) == content_of(tokenize(text))
    assert without_space(result) == without_space(text)
    assert format_source(Source("model", result), Diagnostics()) == result
    assert result.endswith("\n") or not result
    assert not re.search(r"[ \t]\n|\n\n\n|\n\n\Z|\A\n", with_short_tokens(result))
    return result


def with_short_tokens(text: str) -> str:
    """The text with an `x` for each token, so that only its white space counts."""
    pieces, end = [], 0
    for token in tokenize(text):
        pieces += [text[end : token.start], "x"]
        end = token.start + len(token.text)
    return "".join(pieces) + text[end:]


def test_most_models_are_looked_at():
    assert len(models()) > 100


def test_models():
    wrong = {}
    for name, text in models().items():
        try:
            check_layout(text)
        except AssertionError as error:
            wrong[name] = str(error)
    assert wrong == {}


@pytest.fixture(scope="module")
def compile_text(tmp_path_factory) -> Callable[[str], System | None]:
    path = tmp_path_factory.mktemp("models") / "model.swarm"

    def compile_text(text: str) -> System | None:
        path.write_text(text, encoding="utf-8")
        return pipeline.check([path]).system

    return compile_text


def test_the_meaning_stays(compile_text):
    compiled = 0
    for text in models().values():
        before = compile_text(text)
        if before is not None:
            compiled += 1
            assert compile_text(layout(text)) == before
    assert compiled > 20


GAPS = (" ", "  ", "\t", "\n", "\n\n", "\n\n\n \n", "\n        ")
COMMENTS = (
    *("/* c */", " /* c */ ", "\n/* c */\n", "\n/* c */ ", " /* a\n   * b\n */ ", "/* a\n b */\n"),
    *(" // c\n", "\n// c\n", "\n// c\n\n// d\n", "\n/// doc\n", " /// no doc\n", "//c\n   //d\n"),
)


def mutated(text: str, random: Random, comments: float, gaps: Sequence[str] = GAPS) -> str:
    """The same tokens, with other white space and comments between them."""
    tokens = tokenize(text)
    pieces = []
    for one, other in pairwise([*tokens, None]):
        assert one is not None
        pieces.append(one.text)
        if other is None:
            continue
        end = one.start + len(one.text)
        if one.kind is Kind.LINE_COMMENT:
            pieces.append(random.choice(("\n", "\n\n", "\n\n\n  ")))
        elif end == other.start:
            continue  # there may be no space here
        elif one.kind is Kind.NUMBER and other.text in UNITS:
            pieces.append(random.choice((" ", "  ", "\t")))
        elif other.text.startswith("///"):
            pieces.append("\n")
        elif random.random() < comments:
            pieces.append(random.choice(COMMENTS))
        else:
            pieces.append(random.choice(gaps))
    return "".join(pieces) + random.choice(("", "\n", "\n\n", " "))


@settings(max_examples=60)
@given(
    st.deferred(lambda: st.sampled_from(sorted(models()))),
    st.randoms(use_true_random=False),
    st.sampled_from((0, 0.3)),
)
def test_any_white_space(name, random, comments):
    text = mutated(models()[name], random, comments)
    assume(parsed(text))
    check_layout(text)


@settings(max_examples=12)
@given(st.sampled_from(WHOLE), st.randoms(use_true_random=False), st.sampled_from((0, 0.1)))
def test_any_white_space_keeps_the_meaning(compile_text, text, random, comments):
    text = mutated(text, random, comments, [gap for gap in GAPS if "\n" in gap])
    before = compile_text(text)
    assume(before is not None)
    assert compile_text(check_layout(text)) == before


@settings(max_examples=12)
@given(st.sampled_from(WHOLE), st.randoms(use_true_random=False))
def test_migration_keeps_the_meaning(compile_text, text, random):
    """Statements share lines in any way, as they could before they needed separators."""
    before = compile_text(text)
    assert before is not None
    assert compile_text(layout(mutated(text, random, 0))) == before


SNIPPETS = (
    "package a.b; import pkg.*",
    "const A : int8[<=3] = -3; enum E { A = -1, B }",
    "service S { request { a : std_msgs/Pose } }",
    'controller C extends D { operation f(in x : T, y : T); in a : X on "t" }',
    "member M { p : C { a = 1 } connect a.b -> c }",
    "statemachine M { state S = N(a = f(1, 2)) { on E, F [not a and (b)] -> B } }",
    "statemachine M { state S { on E / x = -1, send E(a = 1) -> B; after 5 s -> T } }",
    "statemachine M { state S { do f(a = 1, b = 2) gives (x => y, z => w); entry / a = 1 } }",
    "statemachine M { choice C { [a] -> B; else / x = 1 -> C } }",
    "swarm S { r : M[1..5] } optimize S { a.b in 1 .. 2 step 3 }",
)


@pytest.mark.parametrize("snippet", SNIPPETS)
def test_a_comment_between_any_two_tokens(snippet):
    """One at a time, so that none hides what another one does."""
    tokens = tokenize(snippet)
    kept = 0
    for comment in COMMENTS:
        for token in tokens[1:]:
            text = f"{snippet[: token.start]}{comment}{snippet[token.start :]}"
            if parsed(text):
                kept += 1
                check_layout(text)
    assert kept > len(COMMENTS) * len(tokens) / 2


@pytest.mark.parametrize("snippet", SNIPPETS)
def test_the_width_of_white_space_does_not_matter(snippet):
    assert layout(snippet.replace(" ", "   ")) == layout(snippet)
