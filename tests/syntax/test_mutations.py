"""Models with random mistakes: no exception, and what is found is in the file.

What is still a model is emitted for every target and printed, and what can be parsed is
formatted.
"""

from __future__ import annotations

import random
import re
from collections.abc import Callable
from pathlib import Path
from shutil import copytree, ignore_patterns
from time import perf_counter

import pytest

from swarmdsl.base.diagnostics.collector import Diagnostics
from swarmdsl.base.source import Source
from swarmdsl.codegen import registry
from swarmdsl.codegen.emit import Request, emit
from swarmdsl.codegen.swarm_printer.system import UnprintableError, print_system
from swarmdsl.driver import pipeline
from swarmdsl.ir import System
from swarmdsl.syntax.formatter import format_source

from ..targets import COMPOSED

ROOT = Path(__file__).resolve().parents[2]
MODELS = sorted(
    [*(ROOT / "examples").rglob("*.swarm"), *(ROOT / "tests" / "golden").glob("*/model.swarm")]
)
SEEDS = 10
PROFILES = [Request("scxml", {"profile": profile}) for profile in ("portable", "cpswarm")]
OTHERS = [name for name in registry.BUILT_IN if name not in {"scxml", *COMPOSED}]
REQUESTS = [*PROFILES, *map(Request, OTHERS)]
_TOKEN = re.compile(r'"[^"\n]*"|\w+|->|=>|[^\w\s]|\s+')
_CHARACTERS = "{}()[]\"/*\\'-><=.,:;#@0 \n\t\x00\ufeff\u00a0é€"
Mutation = Callable[[str, random.Random], str]


def without_token(text: str, dice: random.Random) -> str:
    tokens = _TOKEN.findall(text)
    del tokens[dice.randrange(len(tokens))]
    return "".join(tokens)


def with_token(text: str, dice: random.Random) -> str:
    tokens = _TOKEN.findall(text)
    tokens.insert(dice.randrange(len(tokens)), dice.choice(tokens))
    return "".join(tokens)


def tokens_swapped(text: str, dice: random.Random) -> str:
    tokens = _TOKEN.findall(text)
    i, j = dice.randrange(len(tokens)), dice.randrange(len(tokens))
    tokens[i], tokens[j] = tokens[j], tokens[i]
    return "".join(tokens)


def word_replaced(text: str, dice: random.Random) -> str:
    words = list(re.finditer(r"\w+", text))
    old, new = dice.choice(words), dice.choice(words)
    return text[: old.start()] + new[0] + text[old.end() :]


def without_line(text: str, dice: random.Random) -> str:
    lines = text.splitlines(keepends=True)
    del lines[dice.randrange(len(lines))]
    return "".join(lines)


def with_line(text: str, dice: random.Random) -> str:
    lines = text.splitlines(keepends=True)
    lines.insert(dice.randrange(len(lines)), dice.choice(lines))
    return "".join(lines)


def without_character(text: str, dice: random.Random) -> str:
    at = dice.randrange(len(text))
    return text[:at] + text[at + 1 :]


def with_character(text: str, dice: random.Random) -> str:
    at = dice.randrange(len(text))
    return text[:at] + dice.choice(_CHARACTERS) + text[at:]


def cut(text: str, dice: random.Random) -> str:
    return text[: dice.randrange(len(text))]


MUTATIONS: list[Mutation] = [
    *(without_token, with_token, tokens_swapped, word_replaced, without_line, with_line),
    *(without_character, with_character, cut),
]


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Copies of the models, each with the files that it imports."""
    root = tmp_path_factory.mktemp("models")
    for part in ("examples", "tests/golden"):
        copytree(ROOT / part, root / part, ignore=ignore_patterns("expected"))
    return root


def emitted(system: System) -> int:
    """Return the number of files that all targets generate; none where one cannot express it."""
    made = 0
    for request in REQUESTS:
        report = Diagnostics()
        made += sum(map(len, emit(system, [request], report).values()))
        assert not {"unknown-target", "bad-option"} & {found.name for found in report}
    return made


def printable(system: System) -> bool:
    """Return True if a system can be printed."""
    try:
        return bool(print_system(system))
    except UnprintableError:
        return False


@pytest.mark.parametrize("seed", range(SEEDS))
def test_mutants(
    seed: int,
    folder: Path,
    pytestconfig: pytest.Config,
    record_property: Callable[[str, object], None],
) -> None:
    dice = random.Random(seed)
    mutants = pytestconfig.getoption("--mutants") // SEEDS
    wrong = unprintable = formatted = files = 0
    slowest = 0.0
    for _ in range(mutants):
        model = dice.choice(MODELS)
        original = text = model.read_text(encoding="utf-8")
        for mutate in dice.choices(MUTATIONS, k=dice.choice((1, 1, 2, 3))):
            text = mutate(text, dice) or " "
        path = folder / model.relative_to(ROOT)
        path.write_text(text, encoding="utf-8")
        start = perf_counter()
        result = pipeline.check([path])
        slowest = max(slowest, perf_counter() - start)
        path.write_text(original, encoding="utf-8")
        formatted += format_source(Source(str(path), text), Diagnostics()) is not None
        if result.system is not None:
            files += emitted(result.system)
            unprintable += not printable(result.system)

        spans = [found.primary.span for found in result.report if found.primary]
        assert all(0 <= span.start <= span.end <= len(span.source.text) for span in spans)
        if result.system is None:
            wrong += 1
            binary = "\x00" in text
            assert binary or [span for span in spans if span.source.path == path], text
    assert wrong > mutants // 3  # the mutations do something
    record_property("mutants", mutants)
    record_property("wrong", wrong)
    record_property("files", files)
    record_property("unprintable", unprintable)
    record_property("formatted", formatted)
    record_property("slowest", slowest)


def test_the_models_are_right(folder: Path) -> None:
    for model in MODELS:
        result = pipeline.check([folder / model.relative_to(ROOT)])
        assert [found for found in result.report if found.severity.value == "error"] == []
