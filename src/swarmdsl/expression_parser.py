"""Expressions to trees, in one go with the file they stand in.

`grammar/expression.lark` says what binds how, and EXPRESSION in `grammar/lexical.tx` where
an expression ends. Both are followed here at once by operator precedence (shunting-yard);
tests hold the three against each other.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass
from typing import Any

from swarmdsl.diagnostics import Diagnostics
from swarmdsl.expressions import is_too_large, quantity_value, unquoted
from swarmdsl.scan import NESTING_LIMIT
from swarmdsl.source import Source, Span
from swarmdsl.syntax import (
    Call,
    Expression,
    ExpressionTree,
    FieldUse,
    NameUse,
    OperatorUse,
    Value,
    Word,
)

_OR, _AND, _NOT, _COMPARISON, _SUM, _PRODUCT, _SIGN = range(1, 8)
_BINDING = {
    "or": _OR,
    "and": _AND,
    **dict.fromkeys(("+", "-"), _SUM),
    **dict.fromkeys(("*", "/", "%"), _PRODUCT),
    **dict.fromkeys(("==", "!=", "<=", ">=", "<", ">"), _COMPARISON),
}
# The tokens that can begin an operator, as a whole or in part.
_OPERATORS = frozenset({*_BINDING, "=", "!"})
# Without `/`, which begins the effects of a transition.
_DELAY_OPERATORS = frozenset({"+", "-", "*"})
_PARTS_OF_COMPARISONS = frozenset("=!<>")
_MARKS = frozenset("!\"#$%&'()*+,-./:;<=>?@[\\]^`{|}~")
_SIMPLE_NUMBER = 9  # characters: no such number is too large

new_span = tuple.__new__
new_word = str.__new__

# A match of a token with the blanks behind it; group 1 is the token.
Match = re.Match[str]
# A tree, where it begins and ends with the parentheses around it, the last match of it
# and the match of what follows.
_Found = tuple[ExpressionTree, int, int, Match, Match]
# How an operator binds, its word, where it begins if it is a prefix, and whether it is one.
_Operator = tuple[int, Word, int, bool]
# An operator, and the prefixes of the operand behind it.
_Operation = tuple[_Operator, Sequence[_Operator], _Found]
Read = Callable[[Match], tuple[Expression, Match, Match] | None]


class TooDeepError(Exception):
    """Something is nested deeper than a parser goes."""


@dataclass(frozen=True, slots=True)
class Fault:
    """What is wrong with an expression: a diagnostic and its place."""

    span: Span
    name: str
    fields: dict[str, Any]


class Language:
    """The words and blanks of the language, which the grammar of files says."""

    def __init__(self, token: Any, blank: str, reserved: Iterable[str]) -> None:
        self.token: Callable[[str, int], Match] = token
        self.not_a_name = frozenset(reserved) | _MARKS | {""}
        self.quantity = re.compile(
            r"((\d+(?:\.\d+)?(?:[eE][+-]?\d+)?)(?:[ \t]*(us|ms|s|min|h))?)\b(?!\.\d)" + blank
        ).match
        self.quoted = re.compile(r'("(?:[^"\\\n]|\\[^\n])*")' + blank).match
        self.comparison = re.compile("([=!<>]=|<|>)" + blank).match


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
        return self._finished(ahead.start(), self._binary(ahead, _OPERATORS))

    def delay(self, ahead: Match) -> tuple[Expression, Match, Match] | None:
        """Parse a delay, which has no division."""
        return self._finished(ahead.start(), self._binary(ahead, _DELAY_OPERATORS))

    def operand(self, ahead: Match) -> tuple[Expression, Match, Match] | None:
        """Parse what can stand on one side of an operator."""
        return self._finished(ahead.start(), self._binary(ahead, frozenset()))

    def _finished(self, start: int, found: _Found | None) -> tuple[Expression, Match, Match] | None:
        if found is None:
            self._fault = self._large = None
            return None
        tree, _, _, behind, ahead = found
        made = Expression(new_span(Span, (self._source, start, behind.end(1))))
        if self._size >= NESTING_LIMIT:
            self._check_depth(tree, made.span)
        if self._fault is None and self._large is not None:
            self._blame(self._large, "syntax-error", message="this number is too large")
        if self._fault is None:
            made.tree = tree
        else:
            self.faults.append(self._fault)
            self._fault = self._large = None
        self._size = 0
        return made, behind, ahead

    def _check_depth(self, tree: ExpressionTree, span: Span) -> None:
        if self._fault is None and _depth(tree) > NESTING_LIMIT:
            self._blame(
                span,
                "nested-too-deeply",
                limit=NESTING_LIMIT,
                help="each operator is a level: store a part of the value in a variable first",
            )

    def _binary(self, ahead: Match, operators: frozenset[str]) -> _Found | None:
        """Operands with operators between them, or one operand."""
        found = self._operand(ahead)
        if found is None:
            return None
        prefixes, first = found
        operation = self._operation(first[4], operators)
        if prefixes:
            return self._climb(prefixes, first, operation, operators)
        if operation is None:
            return first
        (_, word, _, _), prefixes, second = operation
        if prefixes or second[4][1] in operators:
            return self._climb((), first, operation, operators)
        tree, start, _, _, _ = first
        right, _, end, behind, ahead = second
        self._size += 1
        span = new_span(Span, (self._source, start, end))
        return OperatorUse(span, word, (tree, right)), start, end, behind, ahead

    def _climb(
        self,
        prefixes: Sequence[_Operator],
        operand: _Found,
        operation: _Operation | None,
        operators: frozenset[str],
    ) -> _Found:
        """Join operands by what binds them: prefixes, the first operand, and what follows it."""
        waiting: list[_Operator] = []
        values: list[tuple[ExpressionTree, int, int]] = []
        while True:
            self._place(prefixes, waiting)
            tree, begin, end, behind, ahead = operand
            values.append((tree, begin, end))
            if operation is None:
                break
            operator, prefixes, operand = operation
            self._reduce(waiting, values, operator[0])
            if waiting and waiting[-1][0] == operator[0] == _COMPARISON:
                self._blame(
                    operator[1].span,
                    "syntax-error",
                    message="comparisons cannot be chained",
                    help="join them: `a < b and b < c`",
                )
            waiting.append(operator)
            operation = self._operation(operand[4], operators)
        self._reduce(waiting, values, 0)
        return *values[0], behind, ahead

    def _operation(self, ahead: Match, operators: frozenset[str]) -> _Operation | None:
        """An operator with its operand; an operator that none follows is not part of it."""
        token = ahead[1]
        if token not in operators:
            return None
        match = ahead
        if token in _PARTS_OF_COMPARISONS:
            comparison = self._language.comparison(self._text, ahead.start())
            if comparison is None:
                return None
            token, match = comparison[1], comparison
        elif token == "-" and self._is_arrow(ahead):
            return None
        before = self._fault, self._large
        found = self._operand(self._token(self._text, match.end()))
        if found is None:
            self._fault, self._large = before
            return None
        return (_BINDING[token], self._word(match), 0, False), *found

    def _operand(self, ahead: Match) -> tuple[Sequence[_Operator], _Found] | None:
        """Prefixes and what they stand before."""
        token = ahead[1]
        if token != "not" and token != "-":
            found = self._primary(ahead)
            return ((), found) if found is not None else None
        prefixes: list[_Operator] = []
        while token == "not" or (token == "-" and not self._is_arrow(ahead)):
            binding = _NOT if token == "not" else _SIGN
            prefixes.append((binding, self._word(ahead), ahead.start(), True))
            ahead = self._token(self._text, ahead.end())
            token = ahead[1]
        found = self._primary(ahead)
        return (prefixes, found) if found is not None else None

    def _place(self, prefixes: Sequence[_Operator], waiting: list[_Operator]) -> None:
        """Let prefixes wait for their operand."""
        for prefix in prefixes:
            if prefix[0] == _NOT and waiting and waiting[-1][0] > _NOT:
                self._blame(
                    prefix[1].span,
                    "syntax-error",
                    message="`not` cannot stand here",
                    help="put parentheses around it and what it negates",
                )
            waiting.append(prefix)

    def _reduce(
        self,
        waiting: list[_Operator],
        values: list[tuple[ExpressionTree, int, int]],
        binding: int,
    ) -> None:
        """Join what binds more than what comes next, or as much unless it does not chain."""
        while waiting and waiting[-1][0] >= binding:
            if waiting[-1][0] == binding == _COMPARISON:
                return
            _, word, start, is_prefix = waiting.pop()
            right, _, end = values.pop()
            operands: tuple[ExpressionTree, ...] = (right,)
            if not is_prefix:
                left, start, _ = values.pop()
                operands = (left, right)
            values.append((OperatorUse(self._span(start, end), word, operands), start, end))
            self._size += 1

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
            span = new_span(Span, (self._source, start, end))
            return NameUse(span, token), start, end, ahead, following
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
        behind, following = opening, self._token(self._text, opening.end())
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
        tree: ExpressionTree = NameUse(new_span(Span, (self._source, start, end)), behind[1])
        while ahead[1] == ".":
            field = self._token(self._text, ahead.end())
            if not field[1] or field[1] in _MARKS:
                break
            behind, ahead = field, self._token(self._text, field.end())
            end = behind.end(1)
            tree = FieldUse(self._span(start, end), tree, self._word(behind))
            self._size += 1
        return tree, start, end, behind, ahead

    def _value(self, match: Match, value: bool | float | str, unit: str = "") -> _Found:
        start, end = match.span(1)
        span = new_span(Span, (self._source, start, end))
        return Value(span, value, unit), start, end, match, self._token(self._text, match.end())

    def _quantity(self, match: Match) -> _Found:
        digits, unit = match[2], match[3] or ""
        if len(digits) < _SIMPLE_NUMBER and not unit and digits.isdigit():
            return self._value(match, int(digits))
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

    def _blame(self, span: Span, name: str, **fields: Any) -> None:
        """Keep what is wrong, if nothing before it is."""
        if self._fault is None or span.start < self._fault.span.start:
            self._fault = Fault(span, name, fields)

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


def _depth(tree: ExpressionTree) -> int:
    """How many operations and fields stand in each other, at most."""
    depth, level = 0, [tree]
    while level:
        depth += 1
        level = [inner for outer in level for inner in _inside(outer)]
    return depth


def _inside(tree: ExpressionTree) -> tuple[ExpressionTree, ...]:
    match tree:
        case OperatorUse(operands=operands):
            return operands
        case Call(arguments=arguments):
            return arguments
        case FieldUse(base=base):
            return (base,)
    return ()
