"""Diagnostics for numbers of wrong units."""

from __future__ import annotations

from collections.abc import Sequence

from swarmdsl.analysis.types.fitting import is_number
from swarmdsl.analysis.types.unit_rules import has_root, must_be_alike, taken_unit, units_fit
from swarmdsl.base.diagnostics.advice import Advice, write
from swarmdsl.base.diagnostics.collector import Diagnostics, Label
from swarmdsl.base.source import Span
from swarmdsl.syntax.ast import Call, ExpressionTree, NameUse, OperatorUse, Value
from swarmdsl.syntax.types import Array, Type, unit_of
from swarmdsl.syntax.units import PERCENT, Unit, unit_of_ros


def check_value(
    tree: ExpressionTree, found: Type | None, expected: Type | None, report: Diagnostics
) -> bool:
    """Report a value of another unit than that of its place; return True for a correct one."""
    if not _is_measured(found) or not _is_measured(expected):
        return True
    unit = unit_of(expected)
    if _fits(tree, unit_of(found), unit):
        return True
    _report(tree, unit_of(found), unit, report)
    return False


def check_types(found: Type | None, expected: Type | None, at: Span, report: Diagnostics) -> bool:
    """Report a value that is no expression like `check_value`."""
    if not _is_measured(found) or not _is_measured(expected):
        return True
    have, want = unit_of(found), unit_of(expected)
    if units_fit(have, want):
        return True
    help_ = f"declare both in `{want or have}`"
    report.report("wrong-unit", at, expected=_named(want), found=_named(have), help=help_)
    return False


def check_operands(
    tree: Call | OperatorUse, types: Sequence[Type | None], report: Diagnostics
) -> None:
    """Report operands whose units an operator or function does not take."""
    word = str(tree.function if isinstance(tree, Call) else tree.operator)
    operands = tree.arguments if isinstance(tree, Call) else tree.operands
    taken = taken_unit(word)
    if taken is not None:
        if not _fits(operands[0], unit_of(types[0]), taken):
            _report(operands[0], unit_of(types[0]), taken, report)
    elif word == "sqrt":
        unit = unit_of(types[0])
        if unit is not None and not has_root(unit):
            report.report(
                "wrong-unit",
                operands[0].span,
                expected="a plain number or a square",
                found=_named(unit),
                help=_without(operands[0], unit),
            )
    elif must_be_alike(word) and len(operands) > 1:
        _check_alike(operands, types, report)


def _check_alike(
    operands: Sequence[ExpressionTree], types: Sequence[Type | None], report: Diagnostics
) -> None:
    """Report the first operand that has another unit than the first one with a unit."""
    known = [
        (tree, unit_of(type_))
        for tree, type_ in zip(operands, types, strict=True)
        if type_ is not None and is_number(type_)
    ]
    first = next(((tree, unit) for tree, unit in known if unit is not None and unit.name), None)
    if first is None:
        return
    model, expected = first
    for tree, unit in known:
        if not _fits(tree, unit, expected):
            related = Label(model.span, f"this is {_in(expected)}")
            _report(tree, unit, expected, report, (related,))
            return


def _fits(tree: ExpressionTree, found: Unit | None, expected: Unit | None) -> bool:
    """Return True for a number of the expected unit; a literal must have it in writing."""
    if expected is PERCENT and found is None and _is_literal(tree):
        return False
    return units_fit(found, expected)


def _report(
    tree: ExpressionTree,
    found: Unit | None,
    expected: Unit | None,
    report: Diagnostics,
    related: tuple[Label, ...] = (),
) -> None:
    report.report(
        "wrong-unit",
        tree.span,
        expected=_named(expected),
        found=_named(found),
        related=related,
        help=_help(tree, found, expected),
    )


def _help(tree: ExpressionTree, found: Unit | None, expected: Unit | None) -> str:
    text = tree.span.text
    if expected is None and isinstance(tree, Value):
        return f"declare it with its unit, `in {found}`, or write a plain number"
    if expected is None:
        divisor = unit_of_ros(found.dimension) if found is not None else None
        return Advice(_without(tree, found), "propose", f"{_operand(tree)} / 1 {divisor or '%'}")
    if isinstance(tree, Value) and tree.unit:
        return Advice(f"write a number in `{expected}`", "other unit", str(expected))
    if found is None:
        if expected is PERCENT and isinstance(tree, Value) and isinstance(tree.value, float):
            return write(f"{float(f'{tree.value * 100:.12g}'):g} %")
        if _is_literal(tree):
            return write(f"{text} {expected}")
        product = f"{_operand(tree)} * 1 {expected}"
        if isinstance(tree, NameUse):
            return f"give it a unit: `{product}`, or declare it `in {expected}`"
        return Advice(f"give it a unit: `{product}`", "add unit", product)
    return _without(tree, found)


def _without(tree: ExpressionTree, unit: Unit | None) -> str:
    """Return how a number becomes a plain one."""
    divisor = unit_of_ros(unit.dimension) if unit is not None else None
    return f"divided by its unit it is a plain number: `{_operand(tree)} / 1 {divisor or '%'}`"


def _operand(tree: ExpressionTree) -> str:
    text = tree.span.text
    return f"({text})" if isinstance(tree, OperatorUse) else text


def _is_literal(tree: ExpressionTree) -> bool:
    if isinstance(tree, OperatorUse) and len(tree.operands) == 1:
        tree = tree.operands[0]
    return isinstance(tree, Value) and not tree.unit


def _is_measured(type_: Type | None) -> bool:
    return is_number(type_.element if isinstance(type_, Array) else type_)


def _named(unit: Unit | None) -> str:
    return "a plain number" if unit is None else f"a number {_in(unit)}"


def _in(unit: Unit) -> str:
    return f"in `{unit}`"
