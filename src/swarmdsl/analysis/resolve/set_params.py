"""Params that parts, roles and robots set."""

from __future__ import annotations

from collections.abc import Iterator

from swarmdsl.syntax.ast import (
    Component,
    Member,
    Part,
    PartValue,
    RobotValues,
    Role,
    TopLevel,
    nodes_of,
)


def set_params(owner: TopLevel) -> Iterator[tuple[Component | Member, list[PartValue]]]:
    """Yield the values in a declaration that set params of a component or of a member."""
    for part in nodes_of(owner, Part):
        if part.component.target is not None:
            yield part.component.target, part.values
    for role in nodes_of(owner, Role):
        if role.member.target is not None:
            yield role.member.target, role.values
    for robot in nodes_of(owner, RobotValues):
        if robot.role.target is not None and robot.role.target.member.target is not None:
            yield robot.role.target.member.target, robot.values
