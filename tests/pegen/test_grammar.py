"""A parser for any grammar follows the PEG, or the generator rejects the grammar."""

from __future__ import annotations

import re
from dataclasses import make_dataclass
from itertools import product
from typing import Any

import pytest
from textx import TextXSyntaxError, metamodel_from_str

from swarmdsl.base.source import Source, Span
from swarmdsl.syntax.ast import Ref, Word
from swarmdsl.syntax.parser.expressions import TooDeepError
from swarmdsl.syntax.parser.failure_finder import mismatch
from swarmdsl.syntax.parser.lexer import Lexer
from swarmdsl.syntax.pegen.actions import Target
from swarmdsl.syntax.pegen.grammar import Grammar, UnsupportedError, read
from swarmdsl.syntax.pegen.module import definitions

NAME = r"N: /(?!(?:no)\b)[A-Za-z_][A-Za-z0-9_]*\b/;"


def grammar_of(text: str) -> Grammar:
    return read(metamodel_from_str(text, autokwd=True))


@pytest.mark.parametrize(
    ("text", "reason"),
    [
        ("M: a=X; X: !'b' 'c';", "X: Not is not supported"),
        ("M: a=X; X: &'b' 'c';", "X: And is not supported"),
        ("M: ('a' 'b')#;", "M: UnorderedGroup is not supported"),
        ("M: a=ID;", "M: the built-in type ID is not supported"),
        ("M: a=X; X: 'b' INT;", "X: the built-in type INT is not supported"),
        ("M[noskipws]: a='a';", "M: `skipws` is not supported"),
        ("M[ws=' ']: a='a';", "M: `ws` is not supported"),
        ("M: a+='a'[eolterm];", "M: `eolterm` is not supported"),
        ("M: a=X; X: 'b'- 'c';", "X: `suppress` is not supported"),
        ("M: a=X; X: Y; Y: 'b' | 'c';", "X: it is Y by another name"),
        ("M: a=X; X: X 'b' | 'c';", "X: it begins with itself"),
        ("M: a=X; X: 'b'? Y; Y: X 'c' | 'd';", "X: it begins with itself"),
        ("M: a=X; X: 'a'? | 'b';", "X: an alternative matches nothing at all"),
        ("M: a=X; X: ('a'? 'b'?)*  'c';", "X: what is repeated matches nothing at all"),
        ("M: a=X; X: (/a*/)? 'c';", "X: what is optional matches nothing at all"),
        ("M: a=X; X: 'b' | Y 'c'; Y: b='c';", "X: what it chooses from has to be rules"),
        ("M: a=X; X: 'b' ('c' 'd')*;", "M: a text is too complicated"),
        ("M: a='a' Y; Y: b='c';", "M: what Y makes is not used"),
    ],
)
def test_what_is_not_supported(text: str, reason: str) -> None:
    with pytest.raises(UnsupportedError, match=re.escape(reason)):
        made(text)


def made(text: str) -> Any:
    """The definitions of a parser for a grammar, with classes made for its nodes."""
    grammar = grammar_of(text)
    nodes = {
        name: {attribute: f"{attribute}_" for attribute in rule.attributes}
        for name, rule in grammar.rules.items()
        if rule.kind == "node"
    }
    source, _ = definitions(grammar, Target(nodes, {}, {}))
    names: dict[str, Any] = {
        name: make_dataclass(name, ["span", *attributes]) for name, attributes in nodes.items()
    }
    names |= {"re": re, "Span": Span, "Word": Word, "Ref": Ref, "TooDeepError": TooDeepError}
    names["Lexer"] = Lexer
    exec(f"from __future__ import annotations\n{source}", names)
    return names


def plain(value: Any, attributes: dict[str, tuple[str, ...]]) -> Any:
    """A node as plain data, whoever made it."""
    name = type(value).__name__
    if isinstance(value, list):
        return [plain(item, attributes) for item in value]
    if name in attributes:
        inner = [plain(getattr(value, part), attributes) for part in attributes[name]]
        place = (
            value.span[1:]
            if hasattr(value, "span")
            else (value._tx_position, value._tx_position_end)
        )
        return name, tuple(place), inner
    return value


@pytest.mark.parametrize(
    ("text", "words"),
    [
        # Alternatives that begin alike: the first that fits is taken, and no other later.
        ("M: xs+=C 'end'; C: A | B; A: 'a' x='x'? ; B: 'a' x='x' y='y';", "a x y end"),
        ("M: (a='a' ('b' 'c')? | b='a' 'b' 'd') e='e'?;", "a b c d e"),
        ("M: ('a' x='b' | 'a' y='c' | z='d')  w='a'?;", "a b c d"),
        # What fails half-way has left nothing behind.
        ("M: ('a' xs+='b' 'c')? ('a' ys+='b' 'd')?;", "a b c d"),
        ("M: (xs+='a' 'b' 'c')* ys*='a' 'b'?;", "a b c"),
        ("M: xs+='a'[','] (',' y='b')?;", "a b ,"),
        ("M: xs*='a'[','] 'b'? ys*='c'[',' ];", "a b c ,"),
        ("M: ('x' (xs+='a' | ys+='b')* 'y')? 'x'? zs*='a';", "x a b y"),
        ("M: (a='a' b='b'?)* ;", "a b"),
        ("M: a?='a' b?='a' c='b'?;", "a b"),
        # Names and words.
        ("M: xs+=S; S: 'no' x=N | y=N '.' z=N | y=N;" + NAME, "no a . nobody"),
        ("M: ('a' x=N)? 'a' y=N? ('.' z=N)?;" + NAME, "a b . no"),
        ("M: xs*=P ys*=Q; P: n=N ':' ; Q: n=N '=' m=N;" + NAME, "a : = b"),
        # A list that may be empty as an alternative.
        ("M: '(' (by='by' | xs*=N[',']) ')';" + NAME, "( by a , )"),
        ("M: a=X b=X?; X: 'a' | '-' | /\\d+/;", "a - 1 b"),
        # Rules in themselves.
        ("M: x=E; E: '(' inner=E ')' | n=N;" + NAME, "( ) a"),
        ("M: xs*=S; S: A | B; A: 's' ('{' xs*=S '}')?; B: 't' '{' x=S '}';", "s t { }"),
    ],
)
def test_it_does_what_textx_does(text: str, words: str) -> None:
    metamodel = metamodel_from_str(text, autokwd=True)
    names = made(text)
    grammar = grammar_of(text)
    attributes = {name: tuple(rule.attributes) for name, rule in grammar.rules.items()}
    accepted = 0
    for length in range(1, 7):
        for chosen in product(words.split(), repeat=length):
            sentence = " ".join(chosen)
            model = names["parse"](Source("", sentence), {}, 64)
            failure = mismatch(names["PROGRAM"], names["TERMINALS"], names["BLANK"], sentence)
            assert (model is None) == (failure is not None), sentence
            if model is None:
                with pytest.raises(TextXSyntaxError) as refused:
                    metamodel.model_from_str(sentence)
                assert failure.at == refused.value.__cause__.position, sentence
                continue
            expected = metamodel.model_from_str(sentence)
            assert plain(model[0], attributes) == plain(expected, attributes), sentence
            accepted += 1
    assert accepted > 2


def test_case_is_not_ignored() -> None:
    with pytest.raises(UnsupportedError, match="ignore_case is not supported"):
        read(metamodel_from_str("M: a='a';", ignore_case=True))
