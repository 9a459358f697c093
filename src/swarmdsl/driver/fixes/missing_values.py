"""Fixes that set what has no value: params, fields, variables."""

from __future__ import annotations

import re
from collections.abc import Iterator

from swarmdsl.base.diagnostics.collector import Fix
from swarmdsl.driver.fixes.bodies import insert
from swarmdsl.driver.fixes.problem import Problem, Rule, inserting
from swarmdsl.syntax.ast import (
    Field,
    Node,
    Param,
    Parameter,
    Part,
    Role,
    State,
    StateMachine,
    Variable,
)


def _bound_param(problem: Problem, match: re.Match[str]) -> Iterator[Fix]:
    """`Landing(speed = ...)` at a state that reuses a machine."""
    state = problem.around(State)
    machine = state.machine.target if state is not None and state.machine is not None else None
    values = (
        {str(p.name): problem.zero(p.type) for p in machine.items if isinstance(p, Param)}
        if machine
        else {}
    )
    name = match[2].partition(" = ")[0]
    zero = values.get(name)
    if zero is None:
        return
    text, end = problem.text, problem.span.end
    if text.startswith("(", end):
        edit = (problem.part(end + 1, end + 1), f"{name} = {zero}, ")
    else:
        edit = (problem.part(end, end), f"({name} = {zero})")
    yield Fix(f"Add `{name} = {zero}`", (edit,))


def _role_value(problem: Problem, match: re.Match[str]) -> Iterator[Fix]:
    """Set a param at the role or part, or give it a default."""
    name = match[2]
    param = next((p for p in problem.every(Param) if _declared_there(problem, p, name)), None)
    zero = problem.zero(param.type) if param is not None else None
    called = match[1]
    node: Node | None = problem.around(Role, Part)
    if getattr(node, "name", None) != called:
        node = problem.named(called, Part)
    if zero is None or param is None:
        return
    if node is not None:
        fix = insert(node, f"{name} = {zero}")
        if fix is not None:
            yield fix
    yield inserting(param.span.absolute, f" = {zero}")


def _declared_there(problem: Problem, param: Param, name: str) -> bool:
    """Return True for the param whose declaration a diagnostic shows."""
    return param.name == name and (not problem.found.related or problem.shows(param.name.span))


def _arguments(problem: Problem, match: re.Match[str]) -> Iterator[Fix]:
    """Missing fields of a goal or message, each with the zero of its type."""
    written = []
    for assignment in match[1].split(", "):
        name = assignment.partition(" = ")[0]
        zero = None
        fields: list[Field | Parameter] = [*problem.every(Field), *problem.every(Parameter)]
        for node in fields:
            if node.name == name and problem.shows(node.name.span):
                zero = problem.zero(node.type)
        if zero is None:
            return
        written.append(f"{name} = {zero}")
    joined, end = ", ".join(written), problem.span.end
    if problem.text.startswith("(", end):
        edit = (problem.part(end + 1, end + 1), f"{joined}, ")
    else:
        edit = (problem.part(end, end), f"({joined})")
    yield Fix(f"Add `{joined}`", (edit,))


def _initial_value(problem: Problem, match: re.Match[str]) -> Iterator[Fix]:
    name = match[1]
    machine = problem.around(StateMachine)
    found = [
        each for each in problem.every(Variable) if each.name == name and _is_in(each, machine)
    ]
    zero = problem.zero(found[0].type) if found else None
    if zero is not None:
        yield inserting(found[0].span.absolute, f" = {zero}")


def _is_in(variable: Variable, machine: StateMachine | None) -> bool:
    if machine is None:
        return True
    outer, inner = machine.span.absolute, variable.span.absolute
    return outer.source is inner.source and outer.start <= inner.start <= outer.end


def _value_of_enum(problem: Problem, match: re.Match[str]) -> Iterator[Fix]:
    variable = problem.around(Variable)
    if variable is not None:
        yield inserting(variable.span.absolute, f" {match[1]}")


RULES: tuple[tuple[str, Rule], ...] = (
    (r"bind it: `(\w+)\(([^`]+)\)`", _bound_param),
    (r"write `(\w+) : [^`]*\{ (\w+) = \.\.\. \}`, or give the param a default", _role_value),
    (r"add `(\w+ = \.\.\.(?:, \w+ = \.\.\.)*)`", _arguments),
    (r"give it an initial value, `\w+ (\w+) : [^`]*`, or .*", _initial_value),
    (r"give it an initial value: `(= [^`]+)`", _value_of_enum),
)
"""The first pattern that matches the whole help of a diagnostic makes its fixes."""
