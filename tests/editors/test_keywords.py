"""The TextMate grammar has exactly the keywords of the textX grammar."""

from __future__ import annotations

import json
import re
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest

from swarmdsl.syntax.types import PRIMITIVES

GRAMMAR = Path(__file__).resolve().parents[2] / "editors/vscode/syntaxes/swarm.tmLanguage.json"


def words(regex: str) -> set[str]:
    """Return the words that a regex matches literally."""
    no_classes = re.sub(r"\[(?:\\.|[^\]\\])*\]", " ", regex)
    return set(re.findall(r"[A-Za-z]\w*", re.sub(r"\\.", " ", no_classes)))


def regexes(rule: Any) -> Iterator[str]:
    if isinstance(rule, dict):
        yield from (rule[key] for key in ("match", "begin", "end") if key in rule)
        rule = list(rule.values())
    if isinstance(rule, list):
        for inner in rule:
            yield from regexes(inner)


@pytest.fixture(scope="module")
def textmate() -> Any:
    return json.loads(GRAMMAR.read_text(encoding="utf-8"))


@pytest.fixture(scope="module")
def coloured(textmate: Any) -> set[str]:
    return set().union(*map(words, regexes(textmate)))


def test_words_of_a_regex() -> None:
    assert words(r"\b(?:on|int8)\s+[A-Za-z_]\w*(?=\s*x)[^\]b]$") == {"on", "int8", "x"}


def test_the_language_has_keywords_of_both_kinds(language: Any) -> None:
    assert {"state", "on", "swarm"} <= language.keywords & language.reserved
    assert {"goal", "by", "world"} <= language.contextual


def test_every_keyword_is_highlighted(language: Any, coloured: set[str]) -> None:
    assert (language.keywords | language.reserved) - coloured == set()


def test_only_words_of_the_language_are_highlighted(
    language: Any, coloured: set[str], textmate: Any
) -> None:
    units = words(language.regexes["QUANTITY"]) | words(language.regexes["LENGTH"])
    known = language.keywords | language.reserved | units | set(PRIMITIVES)
    escapes = set().union(*map(words, regexes(textmate["repository"]["escape"])))
    assert coloured - known == escapes == {"u", "U"}


def test_every_unit_is_highlighted(language: Any, textmate: Any) -> None:
    repository = textmate["repository"]
    for name, regex in (("quantity", "QUANTITY"), ("environment", "LENGTH")):
        spelled = set().union(*map(words, regexes(repository[name])))
        assert words(language.regexes[regex]) - spelled == set()


def test_reserved_words_are_the_same(language: Any, textmate: Any) -> None:
    assert words(textmate["repository"]["reserved"]["match"]) == language.reserved


def test_primitive_types_are_the_same(textmate: Any) -> None:
    (primitive,) = (
        pattern["match"]
        for pattern in textmate["repository"]["type-name"]["patterns"]
        if pattern["name"] == "support.type.primitive.swarm"
    )
    assert words(primitive) == set(PRIMITIVES)
