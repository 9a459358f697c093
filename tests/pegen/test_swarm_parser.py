"""The generated parser says the same as textX and Lark: of models, mutants and sentences."""

from __future__ import annotations

import os
import random
import re
import subprocess
import sys
from collections.abc import Iterable
from functools import cache
from itertools import pairwise
from pathlib import Path

import pytest

from swarmdsl.base.source import Source
from swarmdsl.syntax.ast import Expression, walk
from swarmdsl.syntax.parser import generated
from swarmdsl.syntax.parser.expressions import TooDeepError
from swarmdsl.syntax.parser.failure_finder import mismatch
from swarmdsl.syntax.parser.result import NESTING_LIMIT
from swarmdsl.syntax.pegen.grammar import Use, inside, read
from swarmdsl.syntax.pegen.outputs import PARSER
from swarmdsl.syntax.pegen.swarm_actions import TARGET

from ..docs.pages import blocks
from ..syntax.test_mutations import MUTATIONS
from . import oracle
from .sentences import Sentences, reachable

ROOT = Path(__file__).resolve().parents[2]
FOLDERS = ("examples", "tests", "src/swarmdsl/project/library")
SEEDS = 3
_START = re.compile(r"^(?=[a-z])", re.MULTILINE)


@cache
def models() -> list[str]:
    """Return all models: examples, tests, documentation."""
    paths = [path for folder in FOLDERS for path in sorted((ROOT / folder).rglob("*.swarm"))]
    if "SWARMDSL_CORPUS" in os.environ:
        paths += sorted(Path(os.environ["SWARMDSL_CORPUS"]).rglob("*.swarm"))
    texts = [path.read_bytes().decode("utf-8", "replace") for path in paths if path.is_file()]
    return ["", *texts, *(block.text for block in blocks("swarm"))]


def pieces(texts: Iterable[str]) -> list[str]:
    """The declarations in models: what is wrong in one is wrong soon."""
    found = []
    for text in texts:
        starts = [0, *(start.start() for start in _START.finditer(text)), len(text)]
        found += [text[start:end] for start, end in pairwise(starts) if text[start:end].strip()]
    return found


def check_same(text: str) -> bool:
    """Parse a text both ways and compare; return True if it is a model."""
    try:
        made = generated.parse(Source("model.swarm", text), {}, NESTING_LIMIT)
    except TooDeepError:
        assert sum(map(text.count, "{([")) > NESTING_LIMIT
        return False
    expected = oracle.parse(text)
    if made is None:
        assert isinstance(expected, oracle.Refused), text
        check_same_refusal(text, expected)
        return False
    assert isinstance(expected, oracle.Expected), text
    model, wrong = made
    model.span = expected.model.span
    assert list(oracle.differences(expected.model, model)) == [], text
    assert wrong == len(expected.wrong), text
    treeless = {
        (node.span.start, node.span.end)
        for node in walk(model)
        if isinstance(node, Expression) and node.tree is None
    }
    assert treeless == expected.wrong, text
    return True


def check_same_refusal(text: str, expected: oracle.Refused) -> None:
    """Compare where the two stop, and what could come there."""
    found = mismatch(generated.PROGRAM, generated.TERMINALS, generated.BLANK, text)
    assert found is not None, text
    assert found.at == expected.at, text
    terminals = {
        (name, "" if name == "EOF" else literal or regex) for regex, name, literal in found.expected
    }
    assert terminals == expected.expected, text


def test_a_token_is_not_asked_twice_what_it_is() -> None:
    twice = re.compile(r"if (token == '\w+'):\n\s+if not \(\1\)")
    assert not twice.search(PARSER.read_text(encoding="utf-8"))


def test_models() -> None:
    accepted = [check_same(text) for text in models()]

    assert sum(accepted) > 100
    assert not all(accepted)


@pytest.mark.parametrize("odd", "\x00\x0b\x0c\x1c\x1f\x7f\x85\xa0\xaa\xe9\u0663\u2028\u2009")
def test_characters_that_the_language_does_not_have(odd: str) -> None:
    for template in (
        "event A~ : B",
        "event ~A : B",
        "const A : T = ~1",
        "const A : T = 1~",
        "const A : T = 2.5~",
        "const A : T = 5 s~",
        "const A : T = ~b.c",
        "const A : T = -~ 1",
        'import ~"a.swarm"',
        'import "a~.swarm" // ~',
        "enum E { A = ~3 B = -3~ }",
        "struct S { a : B[~3] b : C/~D }",
        "swarm S { a : B[1..~3] }",
        "event A : B~",
        "const A : T = -/*1~\n\n",
        "~",
    ):
        check_same(template.replace("~", odd))


@pytest.mark.parametrize("seed", range(SEEDS))
def test_mutants(seed: int, pytestconfig: pytest.Config) -> None:
    dice = random.Random(seed)
    originals = pieces(models())
    count = max(500, pytestconfig.getoption("--mutants") // SEEDS)
    accepted = 0
    for _ in range(count):
        text = dice.choice(originals)
        for mutate in dice.choices(MUTATIONS, k=dice.choice((1, 1, 2, 3))):
            if re.search(r"\w", text):
                text = mutate(text, dice)
        accepted += check_same(text)

    assert count // 20 < accepted < count // 2


@pytest.mark.parametrize("seed", range(SEEDS))
def test_sentences(seed: int, pytestconfig: pytest.Config) -> None:
    grammar = read(oracle.metamodel())
    sentences = Sentences(grammar, random.Random(seed))
    rules = grammar.rules["Declaration"].body
    starts = [part.rule for part in inside(rules) if isinstance(part, Use)]
    starts += [grammar.start, "StateMachine"]
    count = max(600, pytestconfig.getoption("--mutants") // SEEDS)
    accepted = sum(check_same(sentences.sentence(starts[n % len(starts)])) for n in range(count))

    assert accepted > count // 3
    assert sentences.produced == reachable(grammar, grammar.start)


def test_the_oracle_sees_differences() -> None:
    one, other = oracle.parse("const A : T = b"), oracle.parse("const A : T = c")
    moved = oracle.parse("const  A : T = b")
    assert isinstance(one, oracle.Expected)
    assert isinstance(other, oracle.Expected)
    assert isinstance(moved, oracle.Expected)

    assert list(oracle.differences(one.model, one.model)) == []
    assert list(oracle.differences(one.model, other.model)) == [
        "model.declarations[0].value.tree.name: 'b' and 'c'"
    ]
    assert len(list(oracle.differences(one.model, moved.model))) > 1


@pytest.mark.parametrize(
    "text",
    [
        "statemachine M { " + "state S { " * 10_000 + "}" * 10_001,
        "statemachine M { " + "parallel state S { region R { " * 5_000 + "}" * 10_001,
        "const A : T = " + "(" * 10_000 + "1" + ")" * 10_000,
        "const A : T = " + "f(" * 10_000 + "1" + ")" * 10_000,
    ],
    ids=["states", "regions", "parentheses", "calls"],
)
def test_too_deep(text: str) -> None:
    with pytest.raises(TooDeepError):
        generated.parse(Source("model.swarm", text), {}, NESTING_LIMIT)


@pytest.mark.parametrize(
    ("text", "wrong"),
    [
        ("const A : T = " + "not " * 10_000 + "b", 1),
        ("const A : T = " + "- " * 10_000 + "b", 1),
        ("const A : T = b" + " + b" * 10_000, 1),
        ("const A : T = b" + ".b" * 10_000, 1),
        ("event A : B\n" * 10_000, 0),
        ("statemachine M { " + "state S " * 10_000 + "}", 0),
    ],
    ids=["not", "minus", "plus", "fields", "events", "states"],
)
def test_much_of_something(text: str, wrong: int) -> None:
    made = generated.parse(Source("model.swarm", text), {}, NESTING_LIMIT)

    assert made is not None
    assert made[1] == wrong


def test_documentation_is_given_to_what_begins_there() -> None:
    text = "event A : B\nstatemachine M {\n  state S {\n    on A -> S\n  }\n}\n"
    docs = {text.index("state S"): "A state.", text.index("on A"): "A transition.", 3: "Nobody."}
    made = generated.parse(Source("model.swarm", text), docs, NESTING_LIMIT)

    assert made is not None
    documented = [node for node in walk(made[0]) if getattr(node, "doc", "")]
    assert [type(node).__name__ for node in documented] == ["State", "Transition"]
    assert docs == {3: "Nobody."}


def test_it_needs_neither_textx_nor_lark() -> None:
    code = (
        "import sys; import swarmdsl.syntax.parse; "
        "assert not {'textx', 'arpeggio', 'lark'} & set(sys.modules)"
    )
    assert subprocess.run([sys.executable, "-c", code]).returncode == 0


def test_its_rules_are_those_that_make_something() -> None:
    grammar = read(oracle.metamodel())
    nodes = {name for name, rule in grammar.rules.items() if rule.kind == "node"}

    assert nodes - set(TARGET.nodes) == {*TARGET.words, *TARGET.written} - {"Expression"}
