"""Expressions to trees, in one go with the file they stand in.

`grammar/expression.lark` says what binds how, and EXPRESSION in `grammar/lexical.tx` where
an expression ends. Both are followed here at once; tests hold the three against each other.
"""

from __future__ import annotations

from collections.abc import Sequence

from swarmdsl.diagnostics import Diagnostics
from swarmdsl.expressions import (
    MARKS,
    Language,
    Match,
    is_too_large,
    quantity_value,
    unquoted,
)
from swarmdsl.parsed import NESTING_LIMIT
from swarmdsl.precedence import BINDING, NOT, SIGN, Fault, Operation, Operator, join
from swarmdsl.source import Source, Span
from swarmdsl.syntax import (
    Call,
    Expression,
    ExpressionTree,
    FieldUse,
    NameUse,
    Value,
    Word,
    depth,
)

# The tokens that can begin an operator, as a whole or in part.
_OPERATORS = frozenset({*BINDING, "=", "!"})
# Without `/`, which begins the effects of a transition.
_DELAY_OPERATORS = frozenset({"+", "-", "*"})
_PARTS_OF_COMPARISONS = frozenset("=!<>")
_PREFIXES = frozenset({"not", "-"})
_SIMPLE_NUMBER = 9  # characters: no such number is too large

# To call the classes takes longer.
new_node = object.__new__
new_span = tuple.__new__
new_word = str.__new__

# A tree, where it begins and ends with the parentheses around it, the last match of it
# and the match of what follows.
_Found = tuple[ExpressionTree, int, int, Match, Match]


class TooDeepError(Exception):
    """Something is nested deeper than a parser goes."""


class ExpressionParser:
    """Parses the expressions of a file: each method from the match of the first token on.

    A method returns an expression, its last match and the one of what follows; None where
    there is no expression. One that is wrong has no tree, but its first fault is added to
    `faults`. Raises TooDeepError for more parentheses in each other than `limit`.
    """

    __slots__ = (
        *("faults", "_language", "_token", "_not_a_name", "_source", "_text", "_limit"),
        *("_level", "_size", "_fault", "_large"),
    )

    def __init__(self, language: Language, source: Source, limit: int) -> None:
        self.faults: list[Fault] = []
        self._language = language
        self._token = language.token
        self._not_a_name = language.not_a_name
        self._source = source
        self._text = source.text
        self._limit = limit
        self._level = 0
        self._size = 0
        self._fault: Fault | None = None
        self._large: Span | None = None

    def expression(self, ahead: Match) -> tuple[Expression, Match, Match] | None:
        """Parse a whole expression."""
        return self._finished(self._binary(ahead, _OPERATORS))

    def delay(self, ahead: Match) -> tuple[Expression, Match, Match] | None:
        """Parse a delay, which has no division."""
        return self._finished(self._binary(ahead, _DELAY_OPERATORS))

    def operand(self, ahead: Match) -> tuple[Expression, Match, Match] | None:
        """Parse what can stand on one side of an operator."""
        return self._finished(self._binary(ahead, frozenset()))

    def _finished(self, found: _Found | None) -> tuple[Expression, Match, Match] | None:
        if found is None:
            self._fault = self._large = None
            return None
        tree, start, end, behind, ahead = found
        span = tree.span
        if span[1] != start or span[2] != end:  # else it is the same, which is kept once
            span = new_span(Span, (self._source, start, end))
        made = new_node(Expression)
        made.span = span
        if self._size:
            if self._size >= NESTING_LIMIT:
                self._check_depth(tree, span)
            self._size = 0
        if self._fault is None and self._large is not None:
            self._fault = Fault(
                self._large, "syntax-error", {"message": "this number is too large"}
            )
        if self._fault is None:
            made.tree = tree
        else:
            made.tree = None
            self.faults.append(self._fault)
            self._fault = self._large = None
        return made, behind, ahead

    def _check_depth(self, tree: ExpressionTree, span: Span) -> None:
        if self._fault is None and depth(tree) > NESTING_LIMIT:
            help_ = "each operator is a level: store a part of the value in a variable first"
            fields = {"limit": NESTING_LIMIT, "help": help_}
            self._fault = Fault(span, "nested-too-deeply", fields)

    def _binary(self, ahead: Match, operators: frozenset[str]) -> _Found | None:
        """Operands with operators between them, or one operand."""
        prefixes: Sequence[Operator] = ()
        if ahead[1] in _PREFIXES:
            prefixes, ahead = self._prefixes(ahead)
        first = last = self._primary(ahead)
        if last is None or first is None:
            return None
        if last[4][1] not in operators and not prefixes:
            return first
        operations: list[Operation[_Found]] = []
        while last[4][1] in operators:
            operation = self._operation(last[4])
            if operation is None:
                break
            operations.append(operation)
            last = operation[2]
        if not operations and not prefixes:
            return first
        self._size += len(operations) + len(prefixes)
        tree, start, end, fault = join(prefixes, first, operations)
        if fault is not None:
            self._blame(fault)
        return tree, start, end, last[3], last[4]

    def _operation(self, ahead: Match) -> Operation[_Found] | None:
        """An operator with its operand; an operator that none follows is not part of it."""
        token = ahead[1]
        match = ahead
        if token in _PARTS_OF_COMPARISONS:
            comparison = self._language.comparison(self._text, ahead.start())
            if comparison is None:
                return None
            token, match = comparison[1], comparison
        elif token == "-" and self._is_arrow(ahead):
            return None
        before = self._fault, self._large
        prefixes: Sequence[Operator] = ()
        ahead = self._token(self._text, match.end())
        if ahead[1] in _PREFIXES:
            prefixes, ahead = self._prefixes(ahead)
        found = self._primary(ahead)
        if found is None:
            self._fault, self._large = before
            return None
        return (BINDING[token], self._word(match), False), prefixes, found

    def _prefixes(self, ahead: Match) -> tuple[Sequence[Operator], Match]:
        """Each `not` and each sign, and the match of what follows them."""
        prefixes: list[Operator] = []
        while (token := ahead[1]) in _PREFIXES and not (token == "-" and self._is_arrow(ahead)):
            prefixes.append((NOT if token == "not" else SIGN, self._word(ahead), True))
            ahead = self._token(self._text, ahead.end())
        return prefixes, ahead

    def _primary(self, ahead: Match) -> _Found | None:
        """A value, a name, a call, or an expression in parentheses."""
        token = ahead[1]
        if token not in self._not_a_name:
            following = self._token(self._text, ahead.end())
            if following[1] == "(":
                call = self._call(ahead, following)
                if call is not None:
                    return call
            if following[1] == ".":
                return self._path(ahead, following)
            start, end = ahead.span(1)
            name = new_node(NameUse)
            name.span = new_span(Span, (self._source, start, end))
            name.name = token
            name.target = None
            return name, start, end, ahead, following
        start = ahead.start()
        if token == "":
            quantity = self._language.quantity(self._text, start)
            return self._quantity(quantity) if quantity is not None else None
        match token:
            case "event":
                return self._path(ahead, self._token(self._text, ahead.end()))
            case "true" | "false":
                return self._value(ahead, token == "true")
            case '"':
                quoted = self._language.quoted(self._text, start)
                return self._value(quoted, unquoted(quoted[1])) if quoted else None
            case "(":
                return self._parenthesised(ahead)
        return None

    def _parenthesised(self, ahead: Match) -> _Found | None:
        self._descend()
        found = self._binary(self._token(self._text, ahead.end()), _OPERATORS)
        self._level -= 1
        if found is None or found[4][1] != ")":
            return None
        closing = found[4]
        following = self._token(self._text, closing.end())
        return found[0], ahead.start(), closing.end(1), closing, following

    def _call(self, ahead: Match, opening: Match) -> _Found | None:
        """A call; None where what follows the name are no arguments."""
        before = self._fault, self._large
        self._descend()
        arguments: list[ExpressionTree] = []
        following = self._token(self._text, opening.end())
        while following[1] != ")" or arguments:
            if arguments and following[1] != ",":
                break
            begin = self._token(self._text, following.end()) if arguments else following
            found = self._binary(begin, _OPERATORS)
            if found is None:
                break
            arguments.append(found[0])
            following = found[4]
        self._level -= 1
        if following[1] != ")":
            self._fault, self._large = before
            return None
        behind, following = following, self._token(self._text, following.end())
        start, end = ahead.start(), behind.end(1)
        self._size += 1
        tree = Call(self._span(start, end), self._word(ahead), tuple(arguments))
        return tree, start, end, behind, following

    def _path(self, behind: Match, ahead: Match) -> _Found:
        """A name, and fields of what it means."""
        start, end = behind.span(1)
        tree: ExpressionTree = NameUse(self._span(start, end), behind[1])
        while ahead[1] == ".":
            field = self._token(self._text, ahead.end())
            if not field[1] or field[1] in MARKS:
                break
            behind, ahead = field, self._token(self._text, field.end())
            end = behind.end(1)
            tree = FieldUse(self._span(start, end), tree, self._word(behind))
            self._size += 1
        return tree, start, end, behind, ahead

    def _value(self, match: Match, value: bool | float | str, unit: str = "") -> _Found:
        start, end = match.span(1)
        made = new_node(Value)
        made.span = new_span(Span, (self._source, start, end))
        made.value = value
        made.unit = unit
        return made, start, end, match, self._token(self._text, match.end())

    def _quantity(self, match: Match) -> _Found:
        digits, unit = match[2], match[3] or ""
        if len(digits) < _SIMPLE_NUMBER and not unit:
            if digits.isdigit():
                return self._value(match, int(digits))
            if "e" not in digits and "E" not in digits:
                return self._value(match, float(digits))
        if not is_too_large(match[1], digits, unit):
            return self._value(match, quantity_value(digits), unit)
        if self._large is None:
            self._large = self._span(*match.span(1))
        return self._value(match, 0, unit)

    def _is_arrow(self, ahead: Match) -> bool:
        return self._text.startswith("->", ahead.start())

    def _descend(self) -> None:
        self._level += 1
        if self._level > self._limit:
            raise TooDeepError

    def _blame(self, fault: Fault) -> None:
        """Keep what is wrong, if nothing before it is."""
        if self._fault is None or fault.span.start < self._fault.span.start:
            self._fault = fault

    def _word(self, match: Match) -> Word:
        word = new_word(Word, match[1])
        start, end = match.span(1)
        word.span = new_span(Span, (self._source, start, end))
        return word

    def _span(self, start: int, end: int) -> Span:
        return new_span(Span, (self._source, start, end))


def report_fault(language: Language, span: Span, report: Diagnostics) -> None:
    """Report what is wrong with the expression at a span."""
    parser = ExpressionParser(language, span.source, NESTING_LIMIT)
    parser.expression(language.token(span.source.text, span.start))
    for fault in parser.faults:
        report.report(fault.name, fault.span, **fault.fields)
