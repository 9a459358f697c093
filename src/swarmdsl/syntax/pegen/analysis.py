"""FIRST sets of a grammar, and checks that a parser can be generated."""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator
from string import ascii_letters
from typing import Any

from swarmdsl.base.records import dataclass
from swarmdsl.syntax.parser.lexer import SYMBOLS
from swarmdsl.syntax.pegen.grammar import (
    Assign,
    Choice,
    Expression,
    Grammar,
    Optional,
    Repetition,
    Sequence,
    Terminal,
    UnsupportedError,
    Use,
    inside,
    parts,
)

try:
    from re import _parser as sre
except ImportError:  # Python 3.10
    import sre_parse as sre

_LETTERS = frozenset(ascii_letters + "_")


@dataclass(frozen=True, slots=True)
class First:
    """FIRST set.

    A token is an ASCII word, an ASCII symbol, or the empty string for all else. The set has
    `tokens` and, if `but` is not None, all words that are not in `but`.
    """

    tokens: frozenset[str] = frozenset()
    but: frozenset[str] | None = None

    def __or__(self, other: First) -> First:
        """Return the union."""
        if self.but is None or other.but is None:
            but = other.but if self.but is None else self.but
        else:
            but = self.but & other.but
        return First(self.tokens | other.tokens, but)

    def has(self, token: str) -> bool:
        """Return True if a token is in the set."""
        return token in self.tokens or (
            self.but is not None and token.isidentifier() and token not in self.but
        )

    def overlaps(self, other: First) -> bool:
        """Return True if the sets have a common token."""
        return (
            (self.but is not None and other.but is not None)
            or any(map(other.has, self.tokens))
            or any(map(self.has, other.tokens))
        )


class Analysis:
    """Analysis of a grammar; raises UnsupportedError if no parser can be generated."""

    def __init__(self, grammar: Grammar) -> None:
        self.grammar = grammar
        self._empty: frozenset[str] = frozenset()
        while (empty := self._matching_nothing()) != self._empty:
            self._empty = empty
        self._firsts: dict[str, First] = {}
        for rule in grammar.rules.values():
            for expression in inside(rule.body):
                self._refuse_surprises(rule.name, expression)
        for name in grammar.rules:
            if name in self._leading(grammar.rules[name].body, set()):
                raise UnsupportedError(name, "it begins with itself")
        uses = {
            name: {part.rule for part in inside(rule.body) if isinstance(part, Use)}
            for name, rule in grammar.rules.items()
        }
        self.recursive = frozenset(name for name in uses if name in _reachable(name, uses))

    def _matching_nothing(self) -> frozenset[str]:
        rules = self.grammar.rules.values()
        return frozenset(rule.name for rule in rules if _nullable(rule.body, self._empty))

    def nullable(self, expression: Expression) -> bool:
        """Return True if an expression can match the empty string."""
        return _nullable(expression, self._empty)

    def first(self, expression: Expression) -> First:
        """Return the FIRST set of an expression, without the empty string."""
        match expression:
            case Terminal():
                return _first_of_terminal(expression)
            case Use(rule):
                if rule not in self._firsts:
                    self._firsts[rule] = self.first(self.grammar.rules[rule].body)
                return self._firsts[rule]
            case Choice(alternatives):
                return _union(map(self.first, alternatives))
            case Sequence(sequence):
                return _union(map(self.first, self._heads(sequence)))
            case Repetition(part) | Optional(part) | Assign(_, _, part):
                return self.first(part)

    def _heads(self, sequence: tuple[Expression, ...]) -> Iterator[Expression]:
        """Yield the parts of a sequence that can come first."""
        for part in sequence:
            yield part
            if not self.nullable(part):
                return

    def _leading(self, expression: Expression, found: set[str]) -> set[str]:
        """Add the rules that an expression can begin with to those found."""
        match expression:
            case Use(rule):
                if rule not in found:
                    found.add(rule)
                    self._leading(self.grammar.rules[rule].body, found)
            case Sequence(sequence):
                for part in self._heads(sequence):
                    self._leading(part, found)
            case _:
                for part in parts(expression):
                    self._leading(part, found)
        return found

    def _refuse_surprises(self, rule: str, expression: Expression) -> None:
        """Reject expressions in which Arpeggio treats an empty match specially."""
        match expression:
            case Terminal(literal='"'):
                raise UnsupportedError(rule, "a quotation mark can only begin a text")
            case Choice(alternatives):
                last = alternatives[-1]
                other = alternatives if not isinstance(last, Repetition) else alternatives[:-1]
                if any(map(self.nullable, other)):
                    raise UnsupportedError(rule, "an alternative matches nothing at all")
            case Repetition(part) if self.nullable(part):
                raise UnsupportedError(rule, "what is repeated matches nothing at all")
            case Optional(part) if self.nullable(part):
                raise UnsupportedError(rule, "what is optional matches nothing at all")


def _nullable(expression: Expression, empty: frozenset[str]) -> bool:
    match expression:
        case Terminal(regex):
            return re.match(regex, "") is not None
        case Use(rule):
            return rule in empty
        case Choice(alternatives):
            return any(_nullable(part, empty) for part in alternatives)
        case Sequence(sequence):
            return all(_nullable(part, empty) for part in sequence)
        case Repetition(part, least):
            return least == 0 or _nullable(part, empty)
        case Assign(_, _, part):
            return _nullable(part, empty)
    return True


def _first_of_terminal(terminal: Terminal) -> First:
    if terminal.is_word:
        return First(frozenset({terminal.literal}))
    if terminal.reserved is not None:
        return First(but=terminal.reserved)
    items = list(sre.parse(terminal.regex))
    if word := _whole_word(items):
        return First(frozenset({word}))
    characters, _ = _first_characters(items)
    tokens = characters & SYMBOLS
    if characters - SYMBOLS:
        tokens |= {""}  # also where letters go on beyond ASCII
    return First(frozenset(tokens), frozenset() if characters & _LETTERS else None)


def _whole_word(items: list[Any]) -> str:
    """Return the word that a regex matches under conditions, or "" if it matches more."""
    if not items or tuple(map(str, items[-1])) != ("AT", "AT_BOUNDARY"):
        return ""
    word = "".join(chr(value) for operator, value in items if str(operator) == "LITERAL")
    others = [item for item in items if str(item[0]) != "LITERAL"]
    if all(_of_item(str(op), value) == (frozenset(), True) for op, value in others):
        return word if word.isascii() and word.isidentifier() else ""
    return ""


# Represents all characters that are not ASCII.
_OTHERS = "\N{SNOWMAN}"
_ALL = frozenset(map(chr, range(128))) | {_OTHERS}


def _first_characters(items: Any) -> tuple[frozenset[str], bool]:
    """Return a superset of the first characters of a regex, and True if it can match nothing."""
    found: frozenset[str] = frozenset()
    for operator, argument in items:
        characters, empty = _of_item(str(operator), argument)
        found |= characters
        if not empty:
            return found, False
    return found, True


def _of_item(operator: str, argument: Any) -> tuple[frozenset[str], bool]:
    match operator:
        case "LITERAL":
            return frozenset({chr(argument) if argument < 128 else _OTHERS}), False
        case "IN":
            return frozenset(filter(_set(argument), _ALL)), False
        case "BRANCH":
            branches = [_first_characters(branch) for branch in argument[1]]
            return frozenset().union(*(b[0] for b in branches)), any(b[1] for b in branches)
        case "SUBPATTERN":
            return _first_characters(argument[3])
        case "MAX_REPEAT" | "MIN_REPEAT":
            characters, empty = _first_characters(argument[2])
            return characters, empty or argument[0] == 0
        case "AT" | "ASSERT" | "ASSERT_NOT":
            return frozenset(), True
    return _ALL, True


def _set(members: Any) -> Any:
    """Return a predicate for a set such as `[^0-9]`; if unsure, it is true outside of ASCII."""
    negated = str(members[0][0]) == "NEGATE"

    def has(character: str) -> bool:
        if character == _OTHERS:
            return negated or any(str(op) != "LITERAL" or value > 127 for op, value in members)
        within = any(_in_member(str(op), value, character) for op, value in members)
        return within != negated

    return has


def _in_member(operator: str, value: Any, character: str) -> bool:
    match operator:
        case "LITERAL":
            return character == chr(value)
        case "RANGE":
            return bool(value[0] <= ord(character) <= value[1])
        case "CATEGORY":
            escape = {"digit": "d", "word": "w", "space": "s"}
            _, *negated, kind = str(value).lower().split("_")
            letter = escape[kind].upper() if negated else escape[kind]
            return re.match(f"\\{letter}", character) is not None
    return False


def _union(firsts: Iterable[First]) -> First:
    found = First()
    for first in firsts:
        found |= first
    return found


def _reachable(name: str, uses: dict[str, set[str]]) -> set[str]:
    found: set[str] = set()
    ahead = list(uses[name])
    while ahead:
        rule = ahead.pop()
        if rule not in found:
            found.add(rule)
            ahead.extend(uses[rule])
    return found
