"""Checks of the params that a swarm sets for its roles and robots."""

from __future__ import annotations

from collections.abc import Iterable

from swarmdsl.analysis.checks.context import Context
from swarmdsl.analysis.resolve.inheritance import all_items
from swarmdsl.analysis.resolve.multiplicity import MOST_DIGITS, greatest
from swarmdsl.base.diagnostics.advice import Advice, last_robot
from swarmdsl.base.diagnostics.collector import Label, listed
from swarmdsl.base.numerals import integer
from swarmdsl.syntax.ast import (
    EnumType,
    Member,
    Param,
    Part,
    PartValue,
    RobotValues,
    Role,
    Swarm,
)
from swarmdsl.syntax.types import Named, Primitive

_MOST_NAMED = 5
"""Number of robots without a value up to which a message names each."""


def check_robot_values(swarm: Swarm, context: Context) -> None:
    """Check the params of roles and robots, and report those without any value."""
    robots = [item for item in swarm.items if isinstance(item, RobotValues)]
    first: dict[tuple[str, int], RobotValues] = {}
    for robot in robots:
        key = (robot.role.name, integer(robot.index))
        earlier = first.setdefault(key, robot)
        if earlier is not robot:
            context.check_single([earlier.role.span, robot.role.span], f"`{_name(robot)}`")
        if robot.role.target is not None:
            _check_index(robot, robot.role.target, context)
            _check_values(robot.values, robot.role.target.member.target, context)
    parts: set[Part] = set()
    for role in swarm.items:
        if isinstance(role, Role):
            _check_values(role.values, role.member.target, context)
            own = [robot for robot in first.values() if robot.role.target is role]
            _check_complete(role, own, context)
            _check_parts(role, parts, context)


def _check_index(robot: RobotValues, role: Role, context: Context) -> None:
    most = greatest(role)
    if most is None and len(robot.index) > MOST_DIGITS:
        most = 10**MOST_DIGITS
    if most is not None and integer(robot.index) >= most:
        context.report.report(
            "unknown-robot",
            robot.role.span,
            role=role.name,
            robot=_name(robot),
            related=(Label(role.span, "the robots are counted from 0"),),
            help=last_robot(role.name, most) if most else None,
        )


def _check_values(values: list[PartValue], member: Member | None, context: Context) -> None:
    context.check_repeated((value.name for value in values), "param")
    if member is None or member in context.incomplete:
        return
    params = {str(param.name): param for param in all_items(member, Param)}
    for value in values:
        param = params.get(str(value.name))
        if param is None:
            context.report_unknown_param(value.name, f"member `{member.name}`", params)
        else:
            context.check_constant(value.value, param.type.type)


def _check_complete(role: Role, robots: Iterable[RobotValues], context: Context) -> None:
    """Report the params without a value: no default, and none in the role or in its robots."""
    member = role.member.target
    if member is None or member in context.incomplete:
        return
    given = {str(value.name) for value in role.values}
    own = {integer(robot.index): {str(v.name) for v in robot.values} for robot in robots}
    most = greatest(role)
    for param in all_items(member, Param):
        name = str(param.name)
        if not _is_required(param, context) or name in given:
            continue
        having = {number for number, names in own.items() if name in names}
        if most is not None and sum(number < most for number in having) == most:
            continue
        context.report.report(
            "missing-robot-value",
            role.name.span,
            name=name,
            robots=_without(role, most, having),
            related=(Label(param.name.span, "declared here, without a default"),),
            help=Advice(
                f"write `{role.name} : {_head(role)} {{ {name} = ... }}`, "
                "or give the param a default",
                "set param",
                role.name.span,
                param.name.span,
            ),
        )


def _check_parts(role: Role, known: set[Part], context: Context) -> None:
    """Report the params of parts that have no value, once for a part; `known` gets the parts."""
    member = role.member.target
    if member is None or member in context.incomplete:
        return
    for part in all_items(member, Part):
        component = part.component.target
        if part in known or component is None or component in context.incomplete:
            continue
        known.add(part)
        given = {str(value.name) for value in part.values}
        for param in all_items(component, Param):
            if _is_required(param, context) and str(param.name) not in given:
                _report_part(role, part, param, context)


def _report_part(role: Role, part: Part, param: Param, context: Context) -> None:
    context.report.report(
        "missing-robot-value",
        role.name.span,
        name=param.name,
        robots=f"`{role.name}.{part.name}`",
        related=(
            Label(param.name.span, "declared here, without a default"),
            Label(part.name.span, "not set here"),
        ),
        help=Advice(
            f"write `{part.name} : {part.component.span.text} {{ {param.name} = ... }}`, "
            "or give the param a default",
            "set param",
            part.name.span,
            param.name.span,
        ),
    )


def _is_required(param: Param, context: Context) -> bool:
    """Return True for a param that the model must give a value.

    Times, messages and arrays have no constants: their values are given when a robot starts.
    """
    if param.default is not None:
        return False
    match param.type.type:
        case Primitive(name=name):
            return name != "time"
        case Named() as type_:
            return isinstance(context.interfaces.get(type_), EnumType)
        case _:
            return False


def _head(role: Role) -> str:
    multiplicity = f"[{role.multiplicity.span.text}]" if role.multiplicity is not None else ""
    return f"{role.member.span.text}{multiplicity}"


def _without(role: Role, most: int | None, having: set[int]) -> str:
    """Name the robots that are not in `having`: the role, if these are all or too many."""
    if most is None or not having or most - len(having) > _MOST_NAMED:
        return f"`{role.name}`"
    without = sorted(set(range(most)) - having)
    return listed([f"{role.name}[{number}]" for number in without], "and")


def _name(robot: RobotValues) -> str:
    return f"{robot.role.name}[{robot.index}]"
