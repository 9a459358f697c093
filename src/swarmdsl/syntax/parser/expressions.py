"""Parser of expressions, which the generated parser calls.

`grammar/expression.lark` defines precedence, and EXPRESSION in `grammar/lexical.tx` the end of an
expression. This parser follows both; tests compare the three.
"""

from __future__ import annotations

import re
from collections.abc import Sequence

from swarmdsl.base.diagnostics.collector import Diagnostics
from swarmdsl.base.source import Source, Span
from swarmdsl.syntax.ast import (
    NEIGHBORS,
    Call,
    Construction,
    Elapsed,
    Element,
    Expression,
    ExpressionTree,
    FieldUse,
    FieldValue,
    IndexUse,
    InState,
    NameUse,
    Query,
    Ref,
    TypeRef,
    Value,
    Vertex,
    Word,
    depth,
)
from swarmdsl.syntax.parser.lexer import SYMBOLS, Tokens
from swarmdsl.syntax.parser.literals import (
    Language,
    is_out_of_range,
    quantity_value,
    unquoted,
)
from swarmdsl.syntax.parser.precedence import BINDING, NOT, SIGN, Fault, Operation, Operator, join
from swarmdsl.syntax.parser.result import NESTING_LIMIT
from swarmdsl.syntax.units import UNITS

# Tokens that can begin an operator.
_OPERATORS = frozenset({*BINDING, "=", "!"})
# Without `/`, which begins the effects of a transition.
_DELAY_OPERATORS = frozenset({"+", "-", "*"})
_PARTS_OF_COMPARISONS = frozenset("=!<>")
_PREFIXES = frozenset({"not", "-"})
# A number may continue with the first; an expression after a number or a name with the second.
_IN_NUMBERS = {name.partition("/")[0] for name in UNITS} | {"."}
_CONTINUATIONS = _OPERATORS | _IN_NUMBERS | {"(", "[", "within"}
_SIMPLE_NUMBER = 9  # digits: no such number is too large

# To call the classes takes longer.
new_node = object.__new__
new_span = tuple.__new__
new_word = str.__new__

# A tree, its start and end including parentheses, and the index of the next token.
_Found = tuple[ExpressionTree, int, int, int]


class TooDeepError(Exception):
    """Raised for nesting beyond the limit of the parser."""


class ExpressionParser:
    """Parser of the expressions of a file.

    Each method takes the index of a token, and returns an expression and the index of the token
    after it, or None if there is no expression. A wrong expression has no tree, and its first
    fault is in `faults`. Raises TooDeepError for more nested parentheses than `limit`.
    """

    __slots__ = (
        *("faults", "_language", "_not_a_name", "_tokens", "_ends", "_source"),
        *("_limit", "_level", "_size", "_fault", "_large"),
    )

    def __init__(self, language: Language, source: Source, tokens: Tokens, limit: int) -> None:
        self.faults: list[Fault] = []
        self._language = language
        self._not_a_name = language.not_a_name
        self._tokens, self._ends = tokens
        self._source = source
        self._limit = limit
        self._level = 0
        self._size = 0
        self._fault: Fault | None = None
        self._large: Span | None = None

    def expression(self, at: int) -> tuple[Expression, int] | None:
        """Parse a whole expression."""
        return self._simple(at) or self._finished(self._binary(at, _OPERATORS))

    def delay(self, at: int) -> tuple[Expression, int] | None:
        """Parse a delay, which has no division."""
        return self._finished(self._binary(at, _DELAY_OPERATORS))

    def operand(self, at: int) -> tuple[Expression, int] | None:
        """Parse an operand of an operator."""
        return self._simple(at) or self._finished(self._binary(at, frozenset()))

    def _simple(self, at: int) -> tuple[Expression, int] | None:
        """Parse an expression of one token, as most are."""
        tokens = self._tokens
        token = tokens[at]
        at += 1
        if tokens[at] in _CONTINUATIONS:
            return None
        tree: ExpressionTree
        if token >= "A":
            if token in self._not_a_name:
                return None
            tree = new_node(NameUse)
            tree.name = token
            tree.target = None
        else:
            value = _simple_value(token)
            if value is None:
                return None
            tree = new_node(Value)
            tree.value = value
            tree.unit = ""
        end = self._ends[at]
        made = new_node(Expression)
        made.span = tree.span = new_span(Span, (self._source, end - len(token), end))
        made.tree = tree
        return made, at

    def _finished(self, found: _Found | None) -> tuple[Expression, int] | None:
        if found is None:
            self._fault = self._large = None
            return None
        tree, start, end, following = found
        span = tree.span
        if span[1] != start or span[2] != end:  # else they share one
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
        return made, following

    def _check_depth(self, tree: ExpressionTree, span: Span) -> None:
        if self._fault is None and depth(tree) > NESTING_LIMIT:
            help_ = "each operator is a level: assign a part of it to a variable first"
            fields = {"limit": NESTING_LIMIT, "help": help_}
            self._fault = Fault(span, "nested-too-deeply", fields)

    def _binary(self, at: int, operators: frozenset[str]) -> _Found | None:
        """Parse operands with operators between them, or one operand."""
        tokens = self._tokens
        prefixes: Sequence[Operator] = ()
        if tokens[at] in _PREFIXES:
            prefixes, at = self._prefixes(at)
        first = last = self._primary(at)
        if last is None or first is None:
            return None
        if tokens[last[3]] not in operators and not prefixes:
            return first
        operations: list[Operation[_Found]] = []
        while tokens[last[3]] in operators:
            operation = self._operation(last[3])
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
        return tree, start, end, last[3]

    def _operation(self, at: int) -> Operation[_Found] | None:
        """Parse an operator with its right operand; None if there is no operand."""
        tokens = self._tokens
        token = tokens[at]
        if token == "-" and self._is_arrow(at):
            return None
        at += 1
        end = self._ends[at]
        if token in _PARTS_OF_COMPARISONS:
            if tokens[at] == "=" and self._ends[at + 1] == end + 1:
                token += "="
                at += 1
                end += 1
            if token not in BINDING:
                return None
        before = self._fault, self._large
        prefixes: Sequence[Operator] = ()
        if tokens[at] in _PREFIXES:
            prefixes, at = self._prefixes(at)
        found = self._primary(at)
        if found is None:
            self._fault, self._large = before
            return None
        return (BINDING[token], self._word(token, end), False), prefixes, found

    def _prefixes(self, at: int) -> tuple[Sequence[Operator], int]:
        """Parse prefixes; return them and the index of the next token."""
        prefixes: list[Operator] = []
        while (token := self._tokens[at]) in _PREFIXES and not (
            token == "-" and self._is_arrow(at)
        ):
            at += 1
            word = self._word(token, self._ends[at])
            prefixes.append((NOT if token == "not" else SIGN, word, True))
        return prefixes, at

    def _primary(self, at: int) -> _Found | None:
        """Parse a value, a name, a call, or an expression in parentheses."""
        tokens = self._tokens
        token = tokens[at]
        if token < "A":
            return self._parenthesised(at) if token == "(" else self._literal(at)
        if token not in self._not_a_name:
            following = tokens[at + 1]
            if following == "(":
                found = self._elapsed(at) if token == "elapsed" else None
                found = found or self._query(at) or self._construction(at) or self._call(at)
                if found is not None:
                    return found
            if following == "within" and token == "neighbors":
                found = self._neighbors(at)
                if found is not None:
                    return found
            if following == ".":
                return self._construction(at) or self._path(at)
            if following == "[":
                return self._path(at)
            at += 1
            end = self._ends[at]
            start = end - len(token)
            name = new_node(NameUse)
            name.span = new_span(Span, (self._source, start, end))
            name.name = token
            name.target = None
            return name, start, end, at
        match token:
            case "event" | "self":
                return self._path(at)
            case "true" | "false":
                return self._value(at, self._ends[at + 1], token == "true")
            case "in":
                return self._in_state(at)
        return None

    def _in_state(self, at: int) -> _Found | None:
        """Parse the test of a state; None if it has no path."""
        found = self._state(at + 2) if self._tokens[at + 1] == "(" else None
        if found is None or self._tokens[found[1]] != ")":
            return None
        state, following = found
        start, end = self._start(at), self._ends[following + 1]
        self._size += 1
        return InState(self._span(start, end), state), start, end, following + 1

    def _elapsed(self, at: int) -> _Found | None:
        """Parse the time in a state; None if an expression is in the parentheses."""
        state, following = self._state(at + 2) or (None, at + 2)
        if self._tokens[following] != ")":
            return None
        start, end = self._start(at), self._ends[following + 1]
        self._size += 1
        made = Elapsed(self._span(start, end), self._word_at(at), state)
        return made, start, end, following + 1

    def _neighbors(self, at: int) -> _Found | None:
        """Parse the number of robots within a distance; None if no distance follows."""
        before = self._fault, self._large
        self._descend()
        found = self._primary(at + 2)
        self._level -= 1
        if found is None:
            self._fault, self._large = before
            return None
        distance, _, end, following = found
        start = self._start(at)
        self._size += 1
        place = self._span(start, self._ends[at + 2])
        made = Call(self._span(start, end), Word(NEIGHBORS, place), (distance,))
        return made, start, end, following

    def _after_path(self, at: int) -> int:
        """Return the index of the token after a name and the names that `.` joins to it."""
        tokens, following = self._tokens, at + 1
        while (
            tokens[following] == "."
            and self._is_adjacent(following)
            and self._is_word(following + 1)
            and self._is_adjacent(following + 1)
        ):
            following += 2
        return following

    def _state(self, at: int) -> tuple[Ref[Vertex], int] | None:
        """Parse the path of a state; return it and the index of the next token."""
        tokens = self._tokens
        if not self._is_word(at) or tokens[at] in self._not_a_name:
            return None
        following = self._after_path(at)
        place = self._span(self._start(at), self._ends[following])
        return Ref("".join(tokens[at:following]), "Vertex", place), following

    def _parenthesised(self, at: int) -> _Found | None:
        self._descend()
        found = self._binary(at + 1, _OPERATORS)
        self._level -= 1
        if found is None or self._tokens[found[3]] != ")":
            return None
        following = found[3] + 1
        return found[0], self._start(at), self._ends[following], following

    def _call(self, at: int) -> _Found | None:
        """Parse a call; None if no arguments follow the name."""
        before = self._fault, self._large
        tokens = self._tokens
        self._descend()
        arguments: list[ExpressionTree] = []
        following = at + 2
        while tokens[following] != ")" or arguments:
            if arguments and tokens[following] != ",":
                break
            found = self._binary(following + 1 if arguments else following, _OPERATORS)
            if found is None:
                break
            arguments.append(found[0])
            following = found[3]
        self._level -= 1
        if tokens[following] != ")":
            self._fault, self._large = before
            return None
        following += 1
        end = self._ends[following]
        self._size += 1
        function = self._word(tokens[at], self._ends[at + 1])
        start = function.span[1]
        return Call(self._span(start, end), function, tuple(arguments)), start, end, following

    def _query(self, at: int) -> _Found | None:
        """Parse a query of an array."""
        tokens = self._tokens
        name = at + 2
        if tokens[name + 1] != "in" or not self._is_word(name) or tokens[name] in self._not_a_name:
            return None
        before = self._fault, self._large
        self._descend()
        parts: dict[str, ExpressionTree | None] = {"in": None, "where": None, "by": None}
        following = name + 1
        end = 0
        for word in parts:
            if tokens[following] == word:
                found = self._binary(following + 1, _OPERATORS)
                if found is None:
                    break
                parts[word], _, inner_end, following = found
                end = end or inner_end
        self._level -= 1
        array = parts["in"]
        if array is None or tokens[following] != ")":
            self._fault, self._large = before
            return None
        following += 1
        self._size += 2
        function, item = self._word_at(at), self._word_at(name)
        start = function.span[1]
        element = Element(self._span(item.span[1], end), item, array)
        span = self._span(start, self._ends[following])
        made = Query(span, function, element, parts["where"], parts["by"])
        return made, start, self._ends[following], following

    def _construction(self, at: int) -> _Found | None:
        """Parse a type with values of fields."""
        tokens, start = self._tokens, self._start(at)
        following = self._after_path(at)
        if tokens[following] != "(" or not self._is_word(following + 1):
            return None
        name = "".join(tokens[at:following])
        type_ = TypeRef(self._span(start, self._ends[following]), name, "", "")
        before = self._fault, self._large
        self._descend()
        values: list[FieldValue] = []
        while tokens[following] == ("," if values else "(") and tokens[following + 2] == "=":
            if not self._is_word(following + 1):
                break
            field = self._word_at(following + 1)
            found = self._binary(following + 3, _OPERATORS)
            if found is None:
                break
            tree, _, end, following = found
            values.append(FieldValue(self._span(field.span[1], end), field, tree))
        self._level -= 1
        if not values or tokens[following] != ")":
            self._fault, self._large = before
            return None
        following += 1
        self._size += 2
        end = self._ends[following]
        return Construction(self._span(start, end), type_, tuple(values)), start, end, following

    def _path(self, at: int) -> _Found:
        """Parse a name with fields and items."""
        tokens, start = self._tokens, self._start(at)
        end = self._ends[at + 1]
        tree: ExpressionTree = NameUse(self._span(start, end), tokens[at])
        at += 1
        while True:
            if tokens[at] == "." and self._is_word(at + 1):
                field = tokens[at + 1]
                at += 2
                end = self._ends[at]
                tree = FieldUse(self._span(start, end), tree, self._word(field, end))
            elif tokens[at] == "[" and tokens[at - 1] != "]" and self._is_adjacent(at):
                found = self._index(at)
                if found is None:
                    break
                index, at = found
                end = self._ends[at]
                tree = IndexUse(self._span(start, end), tree, index)
            else:
                break
            self._size += 1
        return tree, start, end, at

    def _index(self, at: int) -> tuple[ExpressionTree, int] | None:
        """Parse an index in brackets."""
        before = self._fault, self._large
        self._descend()
        found = self._binary(at + 1, _OPERATORS)
        self._level -= 1
        if found is None or self._tokens[found[3]] != "]":
            self._fault, self._large = before
            return None
        return found[0], found[3] + 1

    def _is_word(self, at: int) -> bool:
        token = self._tokens[at]
        return token >= "A" and token not in SYMBOLS

    def _is_adjacent(self, at: int) -> bool:
        """Return True for a token directly after the one before it."""
        return self._start(at) == self._ends[at]

    def _word_at(self, at: int) -> Word:
        return self._word(self._tokens[at], self._ends[at + 1])

    def _value(self, at: int, end: int, value: bool | float | str, unit: str = "") -> _Found:
        ends = self._ends
        start = ends[at + 1] - len(self._tokens[at])
        made = new_node(Value)
        made.span = new_span(Span, (self._source, start, end))
        made.value = value
        made.unit = unit
        while ends[at] < end:
            at += 1
        return made, start, end, at

    def _literal(self, at: int) -> _Found | None:
        """Parse a string, or a number with its unit."""
        token, start = self._tokens[at], self._start(at)
        if token[:1] == '"' or self._tokens[at + 1] not in _IN_NUMBERS:
            value = _simple_value(token)
            if value is not None:
                return self._value(at, self._ends[at + 1], value)
        number = self._language.quantity(self._source.text, start)
        return self._quantity(at, number) if number else None

    def _quantity(self, at: int, match: re.Match[str]) -> _Found | None:
        written, digits, unit = match.group(0, 1, 2)
        end = match.end()
        unit = unit or ""
        is_large = is_out_of_range(written, digits, unit)
        found = self._value(at, end, 0 if is_large else quantity_value(digits), unit)
        if self._ends[found[3]] > end:
            return None  # other characters than ASCII follow
        if is_large and self._large is None:
            self._large = self._span(*match.span())
        return found

    def _is_arrow(self, at: int) -> bool:
        return self._tokens[at + 1] == ">" and self._ends[at + 2] == self._ends[at + 1] + 1

    def _descend(self) -> None:
        self._level += 1
        if self._level > self._limit:
            raise TooDeepError

    def _blame(self, fault: Fault) -> None:
        """Keep a fault unless there is an earlier one."""
        if self._fault is None or fault.span.start < self._fault.span.start:
            self._fault = fault

    def _start(self, at: int) -> int:
        return self._ends[at + 1] - len(self._tokens[at])

    def _word(self, text: str, end: int) -> Word:
        word = new_word(Word, text)
        word.span = new_span(Span, (self._source, end - len(text), end))
        return word

    def _span(self, start: int, end: int) -> Span:
        return new_span(Span, (self._source, start, end))


def _simple_value(token: str) -> int | float | str | None:
    """Return the value of a string or of a number without exponent and unit; None for others."""
    if token[:1] == '"':
        return unquoted(token) if token != '"' else None
    digits = token.replace(".", "", 1)
    if not digits.isdigit() or len(digits) > _SIMPLE_NUMBER:
        return None
    return int(token) if digits == token else float(token)


def parse_alone(language: Language, source: Source, report: Diagnostics) -> Expression | None:
    """Parse a text that is one expression; None if it is not, which is reported."""
    tokens = language.tokens.tokenize(source.text)
    parser = ExpressionParser(language, source, tokens, NESTING_LIMIT)
    try:
        found = parser.expression(0)
    except TooDeepError:
        found = None
    for fault in parser.faults:
        report.report(fault.name, fault.span, **fault.fields)
    if found is not None and not tokens[0][found[1]] and found[0].tree is not None:
        return found[0]
    if not report.has_errors:
        end = len(source.text)
        start = end if found is None else min(tokens[1][found[1]], end)
        place = Span(source, start, end)
        report.report("syntax-error", place, message="expected an expression, and nothing else")
    return None


def report_fault(language: Language, span: Span, report: Diagnostics) -> None:
    """Report the faults of the expression at a span."""
    tokens = language.tokens.tokenize(span.source.text, span.start, span.end)
    parser = ExpressionParser(language, span.source, tokens, NESTING_LIMIT)
    parser.expression(0)
    for fault in parser.faults:
        report.report(fault.name, fault.span, **fault.fields)
