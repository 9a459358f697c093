"""Keywords of a grammar by their role: reserved or contextual, first words of blocks, modifiers.

Everything is derived from the rules; what they cannot tell is an annotation in a comment of
grammar/lexical.tx, e.g. `// @line-start: in out inout`.
"""

from __future__ import annotations

import itertools
import re
from collections import defaultdict
from collections.abc import Iterable, Iterator, Mapping
from pathlib import Path
from typing import NamedTuple

from swarmdsl.syntax.pegen.analysis import Analysis, First
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
)

_ANNOTATION = re.compile(r"^// @([a-z-]+): ([a-z ]+)$", re.MULTILINE)
_MODULE = '''\
"""Keywords by role: made from grammar/*.tx by `make parser`, not to be edited."""

from __future__ import annotations

# Words that cannot be names.
RESERVED = frozenset({reserved})
# Words that are keywords only where the grammar expects them, with a pattern of what follows them.
CONTEXTUAL = {contextual}
# The first keywords of the alternatives of a rule.
FIRST = {first}
# Keywords of sections of a file: of its header, its declarations, its optimizations.
TOP_LEVEL = frozenset({top_level})
# Keywords of items in blocks that begin a statement anywhere on a line.
STATEMENTS = frozenset({statements})
# Keywords before the keyword of a statement, by the keywords that can follow them.
MODIFIERS = {modifiers}
# Keywords of optional clauses, by the first keywords of the statements that have them.
CLAUSES = {clauses}
# Keywords that the name of a new element follows.
NAMING = frozenset({naming})
# Keywords by what they are for, where that is more special than a declaration.
GROUPS = {groups}
# Keywords of declarations that can follow `:`, as categories.
CATEGORIES = frozenset({categories})
# Keywords that a name can follow.
BEFORE_NAMES = frozenset({before_names})
'''


class Dialect(NamedTuple):
    """Syntax of regular expressions: a group, its alternatives, the end of a word."""

    opening: str
    separator: str
    closing: str
    word_end: str

    def group(self, patterns: Iterable[str]) -> str:
        """Pattern of one of several."""
        return f"{self.opening}{self.separator.join(patterns)}{self.closing}"


PYTHON_REGEX = Dialect("(?:", "|", ")", r"\b")
VIM_REGEX = Dialect(r"\%(", r"\|", r"\)", r"\>")
EMACS_REGEX = Dialect(r"\(?:", r"\|", r"\)", r"\_>")

# Rules, by what their words are for; words of all other rules declare something.
_GROUPS = {
    "include": ("Package", "ImportRos", "ImportFile", "ImportLibrary"),
    "statement": (
        *("Transition", "Branch", "Activity", "Send", "Objective", "Goal", "Setting"),
        *("SettingName", "SubjectTo", "CountRange", "ParamRange", "World", "Size"),
        *("DoneTrigger", "TimeTrigger", "MonitorTrigger"),
        *("DeliverySetting", "DeliveryFlag", "BestEffort", "DeliveryLimit"),
    ),
    "outcome": ("Outcome",),
    "operator": ("OPERATOR", "PREFIX"),
    "boolean": ("PRIMARY",),
}


class Keywords:
    """Roles of the keywords of a grammar."""

    def __init__(self, grammar: Grammar, annotations: Mapping[str, frozenset[str]]) -> None:
        self._grammar = grammar
        self._analysis = Analysis(grammar)
        words = {
            part.literal
            for rule in grammar.rules.values()
            for part in inside(rule.body)
            if isinstance(part, Terminal) and part.is_word
        }
        reserved = (
            part.reserved or frozenset()
            for rule in grammar.rules.values()
            for part in inside(rule.body)
            if isinstance(part, Terminal)
        )
        self.reserved = frozenset[str]().union(*reserved)
        self.contextual = words - self.reserved
        self.after = self._follow_sets()
        sections = {p.rule for p in inside(grammar.rules[grammar.start].body) if isinstance(p, Use)}
        self.first = {
            rule.name: self._words(Use(rule.name))
            for rule in grammar.rules.values()
            if (rule.kind == "choice" or rule.name in sections) and self._words(Use(rule.name))
        }
        self.top_level = self._words(Use(grammar.start))
        items = frozenset[str]().union(*map(self._words, self._items()))
        self.modifiers = dict(self._modifiers(self.top_level | items))
        annotated = annotations.get("line-start", frozenset())
        if unknown := annotated - items:
            raise UnsupportedError("IDENT", f"@line-start: {min(unknown)} begins no item")
        statements = (items & self.reserved) - self.top_level - annotated
        self.statements = statements | {
            word for word, targets in self.modifiers.items() if targets & statements
        }
        self.clauses = dict(self._clauses())
        self.categories = frozenset(self._categories())
        self.naming = frozenset(self._naming()) - self.modifiers.keys()
        self.groups = {
            group: frozenset[str]().union(*(words & self._inside(name) for name in names))
            for group, names in _GROUPS.items()
        }
        self.before_names = frozenset(
            word for word, after in self.after.items() if after.but is not None
        )

    def source(self) -> str:
        """Source of the module of tables."""
        first = {name: sorted(words) for name, words in sorted(self.first.items())}
        contextual = {word: self.context(word, PYTHON_REGEX) for word in sorted(self.contextual)}
        return _MODULE.format(
            reserved=_listed(self.reserved),
            contextual=_patterns(contextual),
            first=_table(first),
            top_level=_listed(self.top_level),
            statements=_listed(self.statements),
            modifiers=_table({k: sorted(v) for k, v in sorted(self.modifiers.items())}),
            clauses=_table({k: sorted(v) for k, v in sorted(self.clauses.items())}),
            naming=_listed(self.naming),
            groups=_table({k: sorted(v) for k, v in self.groups.items()}),
            categories=_listed(self.categories),
            before_names=_listed(self.before_names),
        )

    def context(self, word: str, dialect: Dialect) -> str:
        """Pattern of the tokens that can follow a keyword, for editors to tell it from a name."""
        after = self.after[word]
        words = frozenset(filter(str.isalpha, after.tokens))
        # A word before `(` is mostly the name of an argument or a call, where values can follow.
        # Where `*` can follow, too, it is before claims.
        values = (after.but is not None or "" in after.tokens) and "*" not in after.tokens
        symbols = "".join(sorted(after.tokens - words - set("[-(" if values else "[-")))
        if after.but is not None:
            symbols, words = f"{symbols}A-Za-z_", frozenset()
        if "" in after.tokens:
            symbols += '0-9"'
        symbols += "".join(
            f"\\{mark}" if mark == "[" else mark for mark in "[-" if mark in after.tokens
        )
        if not symbols and not words:
            return dialect.group(["[,;}]", "$"])  # it ends an item or a statement
        found = [dialect.group(sorted(words)) + dialect.word_end] if words else []
        if symbols:
            found.append(f"[{symbols}]")
        return found[0] if len(found) == 1 else dialect.group(found)

    def _words(self, expression: Expression) -> frozenset[str]:
        return frozenset(filter(str.isalpha, self._analysis.first(expression).tokens))

    def _items(self) -> Iterator[Expression]:
        """Rules of the items of blocks: what is repeated between braces."""
        for rule in self._grammar.rules.values():
            for sequence in inside(rule.body):
                if not isinstance(sequence, Sequence):
                    continue
                parts = sequence.parts
                for opener, part in itertools.pairwise(parts):
                    if not (isinstance(opener, Terminal) and opener.literal == "{"):
                        continue
                    if not isinstance(part, Repetition):
                        continue
                    for item in inside(part):
                        if isinstance(item, Use) and item.rule in self.first:
                            yield item

    def _modifiers(self, first: frozenset[str]) -> Iterator[tuple[str, frozenset[str]]]:
        """Keywords, or flags, that begin a rule before another first keyword."""
        for rule in self._grammar.rules.values():
            rest = list(rule.body.parts) if isinstance(rule.body, Sequence) else []
            is_flag = True
            while is_flag and rest:
                head = rest.pop(0)
                if isinstance(head, Optional):
                    head = head.part
                is_flag = isinstance(head, Assign) and head.kind == "flag"
                if isinstance(head, Assign) and is_flag:
                    head = head.part
                if isinstance(head, Terminal) and head.literal in first and rest:
                    following = self._words(Sequence(tuple(rest))) & first
                    if following and (is_flag or not isinstance(rest[0], Assign)):
                        yield head.literal, following

    def _clauses(self) -> Iterator[tuple[str, frozenset[str]]]:
        """Yield reserved words that begin an optional clause, with the statements that have it."""
        found: dict[str, frozenset[str]] = defaultdict(frozenset)
        for rule in self._grammar.rules.values():
            for sequence in inside(rule.body):
                if rule.kind == "node" and isinstance(sequence, Sequence):
                    for part in sequence.parts[1:]:
                        if isinstance(part, Optional):
                            for word in self._words(part) & self.reserved:
                                found[word] |= self._words(Use(rule.name))
        yield from found.items()

    def _inside(self, rule: str) -> frozenset[str]:
        """All words that a rule spells out."""
        if rule not in self._grammar.rules:
            raise UnsupportedError(
                rule, f"there is no such rule, but {Path(__file__).name} names it"
            )
        body = self._grammar.rules[rule].body
        return frozenset(part.literal for part in inside(body) if isinstance(part, Terminal))

    def _naming(self) -> Iterator[str]:
        for rule in self._grammar.rules.values():
            if isinstance(rule.body, Sequence):
                parts = rule.body.parts
                for before, part in itertools.pairwise(parts):
                    named = isinstance(part, Assign) and part.part == Use("Name")
                    words = self._words(before)
                    if named and (words <= self.top_level or ":" not in self._inside(rule.name)):
                        yield from words

    def _categories(self) -> Iterator[str]:
        for rule in self._grammar.rules.values():
            for sequence in inside(rule.body):
                if isinstance(sequence, Sequence):
                    parts = sequence.parts
                    for before, part in itertools.pairwise(parts):
                        if isinstance(before, Terminal) and before.literal == ":":
                            yield from self._words(part) & self.top_level

    def _follow_sets(self) -> dict[str, First]:
        """Tokens that can follow each keyword, by a walk over all rules up to a fixpoint."""
        after: dict[str, First] = defaultdict(First)
        of_rule: dict[str, First] = defaultdict(First)
        first, nullable = self._analysis.first, self._analysis.nullable

        def visit(expression: Expression, follow: First) -> None:
            match expression:
                case Terminal(literal=word):
                    if expression.is_word:
                        after[word] |= follow
                case Use(rule):
                    of_rule[rule] |= follow
                case Assign(_, _, part) | Optional(part):
                    visit(part, follow)
                case Choice(parts):
                    for part in parts:
                        visit(part, follow)
                case Sequence(parts):
                    for part in reversed(parts):
                        visit(part, follow)
                        follow = first(part) | (follow if nullable(part) else First())
                case Repetition(part, _, separator):
                    visit(part, follow | first(separator or part))
                    if separator is not None:
                        visit(separator, first(part))

        before: dict[str, First] | None = None
        while before != of_rule:
            before = dict(of_rule)
            for rule in self._grammar.rules.values():
                # After a statement anything can come.
                visit(rule.body, First() if rule.kind == "node" else of_rule[rule.name])
        return after


def read_annotations(folder: Path) -> dict[str, frozenset[str]]:
    """Annotations in comments of the grammar, by name."""
    text = (folder / "lexical.tx").read_text(encoding="utf-8")
    return {name: frozenset(words.split()) for name, words in _ANNOTATION.findall(text)}


def _listed(words: Iterable[str]) -> str:
    return f"[{', '.join(map(repr, sorted(words)))}]"


def _patterns(rows: Mapping[str, str]) -> str:
    return "{\n" + "".join(f"    {key!r}: {value!r},\n" for key, value in rows.items()) + "}"


def _table(rows: Mapping[str, Iterable[str]]) -> str:
    lines = (f"    {key!r}: frozenset({_listed(words)}),\n" for key, words in rows.items())
    return "{\n" + "".join(lines) + "}"
