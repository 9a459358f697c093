"""Diagnostics of names that are no values, with hints."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from typing import TypeVar

from swarmdsl.analysis.resolve.report_unresolved import may_be_skipped, report_declaration
from swarmdsl.analysis.resolve.scopes import FileScope, Missing, Unresolved, WrongKind
from swarmdsl.base.diagnostics.collector import Diagnostics
from swarmdsl.base.source import Span
from swarmdsl.syntax.ast import (
    Declaration,
    Event,
    Expression,
    FieldUse,
    Member,
    NameUse,
    Property,
    StateMachine,
    TopLevel,
)
from swarmdsl.syntax.types import Type

D = TypeVar("D", bound=Declaration)


def report_value(
    base: NameUse,
    fields: Sequence[FieldUse],
    within: Expression,
    owner: TopLevel,
    values: Iterable[str],
    machines: Iterable[StateMachine],
    kinds: tuple[type[D], ...],
    scope: FileScope,
    report: Diagnostics,
) -> None:
    """Report a name that means no value; for a package, the name that is missing in it.

    `values` are the names of the variables, params and inputs of `owner`; the expression is about
    `machines`.
    """
    name, at = base.name, base.span
    for count, field in enumerate(fields):
        package = dotted(base.name, fields[:count])
        if package in scope.packages:
            name, at = f"{package}.{field.name}", field.span
    found = scope.resolve(name, kinds)
    assert isinstance(found, Unresolved)
    from swarmdsl.analysis.resolve.hints import value_hint
    from swarmdsl.analysis.resolve.out_of_place import meaning_elsewhere, robot_as_value

    help_ = None
    if isinstance(found, Missing):
        help_ = value_hint(name, scope, report)
        wanted = report.wants_hint("unresolved-name") and not may_be_skipped(name, scope)
        if help_ is None and wanted:
            help_ = meaning_elsewhere(base, within, owner, machines, scope)
    if help_ is not None:
        report.report("unresolved-name", at, kind="value", name=name, help=help_)
        return

    instead = None
    if isinstance(found, WrongKind) and isinstance(found.node, Event) and fields:
        instead = f"write `event.{fields[0].name}` for a field of the event that has arrived"

    def hint() -> str | None:
        # A name with fields may be a package.
        if fields:
            return None
        from swarmdsl.analysis.resolve.missing_variable import suggest_variable

        return robot_as_value(base, owner) or suggest_variable(base, within, owner, scope)

    # Only these have fields without a declaration.
    known = [*values, *(_predefined(owner) if fields else ("true", "false"))]
    report_declaration(
        found, name, at, kinds, scope, report, built_in=known, instead=instead, hint=hint
    )


def _predefined(owner: TopLevel) -> tuple[str, ...]:
    """Return the names with fields that expressions of a declaration need not declare."""
    if isinstance(owner, StateMachine):
        return ("event", "self")
    return ("event",) if isinstance(owner, (Member, Property)) else ()


def report_type_as_value(name: str, at: Span, type_: Type, report: Diagnostics) -> None:
    """Report an alias of a type that is no enum, used as a value."""
    report.report("wrong-kind", at, name=name, actual=f"the type `{type_}`", expected="a value")


def dotted(name: str, fields: Iterable[FieldUse]) -> str:
    """Return a name and fields as they are written: `sar.Mode`."""
    return ".".join([name, *(str(field.name) for field in fields)])
