"""Random sentences of a grammar."""

from __future__ import annotations

import re
from collections.abc import Iterator
from functools import cache
from random import Random
from typing import Any

from swarmdsl.syntax.pegen.analysis import sre
from swarmdsl.syntax.pegen.grammar import (
    Assign,
    Choice,
    Expression,
    Grammar,
    Optional,
    Repetition,
    Sequence,
    Terminal,
    Use,
    inside,
)

_DEEP = 16
# Tokens after which a sentence ends as soon as it can: the parsers need seconds for long ones.
_LONG = 150
_GAPS = [" "] * 12 + ["", "", "\n", "  // a comment\n", " /* * / */ ", "\t\r\n"]
_NEVER = 10**6


class Sentences:
    """Makes sentences of a grammar; `produced` are the rules that had a part in them."""

    def __init__(self, grammar: Grammar, dice: Random) -> None:
        self.produced: set[str] = set()
        self._grammar = grammar
        self._dice = dice
        self._tokens = 0
        self._heights = _heights(grammar)
        self._reachable = {rule: reachable(grammar, rule) for rule in grammar.rules}

    def sentence(self, rule: str) -> str:
        """A sentence of a rule; rules that had no part in one yet are preferred."""
        self._tokens = 0
        return "".join(text + self._dice.choice(_GAPS) for text in self._texts(Use(rule), 0))

    def _is_new(self, expression: Expression) -> bool:
        """Return True if a rule in it has had no part yet."""
        uses = {part.rule for part in inside(expression) if isinstance(part, Use)}
        return any(not self._reachable[rule] <= self.produced for rule in uses)

    def _texts(self, expression: Expression, depth: int) -> Iterator[str]:
        deep = depth > _DEEP or self._tokens > _LONG
        match expression:
            case Terminal(regex, literal):
                self._tokens += 1
                yield literal or sample(regex, self._dice)
            case Use(rule):
                self.produced.add(rule)
                yield from self._texts(self._grammar.rules[rule].body, depth + 1)
            case Sequence(parts):
                for part in parts:
                    yield from self._texts(part, depth)
            case Choice(parts):
                lowest = min(_height(part, self._heights) for part in parts)
                low = [part for part in parts if _height(part, self._heights) == lowest]
                new = [part for part in parts if self._is_new(part)]
                if deep:
                    choice = self._dice.choice(low)
                else:
                    choice = self._dice.choice(new if new and self._dice.random() < 0.5 else parts)
                yield from self._texts(choice, depth)
            case Optional(part):
                if not deep and (self._dice.random() < 0.5 or self._is_new(part)):
                    yield from self._texts(part, depth)
            case Assign(_, _, part):
                yield from self._texts(part, depth)
            case Repetition(part, least, separator):
                most = least if deep else 3
                if not deep and self._is_new(part):
                    least = 1
                for number in range(self._dice.randint(least, most)):
                    if number and separator:
                        yield from self._texts(separator, depth)
                    yield from self._texts(part, depth)


def reachable(grammar: Grammar, start: str) -> set[str]:
    """A rule and all that it needs."""
    found = [start]
    for name in found:  # which grows meanwhile
        for part in inside(grammar.rules[name].body):
            if isinstance(part, Use) and part.rule not in found:
                found.append(part.rule)
    return set(found)


def _heights(grammar: Grammar) -> dict[str, int]:
    """Return the minimal depth of each rule."""
    heights = dict.fromkeys(grammar.rules, _NEVER)
    while True:
        found = {
            name: min(_NEVER, 1 + _height(rule.body, heights))
            for name, rule in grammar.rules.items()
        }
        if found == heights:
            return heights
        heights = found


def _height(expression: Expression, heights: dict[str, int]) -> int:
    match expression:
        case Use(rule):
            return heights[rule]
        case Sequence(parts):
            return max(_height(part, heights) for part in parts)
        case Choice(parts):
            return min(_height(part, heights) for part in parts)
        case Assign(_, _, part):
            return _height(part, heights)
        case Repetition(part, 1):
            return _height(part, heights)
    return 0


@cache
def _parsed(regex: str) -> Any:
    return sre.parse(regex)


def sample(regex: str, dice: Random) -> str:
    """A random text that a regular expression matches."""
    while True:
        text = "".join(_pieces(_parsed(regex), dice))
        # Lookaheads may refuse it, and lookbehinds ask for a word and a blank before it.
        if any(re.compile(regex).fullmatch(before + text, len(before)) for before in ("", "a ")):
            return text
        if all(str(operator) == "ASSERT" for operator, _ in _parsed(regex)):
            return ""  # what is around it decides, which the parsers have to agree on


def _pieces(items: Any, dice: Random) -> Iterator[str]:
    for operator, argument in items:
        match str(operator):
            case "LITERAL":
                yield chr(argument)
            case "IN":
                yield dice.choice(_members(argument))
            case "BRANCH":
                yield from _pieces(dice.choice(argument[1]), dice)
            case "SUBPATTERN":
                yield from _pieces(argument[3], dice)
            case "MAX_REPEAT":
                least, most, inner = argument
                for _ in range(dice.randint(least, min(int(most), least + 2))):
                    yield from _pieces(inner, dice)
            case "NOT_LITERAL":
                yield dice.choice([each for each in "ab 1*/" if ord(each) != argument])
            case "AT" | "ASSERT" | "ASSERT_NOT":
                pass
            case other:
                raise NotImplementedError(other)


@cache
def _alphabet(members: str) -> list[str]:
    return [each for each in map(chr, range(32, 127)) if re.match(members, each)]


def _members(argument: Any) -> list[str]:
    found: set[str] = set()
    negated = False
    for operator, value in argument:
        match str(operator):
            case "NEGATE":
                negated = True
            case "LITERAL":
                found.add(chr(value))
            case "RANGE":
                found.update(map(chr, range(value[0], value[1] + 1)))
            case "CATEGORY":
                found.update(
                    _alphabet({"CATEGORY_DIGIT": r"\d", "CATEGORY_SPACE": r"\s"}[str(value)])
                )
    return sorted(set(map(chr, range(32, 127))) - found if negated else found)
