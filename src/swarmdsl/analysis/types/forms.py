"""Syntactic forms of expressions: constant, assignable."""

from __future__ import annotations

from swarmdsl.syntax.ast import (
    Call,
    Constant,
    Elapsed,
    EnumType,
    ExpressionTree,
    FieldUse,
    IndexUse,
    InState,
    NameUse,
    OperatorUse,
    Value,
    Variable,
)


def constant(tree: ExpressionTree) -> bool:
    """Return True for a constant expression.

    What is reported elsewhere counts as constant: unresolved names, `self`, and the state of the
    machine.
    """
    match tree:
        case NameUse(name="event") | Call(function="present" | "neighbors within"):
            return False
        case Value() | InState() | Elapsed() | NameUse(target=Constant() | EnumType() | None):
            return True
        case FieldUse(base=base):
            return constant(base)
        case OperatorUse(operands=operands):
            return all(constant(operand) for operand in operands)
        case Call(arguments=arguments):
            return all(constant(argument) for argument in arguments)
    return False


def assignable(tree: ExpressionTree) -> bool:
    """Return True for a variable or a field of one."""
    match tree:
        case NameUse(target=target):
            return isinstance(target, Variable) or (target is None and not tree.is_predefined)
        case FieldUse(base=base):
            return assignable(base)
    return False


def item_of(tree: ExpressionTree) -> ExpressionTree | None:
    """Return the array of an item that can be assigned to or removed, such as `a.b` of `a.b[i]`."""
    return tree.base if isinstance(tree, IndexUse) and assignable(tree.base) else None


def stored_name(tree: ExpressionTree | None) -> NameUse | None:
    """Return the name of the variable that a store changes, such as `a` of `a.b[i]`."""
    while isinstance(tree, (FieldUse, IndexUse)):
        tree = tree.base
    return tree if isinstance(tree, NameUse) else None
