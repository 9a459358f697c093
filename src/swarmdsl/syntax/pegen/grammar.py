"""Read a textX grammar as parsing expressions.

textX represents a grammar as a model of Arpeggio, a PEG (B. Ford, Parsing Expression Grammars,
2004). Features that a language with words, spaces and comments does not need are rejected.
"""

from __future__ import annotations

import re
from collections.abc import Iterator
from typing import Any, Literal

import arpeggio
from textx.const import MULT_ONEORMORE, MULT_ZEROORMORE, RULE_ABSTRACT, RULE_MATCH
from textx.lang import ALL_TYPE_NAMES, BASE_TYPE_NAMES

from swarmdsl.base.records import dataclass
from swarmdsl.syntax.parser.lexer import SYMBOLS

WORD = r"[A-Za-z_][A-Za-z0-9_]*\b"
_NAME = re.compile(r"(?:\(\?!\(\?:([a-z|]+)\)\\b\))?" + re.escape(WORD))
_ASCII_WORD = re.compile(r"[A-Za-z_][A-Za-z0-9_]*").fullmatch
_ASSIGNMENT = "__asgn"
# Modifiers of rules and repetitions, and their default values.
_MODIFIERS = {
    **dict.fromkeys(("ws", "skipws"), (None,)),
    **dict.fromkeys(("eolterm", "suppress", "ignore_case"), (None, False)),
}


class UnsupportedError(Exception):
    """Raised for a grammar for which no parser can be generated."""

    def __init__(self, rule: str, what: str) -> None:
        super().__init__(f"grammar rule {rule}: {what}")


@dataclass(frozen=True, slots=True)
class Terminal:
    """Regular expression; `literal` is its string if it is one, `name` the name of its rule."""

    regex: str
    literal: str = ""
    name: str = ""

    @property
    def is_word(self) -> bool:
        """Return True for a keyword."""
        return self.regex == self.literal + r"\b"

    @property
    def is_symbol(self) -> bool:
        """Return True for a single ASCII symbol."""
        return self.literal in SYMBOLS

    @property
    def is_symbols(self) -> bool:
        """Return True for several adjacent symbols, such as an arrow."""
        return len(self.literal) > 1 and SYMBOLS.issuperset(self.literal)

    @property
    def reserved(self) -> frozenset[str] | None:
        """Reserved words if it is an identifier, else None."""
        found = _NAME.fullmatch(self.regex)
        return frozenset((found[1] or "").split("|")) - {""} if found else None


@dataclass(frozen=True, slots=True)
class Use:
    """Use of another rule."""

    rule: str


@dataclass(frozen=True, slots=True)
class Sequence:
    """Sequence of expressions."""

    parts: tuple[Expression, ...]


@dataclass(frozen=True, slots=True)
class Choice:
    """Ordered choice."""

    parts: tuple[Expression, ...]


@dataclass(frozen=True, slots=True)
class Optional:
    """Optional expression."""

    part: Expression


@dataclass(frozen=True, slots=True)
class Repetition:
    """Repetition, at least `least` times (0 or 1)."""

    part: Expression
    least: int
    separator: Terminal | None


@dataclass(frozen=True, slots=True)
class Assign:
    """Assignment to an attribute: a value, one of many, or a flag.

    `refers` is the class that a name refers to.
    """

    attribute: str
    kind: Literal["value", "many", "flag"]
    part: Terminal | Use
    refers: str | None = None


Expression = Terminal | Use | Sequence | Choice | Optional | Repetition | Assign


@dataclass(frozen=True, slots=True)
class Rule:
    """Rule for a `node`, a `choice` between nodes, or a `text`.

    A missing attribute is None, or the empty string if its value is a `word`.
    """

    name: str
    kind: Literal["node", "choice", "text"]
    body: Expression
    attributes: dict[str, Literal["value", "word", "many", "flag"]]


@dataclass(frozen=True, slots=True)
class Grammar:
    """Rules by name.

    `spaces` are characters; `blank` matches spaces and comments; `no_comment` is equivalent, and
    faster without comments.
    """

    rules: dict[str, Rule]
    start: str
    spaces: str
    blank: str
    no_comment: str


def read(metamodel: Any) -> Grammar:
    """Read the grammar of a textX metamodel; raises UnsupportedError for what is not supported."""
    blueprint = metamodel._parser_blueprint
    comment = blueprint.comments_model
    if blueprint.ignore_case:
        raise UnsupportedError(
            blueprint.parser_model.nodes[0].rule_name, "ignore_case is not supported"
        )
    if comment is not None and not isinstance(comment, arpeggio.RegExMatch):
        raise UnsupportedError("Comment", "it has to be one regular expression")
    blank = no_comment = space = f"[{re.escape(blueprint.ws)}]*"
    if comment is not None:
        blank = f"{space}(?:(?:{comment.to_match_regex}){space})*"
        no_comment = f"{space}(?:(?:{comment.to_match_regex}){blank}|)"
    rules = {}
    for cls in metamodel:
        name = cls.__name__
        if name not in ALL_TYPE_NAMES and cls._tx_peg_rule is not comment:
            rules[name] = _Reader(cls).rule()
    start = blueprint.parser_model.nodes[0].rule_name
    return Grammar(rules, start, blueprint.ws, blank, no_comment)


def _kind(attribute: Any) -> Literal["value", "word", "many", "flag"]:
    if attribute.mult in (MULT_ZEROORMORE, MULT_ONEORMORE):
        return "many"
    if attribute.bool_assignment:
        return "flag"
    return "word" if attribute.cls.__name__ in BASE_TYPE_NAMES else "value"


class _Reader:
    def __init__(self, cls: Any) -> None:
        self._cls = cls
        self._name: str = cls.__name__

    def rule(self) -> Rule:
        """Read the rule of the class."""
        cls, body = self._cls, self._cls._tx_peg_rule
        if body.rule_name != self._name:
            raise self._unsupported(f"it is {body.rule_name} by another name")
        kind: Literal["node", "choice", "text"] = "node"
        if cls._tx_type == RULE_ABSTRACT:
            kind = "choice"
        elif cls._tx_type == RULE_MATCH:
            kind = "text"
        attributes = {name: _kind(attribute) for name, attribute in cls._tx_attrs.items()}
        read = self._expression(body, top=True)
        if kind == "choice" and not (
            isinstance(read, Choice) and all(isinstance(part, Use) for part in read.parts)
        ):
            raise self._unsupported("what it chooses from has to be rules")
        return Rule(self._name, kind, read, attributes)

    def _expression(self, made: Any, *, top: bool = False) -> Expression:
        if made.rule_name.startswith(_ASSIGNMENT):
            return self._assignment(made)
        if made.root and not top:
            if made.rule_name in ALL_TYPE_NAMES:
                raise self._unsupported(f"the built-in type {made.rule_name} is not supported")
            return Use(made.rule_name)
        self._refuse_modifiers(made)
        match made:
            case arpeggio.EndOfFile():
                raise self._unsupported("EOF is not supported")
            case arpeggio.Match():
                return self._terminal(made)
            case arpeggio.OrderedChoice():
                return Choice(tuple(map(self._expression, made.nodes)))
            case arpeggio.Sequence():
                parts = tuple(map(self._expression, made.nodes))
                return parts[0] if len(parts) == 1 else Sequence(parts)
            case arpeggio.Optional():
                return Optional(self._expression(made.nodes[0]))
            case arpeggio.ZeroOrMore() | arpeggio.OneOrMore():
                return self._repetition(made, self._expression(made.nodes[0]))
        raise self._unsupported(f"{type(made).__name__} is not supported")

    def _assignment(self, made: Any) -> Expression:
        self._refuse_modifiers(made)
        attribute = self._cls._tx_attrs[made._attr_name]
        part = self._expression(made.nodes[0])
        if not isinstance(part, (Terminal, Use)):
            raise self._unsupported(f"the value of {attribute.name} has to be a rule or a word")
        refers = attribute.cls.__name__ if attribute.ref and not attribute.cont else None
        match made.rule_name.removeprefix(_ASSIGNMENT):
            case "_plain":
                many = attribute.mult in (MULT_ZEROORMORE, MULT_ONEORMORE)
                return Assign(attribute.name, "many" if many else "value", part, refers)
            case "_optional":
                return Optional(Assign(attribute.name, "flag", part))
        return self._repetition(made, Assign(attribute.name, "many", part, refers))

    def _repetition(self, made: Any, part: Expression) -> Repetition:
        separator = self._expression(made.sep) if made.sep else None
        assert separator is None or isinstance(separator, Terminal)  # textX knows no others
        if separator is None:
            part = _flattened(part)
        return Repetition(part, 1 if isinstance(made, arpeggio.OneOrMore) else 0, separator)

    def _terminal(self, made: Any) -> Terminal:
        name = made.rule_name if made.root else ""
        if isinstance(made, arpeggio.StrMatch):
            return Terminal(re.escape(made.to_match), made.to_match, name)
        if made.explicit_flags != re.MULTILINE or made.regex.flags & re.IGNORECASE:
            raise self._unsupported("flags of regular expressions are not supported")
        keyword = made.to_match_regex == made.to_match + r"\b" and _ASCII_WORD(made.to_match)
        return Terminal(made.to_match_regex, made.to_match if keyword else "", name)

    def _refuse_modifiers(self, made: Any) -> None:
        for modifier, usual in _MODIFIERS.items():
            if getattr(made, modifier, None) not in usual:
                raise self._unsupported(f"`{modifier}` is not supported")

    def _unsupported(self, what: str) -> UnsupportedError:
        return UnsupportedError(self._name, what)


def _flattened(repeated: Expression) -> Expression:
    """Replace `x+ y?` in a repetition by `x y?`, which matches the same."""
    match repeated:
        case Choice(parts):
            return Choice(tuple(map(_flattened, parts)))
        case Sequence((Repetition(part, 1, None), *others)) if all(
            isinstance(other, Optional) for other in others
        ):
            return Sequence((part, *others))
    return repeated


def parts(expression: Expression) -> tuple[Expression, ...]:
    """Return the direct parts of an expression."""
    match expression:
        case Sequence(parts) | Choice(parts):
            return parts
        case Repetition(part, _, separator):
            return (part, separator) if separator else (part,)
        case Optional(part) | Assign(_, _, part):
            return (part,)
    return ()


def inside(expression: Expression) -> Iterator[Expression]:
    """Yield an expression and all parts in it."""
    yield expression
    for part in parts(expression):
        yield from inside(part)
