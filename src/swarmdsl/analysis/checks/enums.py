"""Checks of enums and of the initial values of their variables."""

from __future__ import annotations

from swarmdsl.analysis.checks.context import Context
from swarmdsl.analysis.types import range_of
from swarmdsl.analysis.types.enum_values import numbers, underlying
from swarmdsl.base.diagnostics.advice import Advice, edits
from swarmdsl.base.naming import fresh
from swarmdsl.syntax.ast import EnumType, Variable
from swarmdsl.syntax.types import INTEGERS, Array, Named, Primitive


def check_enum(enum: EnumType, context: Context) -> None:
    """Check that an enum has values, with different numbers in the range of its type."""
    written = enum.underlying.type if enum.underlying is not None else None
    if written is not None and not (isinstance(written, Primitive) and written.name in INTEGERS):
        assert enum.underlying is not None
        context.report.report(
            "interface-kind",
            enum.underlying.span,
            name=enum.underlying.span.text,
            actual="a type of another kind",
            expected="an integer type",
            help=Advice(
                "the values of an enum are whole numbers: `uint8` for instance", "propose", "uint8"
            ),
        )
        return
    if not enum.values:
        context.report.report(
            "empty-enum",
            enum.name.span,
            name=enum.name,
            help=Advice(
                "name what a value of it can be: `{ OFF ON }` for instance",
                "add values",
                "OFF",
                "ON",
            ),
        )
    type_ = underlying(enum)
    possible = range_of(type_)
    assert possible is not None
    known = numbers(enum)
    taken = set(known.values())
    seen: dict[int, str] = {}
    # A repeated name is reported elsewhere.
    first = {str(value.name): value for value in reversed(enum.values)}
    for value in reversed(first.values()):
        number = known[str(value.name)]
        fault = help_ = ""
        if number not in possible:
            fault = f"is {number}, which is no `{type_}`"
            help_ = f"a value of type `{type_}` is from {possible[0]} to {possible[-1]}"
        elif seen.get(number, value.name) != value.name:
            fault = f"is {number}, like `{seen[number]}`"
            help_ = "give each value a number of its own"
            free = next(
                (each for each in range(len(taken) + 1) if each in possible and each not in taken),
                None,
            )
            if free is not None:
                new = f"{value.name} = {free}"
                help_ = edits(help_, f"Change to `{new}`", (value.span, new))
        if fault:
            context.report.report(
                "enum-value",
                value.name.span,
                name=value.name,
                enum=enum.name,
                fault=fault,
                help=help_,
            )
        seen.setdefault(number, str(value.name))


def check_first_value(variable: Variable, context: Context) -> None:
    """Check that the initial value of a variable, by default 0, is a value of its enum."""
    if variable.initial is not None:
        return
    type_ = variable.type.type
    several = isinstance(type_, Array) and type_.size is not None and not type_.bounded
    element = type_.element if isinstance(type_, Array) and several else type_
    enum = context.interfaces.get(element) if isinstance(element, Named) else None
    if not isinstance(enum, EnumType) or not enum.values or 0 in numbers(enum).values():
        return
    written = variable.type.name
    context.report.report(
        "no-first-value",
        variable.name.span,
        name=variable.name,
        enum=enum.name,
        help=Advice(
            f"give `{enum.name}` a value that is 0",
            "insert",
            f"{fresh('NONE', {str(each.name) for each in enum.values})} = 0",
            enum.name.span,
        )
        if several
        else Advice(
            f"give it an initial value: `= {written}.{enum.values[0].name}`",
            "initial value",
            f"= {written}.{enum.values[0].name}",
        ),
    )
