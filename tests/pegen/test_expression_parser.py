"""Expressions are what Lark makes of them, in whatever place, and so is what is wrong with them."""

from __future__ import annotations

import random
import re

import pytest
from hypothesis import given
from hypothesis import strategies as st
from lark.exceptions import UnexpectedInput

from swarmdsl.base.diagnostics.collector import Diagnostic, Diagnostics
from swarmdsl.base.source import Source, Span
from swarmdsl.syntax.parser import generated
from swarmdsl.syntax.parser.expressions import ExpressionParser, report_fault
from swarmdsl.syntax.parser.result import NESTING_LIMIT
from swarmdsl.syntax.pegen.grammar import read

from ..syntax.test_mutations import MUTATIONS
from . import oracle
from .sentences import Sentences

SEEDS, SENTENCES = 2, 150
LEXER = (
    *("and", "or", "not", "true", "false", "event", "a", "b1", "min", "on", "s", "x", "->", "=>"),
    *("==", "!=", "<=", ">=", "<", ">", "=", "+", "-", "*", "/", "%", ".", "..", ",", "(", ")"),
    *("1", "2.5", "1e3", "3 s", "10 min", "1.2.3", "007", '"text"', r'"\"\n"', "/* */", "[", "]"),
)
# Where expressions stand, and what is around them.
PLACES = (
    "const A : T = {}",
    "statemachine M {{ state S {{ on E [{}] / x = {} -> T }} }}",
    "statemachine M {{ state S {{ after {} / x = {} -> T }} }}",
    "statemachine M {{ state S {{ on E / send F(a = {}), {} = b }} }}",
    "optimize S {{ count of a in {} .. {} b.c in {} .. {} step {} }}",
)


def check_same(text: str) -> bool:
    """Parse a text with expressions both ways and compare; return True if it has no errors."""
    made = generated.parse(Source("model.swarm", text), {}, NESTING_LIMIT)
    expected = oracle.parse(text)
    assert (made is None) == isinstance(expected, oracle.Refused), text
    if made is None or isinstance(expected, oracle.Refused):
        return False
    made[0].span = expected.model.span
    assert list(oracle.differences(expected.model, made[0])) == [], text
    return not expected.wrong


def filled(place: str, expressions: list[str]) -> str:
    return place.format(*expressions)


@pytest.mark.parametrize("seed", range(SEEDS))
def test_sentences_and_mutants(seed: int) -> None:
    dice = random.Random(seed)
    sentences = Sentences(read(oracle.metamodel()), dice)
    right = 0
    for _ in range(SENTENCES):
        expressions = [sentences.sentence("EXPRESSION") for _ in range(5)]
        right += check_same(filled(dice.choice(PLACES), expressions))
        mutants = [
            dice.choice(MUTATIONS)(text, dice) if re.search(r"\w", text) else text
            for text in expressions
        ]
        check_same(filled(dice.choice(PLACES), mutants))
    assert 1 < right < SENTENCES


@given(
    st.sampled_from(PLACES),
    st.lists(st.lists(st.sampled_from(LEXER), min_size=1, max_size=9), min_size=5, max_size=5),
)
def test_random_tokens(place: str, expressions: list[list[str]]) -> None:
    check_same(filled(place, [" ".join(tokens) for tokens in expressions]))


OPERAND = st.sampled_from(("a", "1", "2 s", '"t"', "true", "event.x", "f(a, b)", "not a", "-a"))
OPERATOR = st.sampled_from(("and", "or", "==", "<", "+", "-", "*", "%", "and not", "or -"))


@given(
    st.recursive(
        OPERAND,
        lambda inner: st.one_of(
            st.builds("{} {} {}".format, inner, OPERATOR, inner),
            st.builds("({})".format, inner),
            st.builds("not {}".format, inner),
            st.builds("f({}, {})".format, inner, inner),
        ),
        max_leaves=25,
    )
)
def test_precedence(text: str) -> None:
    check_same(f"const A : T = {text}")
    check_same_faults(text)


def faults(text: str) -> list[Diagnostic]:
    source = Source("", text)
    report = Diagnostics()
    report_fault(generated.LANGUAGE, Span(source, 0, len(text)), report)
    return list(report)


def check_same_faults(text: str) -> None:
    """The first fault is where Lark stops."""
    found = [fault.primary for fault in faults(text) if fault.name == "syntax-error"]
    place = lark_error(text)
    assert [each.span.start for each in found if each] == ([] if place is None else [place]), text


def lark_error(text: str) -> int | None:
    """The offset at which Lark stops."""
    try:
        oracle.expressions().parse(text)
    except UnexpectedInput as error:
        return error.pos_in_stream
    return None


@pytest.mark.parametrize(
    ("text", "place", "message"),
    [
        ("a < b < c", "<", "comparisons cannot be chained"),
        ("a + not b", "not", "`not` must be in parentheses here"),
        ("- not b", "not", "`not` must be in parentheses here"),
        ("(a < not b) < c < d", "not", "`not` must be in parentheses here"),
        ("f(18446744073709551616)", "18446744073709551616", "this number is too large"),
        ("1e999 + 1e999", "1e999", "this number is too large"),
        ("1e300 h", "1e300 h", "this number is too large"),
        ("9223372037 s", "9223372037 s", "this number is too large"),
    ],
)
def test_faults(text: str, place: str, message: str) -> None:
    (fault,) = faults(text)

    assert fault.primary is not None
    assert fault.primary.span.text == place
    assert fault.message == message


@pytest.mark.parametrize("text", ["a < b", "18446744073709551615", "9223372036 s", "not not a"])
def test_no_faults(text: str) -> None:
    assert faults(text) == []


@pytest.mark.parametrize("levels", [NESTING_LIMIT - 1, NESTING_LIMIT])
@pytest.mark.parametrize("text", ["a" + " + a", "a" + ".b", "not a"])
def test_levels(text: str, levels: int) -> None:
    head, tail = (text[0], text[1:]) if text[0] == "a" else ("", "")
    deep = head + tail * levels if head else "not " * levels + "a"
    found = [fault.name for fault in faults(deep)]

    assert found == (["nested-too-deeply"] if levels == NESTING_LIMIT else [])
    assert (oracle.expression_tree(Span(Source("", deep), 0, len(deep))) is None) == bool(found)


def test_what_failed_leaves_no_fault_behind() -> None:
    source = Source("", "a + (b < c < d")  # the expression is `a`
    tokens = generated.LEXER.tokenize(source.text)
    parser = ExpressionParser(generated.LANGUAGE, source, tokens, NESTING_LIMIT)
    found = parser.expression(0)

    assert found is not None
    assert found[0].span.text == "a"
    assert parser.faults == []
