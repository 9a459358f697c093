"""Fixes that set what has no value: params, fields, variables."""

from __future__ import annotations

from collections.abc import Iterator

from swarmdsl.base.diagnostics.collector import Fix
from swarmdsl.base.source import Span
from swarmdsl.driver.fixes.bodies import insert
from swarmdsl.driver.fixes.problem import Problem, Rules, inserting
from swarmdsl.syntax.ast import Field, Param, Parameter, Variable


def _bound_param(problem: Problem, name: Span) -> Iterator[Fix]:
    """`Landing(speed = ...)` at a state that reuses a machine."""
    param = problem.declared(name)
    zero = problem.zero(param.type) if isinstance(param, Param) else None
    if zero is not None:
        yield _argument(problem, f"{name.text} = {zero}")


def _argument(problem: Problem, text: str) -> Fix:
    """Return the fix that adds arguments to a call at the place."""
    end = problem.span.end
    if problem.text.startswith("(", end):
        edit = (problem.part(end + 1, end + 1), f"{text}, ")
    else:
        edit = (problem.part(end, end), f"({text})")
    return Fix(f"Add `{text}`", (edit,))


def _set_param(problem: Problem, owner: Span, name: Span) -> Iterator[Fix]:
    """Set a param at a role or part, or give it a default."""
    node, param = problem.declared(owner), problem.declared(name)
    zero = problem.zero(param.type) if isinstance(param, Param) else None
    if node is None or param is None or zero is None:
        return
    fix = insert(node, f"{name.text} = {zero}")
    if fix is not None:
        yield fix
    yield inserting(param.span.absolute, f" = {zero}")


def _arguments(problem: Problem, *names: Span) -> Iterator[Fix]:
    """Missing fields of a goal or message, each with the zero of its type."""
    written = []
    for name in names:
        field = problem.declared(name)
        zero = problem.zero(field.type) if isinstance(field, (Field, Parameter)) else None
        if zero is None:
            return
        written.append(f"{name.text} = {zero}")
    yield _argument(problem, ", ".join(written))


def _initial_value(problem: Problem, name: Span) -> Iterator[Fix]:
    variable = problem.declared(name)
    zero = problem.zero(variable.type) if isinstance(variable, Variable) else None
    if variable is not None and zero is not None:
        yield inserting(variable.span.absolute, f" = {zero}")


def _value_of_enum(problem: Problem, value: str) -> Iterator[Fix]:
    variable = problem.around(Variable)
    if variable is not None:
        yield inserting(variable.span.absolute, f" {value}")


RULES: Rules = {
    "add arguments": _arguments,
    "bind": _bound_param,
    "initial value": _value_of_enum,
    "initialize": _initial_value,
    "set param": _set_param,
}
