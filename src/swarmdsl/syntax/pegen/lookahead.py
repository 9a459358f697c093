"""Tests of the next token in a generated parser, and their constants."""

from __future__ import annotations

from collections.abc import Collection, Iterator

from swarmdsl.base.records import dataclass, field
from swarmdsl.syntax.parser.lexer import SYMBOLS
from swarmdsl.syntax.pegen.analysis import Analysis, First
from swarmdsl.syntax.pegen.grammar import (
    Assign,
    Choice,
    Expression,
    Rule,
    Terminal,
    UnsupportedError,
    Use,
    inside,
)

# Words and numbers; what goes on beyond ASCII is one token, too.
_LETTER, _PART = r"[^\x00-@\[-^`{-\x7f]", r"[^\x00-/:-@\[-^`{-\x7f]"
_WORDS = (f"{_LETTER}{_PART}*", rf"[0-9]+(?:\.[0-9]+)?{_PART}*")
# A comment without an end is looked for only once.
_REST = (r"/\*(?s:.*\S)?", "(?s:.)")
# Compiled where it is used first: a file has few of them.
_REGEX = """
def {name}(text, at):
    global {name}
    {name} = re.compile({regex!r}, re.MULTILINE).match
    return {name}(text, at)
"""


@dataclass
class Lookahead:
    """Constants of a parser: regular expressions, sets of tokens, tables of functions by token.

    `nodes` are the rules that have functions; `attempts` are functions for several rules.
    """

    analysis: Analysis
    nodes: Collection[str]
    tables: dict[str, str] = field(default_factory=dict)
    attempts: dict[tuple[str, ...], str] = field(default_factory=dict)
    _regexes: dict[str, str] = field(default_factory=dict)
    _sets: dict[frozenset[str], str] = field(default_factory=dict)

    def constants(self) -> list[str]:
        """Return the lines that define the regular expressions and sets."""
        grammar = self.analysis.grammar
        return [
            f"BLANK = {grammar.blank!r}",
            "BLANKS = re.compile(BLANK).match",
            f"LEXER = Lexer({grammar.spaces!r}, re.compile({self._tokens()!r}).findall, BLANKS)",
            *(_REGEX.format(name=name, regex=regex) for regex, name in self._regexes.items()),
            *(f"{name} = frozenset({sorted(members)!r})" for members, name in self._sets.items()),
        ]

    def _tokens(self) -> str:
        """Return a regular expression for the next token, with the blanks before it."""
        grammar = self.analysis.grammar
        terminals = (
            part
            for rule in grammar.rules.values()
            for part in inside(rule.body)
            if isinstance(part, Terminal)
        )
        texts = sorted({part.regex for part in terminals if part.regex.startswith('"')})
        tokens = "|".join([*_WORDS, *texts, *_REST])
        return rf"{grammar.no_comment}(?:{tokens}|\Z)"

    def is_token(self, part: Expression) -> bool:
        """Return True if the expression matches exactly one token."""
        match part:
            case Terminal():
                return part.is_word or part.is_symbol or part.reserved is not None
            case Use(rule):
                found = self.analysis.grammar.rules[rule]
                return found.kind == "text" and self.is_token(found.body)
            case Choice(parts):
                return all(map(self.is_token, parts))
        return False

    def is_sure(self, part: Expression) -> bool:
        """Return True if an expression matches whenever the next token can begin it."""
        if isinstance(part, Assign):
            return part.refers is None and self.is_token(part.part)
        return self.is_token(part)

    def test(self, first: First) -> str:
        """Return a test whether the next token is in a FIRST set.

        Words and a few symbols are not less than `A`, all other tokens are: that test is fast.
        """
        words_and_marks = first.tokens - {""}
        if first.but is not None:
            others = (SYMBOLS | first.but) - first.tokens
            if "" in first.tokens:
                return f"token not in {self._set(others)}"
            test = f"token >= 'A' and token not in {self._set(others)}"
            words_and_marks = frozenset(token for token in words_and_marks if token < "A")
        elif "" in first.tokens:
            test = f"token < 'A' and token not in {self._set(SYMBOLS)}"
        else:
            return self._is_in(words_and_marks)
        return f"({self._is_in(words_and_marks)} or {test})" if words_and_marks else test

    def _is_in(self, members: frozenset[str]) -> str:
        if len(members) == 1:
            return f"token == {min(members)!r}"
        return f"token in {self._set(members)}"

    def _set(self, members: frozenset[str]) -> str:
        return self._sets.setdefault(members, f"SET{len(self._sets)}")

    def regex(self, regex: str) -> str:
        """Return the name of the function that matches a regular expression."""
        return self._regexes.setdefault(regex, f"REGEX{len(self._regexes)}")

    def is_choice(self, part: Expression) -> bool:
        """Return True for a choice between rules, which a table decides."""
        return isinstance(part, Use) and self.analysis.grammar.rules[part.rule].kind == "choice"

    def is_asked_before(self, rule: str) -> bool:
        """Return True if callers test the first token of a rule before they call its function.

        Functions of other rules test it themselves.
        """
        first = self.analysis.first(Use(rule))
        asked = rule != self.analysis.grammar.start and not self.analysis.nullable(Use(rule))
        return asked and first.but is None and "" not in first.tokens

    def table(self, rule: Rule) -> tuple[str, bool]:
        """Return the table look-up for the next token, and True if it always finds a function."""
        table = f"{rule.name}_RULES"
        leaves = list(self._leaves(rule))
        firsts = {leaf: self.analysis.first(Use(leaf)) for leaf in leaves}
        others = tuple(
            leaf for leaf in leaves if firsts[leaf].but is not None or "" in firsts[leaf].tokens
        )
        if table not in self.tables:
            tokens = sorted(set().union(*(first.tokens for first in firsts.values())) - {""})
            entries = {
                token: self._attempt(tuple(leaf for leaf in leaves if firsts[leaf].has(token)))
                for token in tokens
            }
            content = ", ".join(f"{token!r}: {function}" for token, function in entries.items())
            self.tables[table] = f"{{{content}}}"
        if others:
            return f"{table}.get(token, {self._attempt(others)})", True
        return f"{table}.get(token)", False

    def _leaves(self, rule: Rule) -> Iterator[str]:
        """Yield the node rules of a choice, nested choices included."""
        assert isinstance(rule.body, Choice)
        for part in rule.body.parts:
            assert isinstance(part, Use)
            inner = self.analysis.grammar.rules[part.rule]
            if inner.kind == "choice":
                yield from self._leaves(inner)
            elif inner.name in self.nodes:
                yield inner.name
            else:
                raise UnsupportedError(rule.name, f"{inner.name} does not make a node")

    def _attempt(self, rules: tuple[str, ...]) -> str:
        """Return the name of the function that tries rules in order."""
        if len(rules) == 1:
            return f"r_{rules[0]}"
        return self.attempts.setdefault(rules, "try_" + "_".join(rules))
