"""Expressions, with their types filled in."""

from __future__ import annotations

from swarmdsl import ir
from swarmdsl.enums import numbers, underlying
from swarmdsl.expressions import UNITS
from swarmdsl.ir.types import BOOL, DURATION, FLOAT, INT, STRING
from swarmdsl.lower.context import Context
from swarmdsl.syntax import (
    Call,
    Constant,
    EnumType,
    Expression,
    ExpressionTree,
    FieldUse,
    FitnessInput,
    NameUse,
    OperatorUse,
    Param,
    Value,
    Variable,
)


def lower_optional(expression: Expression | None, context: Context) -> ir.Expression | None:
    """An expression, or None where there is none."""
    return None if expression is None else lower_expression(expression, context)


def lower_expression(expression: Expression, context: Context) -> ir.Expression:
    """An expression that was parsed and checked."""
    assert expression.tree is not None
    return _lower(expression.tree, context)


def lower_path(expression: Expression, context: Context) -> tuple[str, tuple[str, ...]]:
    """A place to store a value: the variable and the fields below it."""
    tree = expression.tree
    path: list[str] = []
    while isinstance(tree, FieldUse):
        path.insert(0, str(tree.name))
        tree = tree.base
    assert isinstance(tree, NameUse)
    assert isinstance(tree.target, Variable)
    return context.variables.get(tree.target, tree.name), tuple(path)


def _lower(tree: ExpressionTree, context: Context) -> ir.Expression:
    type_ = context.typing.infer(tree)
    type_ = context.plain(type_) if type_ is not None else None
    match tree:
        case Value():
            return _literal(tree)
        case NameUse(name="event"):
            assert type_ is not None
            return ir.EventData(type_, tree.span)
        case NameUse(target=Variable() as variable):
            assert type_ is not None
            return ir.VariableRef(context.variables.get(variable, tree.name), type_, tree.span)
        case NameUse(target=Param() as param):
            assert type_ is not None
            if param in context.values:
                return context.values[param]
            return ir.ParamRef(tree.name, type_, tree.span)
        case NameUse(target=Constant() as constant):
            return lower_expression(constant.value, context)
        case NameUse(target=FitnessInput()):
            assert type_ is not None
            return ir.VariableRef(tree.name, type_, tree.span)
        case FieldUse(base=NameUse(target=EnumType() as enum), name=name):
            return ir.Literal(numbers(enum)[str(name)], underlying(enum), tree.span)
        case FieldUse(base=base, name=name):
            return ir.FieldAccess(_lower(base, context), str(name), type_, tree.span)
        case Call(function=function, arguments=arguments):
            values = tuple(_lower(argument, context) for argument in arguments)
            return ir.Call(str(function), values, type_, tree.span)
        case OperatorUse(operator=operator, operands=(operand,)):
            return ir.Unary(str(operator), _lower(operand, context), type_, tree.span)
        case OperatorUse(operator=operator, operands=(left, right)):
            return ir.Binary(
                str(operator), _lower(left, context), _lower(right, context), type_, tree.span
            )
    raise AssertionError(tree)


def _literal(value: Value) -> ir.Literal:
    match value.value:
        case int() | float() if value.unit:
            return ir.Literal(round(value.value * UNITS[value.unit]), DURATION, value.span)
        case bool():
            return ir.Literal(value.value, BOOL, value.span)
        case int():
            return ir.Literal(value.value, INT, value.span)
        case float():
            return ir.Literal(value.value, FLOAT, value.span)
    return ir.Literal(value.value, STRING, value.span)
