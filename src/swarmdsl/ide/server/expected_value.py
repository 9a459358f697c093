"""Type that a value at the cursor must have, and whether it must be constant or a variable."""

from __future__ import annotations

from collections.abc import Iterator

from swarmdsl.analysis.resolve.interfaces import Interfaces
from swarmdsl.analysis.types import BUILT_INS, Typing, fits, is_number
from swarmdsl.base.records import dataclass, replace
from swarmdsl.ide.server.fields import slots, with_event
from swarmdsl.ide.server.speculative_parse import PLACEHOLDER
from swarmdsl.project.loader import Project
from swarmdsl.syntax.ast import (
    Argument,
    Assignment,
    Branch,
    Call,
    Constant,
    Expression,
    ExpressionTree,
    Fact,
    FieldUse,
    IndexUse,
    NameUse,
    OperatorUse,
    Param,
    PartValue,
    Query,
    ResultMapping,
    Send,
    TimeTrigger,
    TopLevel,
    Transition,
    Variable,
    nodes_of,
    walk,
)
from swarmdsl.syntax.types import BOOL, DURATION, FLOAT, INT, Named, Type, declared_unit

_COMPARISONS = ("==", "!=", "<", "<=", ">", ">=")
# How well a type fits: exactly, after a conversion, as part of an expression, not at all.
EXACT, CONVERTED, PARTIAL, MISFIT = range(4)


@dataclass(frozen=True)
class ExpectedValue:
    """Expected type, None if it is not known.

    `is_constant` excludes values that change, `is_stored` all that is not a variable, `declared`
    the name of what gets the value. `is_condition` is set in guards. `typing` knows the event that
    triggers the transition around the value.
    """

    type: Type | None
    typing: Typing
    is_constant: bool = False
    is_stored: bool = False
    declared: str = ""
    is_condition: bool = False

    def fit(self, found: Type | None) -> int:
        """Return how well a value of a type fits."""
        if self.type is None or found is None:
            return CONVERTED
        if found == self.type:
            unit, wanted = declared_unit(found), declared_unit(self.type)
            if unit is None or wanted is None or unit == wanted:
                return EXACT
            return EXACT if unit.dimension == wanted.dimension else MISFIT
        if fits(found, self.type):
            return CONVERTED
        if self.is_stored:
            return MISFIT
        if isinstance(found, Named) or self.type == BOOL:
            return PARTIAL  # by a field, or in a comparison
        return MISFIT


def expected_value(owner: TopLevel, project: Project) -> ExpectedValue | None:
    """Return what is expected of the placeholder; None if it is no value."""
    use = _placeholder(owner)
    if use is None:
        return None
    typing = with_event(use, owner, Typing(Interfaces(project.declarations())))
    for value, found in _values(owner, typing, project):
        if value.tree is not None and any(node is use for node in walk(value.tree)):
            type_ = _inside(value.tree, use, found.type, typing)
            return replace(found, type=type_)
    return ExpectedValue(None, typing)


def _placeholder(owner: TopLevel) -> NameUse | FieldUse | None:
    names = (use for use in nodes_of(owner, NameUse) if PLACEHOLDER in use.name)
    fields = (use for use in nodes_of(owner, FieldUse) if use.name == PLACEHOLDER)
    return next(names, None) or next(fields, None)


def _values(
    owner: TopLevel, typing: Typing, project: Project
) -> Iterator[tuple[Expression, ExpectedValue]]:
    """Yield the expressions of a declaration with what is expected of them."""
    for param in nodes_of(owner, Param):
        if param.default is not None:
            yield param.default, ExpectedValue(param.type.type, typing, is_constant=True)
    for variable in nodes_of(owner, Variable):
        if variable.initial is not None:
            yield variable.initial, ExpectedValue(variable.type.type, typing, is_constant=True)
    for constant in nodes_of(owner, Constant):
        name = str(constant.name)
        yield constant.value, ExpectedValue(constant.type.type, typing, True, declared=name)
    guards = [
        *(each.guard for each in nodes_of(owner, Transition)),
        *(each.guard for each in nodes_of(owner, Branch)),
        *(each.guard for each in nodes_of(owner, Fact)),
    ]
    yield from (
        (each, ExpectedValue(BOOL, typing, is_condition=True))
        for each in guards
        if each is not None
    )
    delays = [
        *(each.delay for each in nodes_of(owner, TimeTrigger)),
        *(each.delay for each in nodes_of(owner, Send)),
    ]
    yield from ((delay, ExpectedValue(DURATION, typing)) for delay in delays if delay is not None)
    for assignment in nodes_of(owner, Assignment):
        yield assignment.target, ExpectedValue(None, typing, is_stored=True)
        target = assignment.target.tree
        type_ = typing.quietly(target) if target is not None else None
        # Only a number is assigned to itself, with something added.
        own = "" if is_number(type_) else assignment.target.span.text
        yield assignment.value, ExpectedValue(type_, typing, declared=own)
    yield from _slot_values(owner, typing, project)


def _slot_values(
    owner: TopLevel, typing: Typing, project: Project
) -> Iterator[tuple[Expression, ExpectedValue]]:
    """Yield the values of the parameter list that contains the placeholder."""
    given = slots(owner, project)
    types = {str(each.name): each.type.type for each in given.fields} if given is not None else {}
    arguments: list[Argument | PartValue] = [
        *nodes_of(owner, Argument),
        *nodes_of(owner, PartValue),
    ]
    for argument in arguments:
        if PLACEHOLDER in argument.value.span.text:
            yield argument.value, ExpectedValue(types.get(str(argument.name)), typing)
    for result in nodes_of(owner, ResultMapping):
        if PLACEHOLDER in result.target.span.text:
            type_ = types.get(str(result.field))
            yield result.target, ExpectedValue(type_, typing, is_stored=True)


def _inside(
    tree: ExpressionTree, use: NameUse | FieldUse, expected: Type | None, typing: Typing
) -> Type | None:
    """Return the type expected of a part of an expression."""
    if tree is use:
        return expected
    match tree:
        case OperatorUse(operator=operator, operands=operands):
            inner = next(each for each in operands if any(node is use for node in walk(each)))
            others = [typing.quietly(each) for each in operands if each is not inner]
            if operator in _COMPARISONS:
                wanted = others[0] if others else None
            elif operator in ("and", "or", "not"):
                wanted = BOOL
            else:
                known = expected if is_number(expected) or expected == DURATION else None
                wanted = known or next(iter(others), None) or FLOAT
            return _inside(inner, use, wanted, typing)
        case Call(function=function, arguments=arguments):
            known_function = BUILT_INS.get(str(function))
            wanted = FLOAT if known_function and known_function.result else expected
            for each in arguments:
                if any(node is use for node in walk(each)):
                    return _inside(each, use, wanted, typing)
        case Query(condition=condition) if condition is not None:
            if any(node is use for node in walk(condition)):
                return _inside(condition, use, BOOL, typing)
        case IndexUse(index=index) if any(node is use for node in walk(index)):
            return _inside(index, use, INT, typing)
    return None
