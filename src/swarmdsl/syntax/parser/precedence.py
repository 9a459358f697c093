"""Operator precedence: E. W. Dijkstra's shunting-yard algorithm."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any, TypeVar

from swarmdsl.base.records import dataclass
from swarmdsl.base.source import Span
from swarmdsl.syntax.ast import ExpressionTree, OperatorUse, Word

_OR, _AND, NOT, _COMPARISON, _SUM, _PRODUCT, SIGN = range(1, 8)
# Precedences as in expression.lark; `not` and the sign have their own.
BINDING = {
    "or": _OR,
    "and": _AND,
    **dict.fromkeys(("==", "!=", "<=", ">=", "<", ">"), _COMPARISON),
    **dict.fromkeys(("+", "-"), _SUM),
    **dict.fromkeys(("*", "/", "%"), _PRODUCT),
}
_new_span = tuple.__new__  # Span itself takes twice as long to make one
# Precedence of an operator, its word, and True for a prefix.
Operator = tuple[int, Word, bool]
# A tree, and its start and end including parentheses; the rest is ignored.
Operand = tuple[ExpressionTree, int, int, Any]
O = TypeVar("O", bound=Operand)  # noqa: E741
# An operator, the prefixes of its right operand, and that operand.
Operation = tuple[Operator, Sequence[Operator], O]


@dataclass(frozen=True, slots=True)
class Fault:
    """Error in an expression: the fields of a diagnostic."""

    span: Span
    name: str
    fields: dict[str, Any]


def join(
    prefixes: Sequence[Operator], first: Operand, operations: Sequence[Operation[O]]
) -> tuple[ExpressionTree, int, int, Fault | None]:
    """Build the tree of an operand and the operations after it; return it with start and end.

    The fault is the first misplaced operator; the tree is not valid then.
    """
    if len(operations) == 1 and not prefixes and not operations[0][1]:
        (_, word, _), _, (right, _, end, _) = operations[0]
        tree, start, _, _ = first
        return _operation(first[0].span, start, end, word, (tree, right)), start, end, None
    joining = _OperatorStack()
    joining.add(prefixes, first)
    for operator, before, operand in operations:
        joining.operator(operator)
        joining.add(before, operand)
    joining.reduce(0)
    return *joining.values[0], joining.fault


class _OperatorStack:
    def __init__(self) -> None:
        self.values: list[tuple[ExpressionTree, int, int]] = []
        self.fault: Fault | None = None
        self._waiting: list[Operator] = []

    def add(self, prefixes: Sequence[Operator], operand: Operand) -> None:
        """Add an operand with its prefixes."""
        for prefix in prefixes:
            if prefix[0] == NOT and self._waiting and self._waiting[-1][0] > NOT:
                self._blame(
                    prefix[1],
                    "`not` must be in parentheses here",
                    "put parentheses around it and its operand",
                )
            self._waiting.append(prefix)
        self.values.append(operand[:3])

    def operator(self, operator: Operator) -> None:
        """Add an operator between two operands."""
        self.reduce(operator[0])
        if self._waiting and self._waiting[-1][0] == operator[0] == _COMPARISON:
            self._blame(operator[1], "comparisons cannot be chained", self._joined(operator[1]))
        self._waiting.append(operator)

    def _joined(self, word: Word) -> str:
        """Return the help for a second comparison of one operand."""
        from swarmdsl.base.diagnostics.advice import before, edits

        _, start, end = self.values[-1]
        operand = word.span.source.text[start:end]
        change = before(word.span, f"and {operand} ")
        return edits("join them: `a < b and b < c`", f"Insert `and {operand}`", change)

    def reduce(self, binding: int) -> None:
        """Reduce operators of higher precedence, and of the same unless they do not chain."""
        while self._waiting and self._waiting[-1][0] >= binding:
            if self._waiting[-1][0] == binding == _COMPARISON:
                return
            _, word, is_prefix = self._waiting.pop()
            right, _, end = self.values.pop()
            start = word.span.start
            operands: tuple[ExpressionTree, ...] = (right,)
            if not is_prefix:
                left, start, _ = self.values.pop()
                operands = (left, right)
            tree = _operation(word.span, start, end, word, operands)
            self.values.append((tree, start, end))

    def _blame(self, word: Word, message: str, help_: str) -> None:
        if self.fault is None:
            self.fault = Fault(word.span, "syntax-error", {"message": message, "help": help_})


def _operation(
    near: Span, start: int, end: int, word: Word, operands: tuple[ExpressionTree, ...]
) -> OperatorUse:
    return OperatorUse(_new_span(Span, (near.source, start, end)), word, operands)
