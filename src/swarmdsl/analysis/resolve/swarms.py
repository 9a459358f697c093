"""Resolve the names of roles, and of params that an optimization chooses."""

from __future__ import annotations

from collections.abc import Mapping
from functools import cache

from swarmdsl.analysis.resolve.inheritance import all_items, by_name
from swarmdsl.analysis.resolve.report_unresolved import report_missing_inside
from swarmdsl.analysis.resolve.scopes import FileScope
from swarmdsl.base.diagnostics.collector import Diagnostics
from swarmdsl.syntax.ast import (
    CountRange,
    Member,
    Optimization,
    Param,
    ParamRange,
    Ref,
    RobotValues,
    Role,
    Swarm,
)


def link_swarm(swarm: Swarm, scope: FileScope, report: Diagnostics) -> None:
    """Resolve the roles of robots that have values of their own."""
    roles = by_name(swarm.items, Role)
    for item in swarm.items:
        if isinstance(item, RobotValues):
            _link_role(item.role, swarm, roles, scope, report)


def _link_role(
    ref: Ref[Role],
    swarm: Swarm,
    roles: Mapping[str, Role],
    scope: FileScope,
    report: Diagnostics,
) -> None:
    ref.target = roles.get(ref.name)
    if ref.target is None:
        kind = f"role in swarm `{swarm.name}`"
        report_missing_inside(kind, ref.name, ref.span, roles, scope, report)


def link_optimization(owner: Optimization, scope: FileScope, report: Diagnostics) -> None:
    """Resolve the roles of the swarm and the params of their members."""
    swarm = owner.swarm.target
    if swarm is None:
        return
    roles = by_name(swarm.items, Role)
    params_of = cache(_params)
    for item in owner.items:
        if not isinstance(item, (CountRange, ParamRange)):
            continue
        _link_role(item.role, swarm, roles, scope, report)
        if item.role.target is None:
            continue
        member = item.role.target.member.target
        if isinstance(item, ParamRange) and member is not None:
            params = params_of(member)
            item.param.target = params.get(item.param.name)
            if item.param.target is None:
                kind = f"param of member `{member.name}`"
                report_missing_inside(kind, item.param.name, item.param.span, params, scope, report)


def _params(member: Member) -> dict[str, Param]:
    return by_name(all_items(member, Param), Param)
