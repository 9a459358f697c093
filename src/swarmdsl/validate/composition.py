"""Swarms and their environments."""

from __future__ import annotations

from swarmdsl.syntax import (
    Environment,
    EnvironmentUse,
    Multiplicity,
    Role,
    Size,
    Swarm,
    World,
)
from swarmdsl.validate.context import Context


def check_swarm(swarm: Swarm, context: Context) -> None:
    """A swarm has members, as many as its multiplicities allow."""
    roles = [item for item in swarm.items if isinstance(item, Role)]
    if not roles:
        context.report.report(
            "empty-swarm",
            swarm.name.span,
            name=swarm.name,
            help="add a member: `role : Member[3]`",
        )
    for role in roles:
        if role.multiplicity is not None:
            _check_multiplicity(role.multiplicity, context)
    uses = [item.span for item in swarm.items if isinstance(item, EnvironmentUse)]
    context.check_single(uses, "the environment")


def check_environment(environment: Environment, context: Context) -> None:
    """An environment has one world and one size."""
    for kind, what in ((World, "the world"), (Size, "the size")):
        places = [item.span for item in environment.items if isinstance(item, kind)]
        context.check_single(places, what)


def _check_multiplicity(multiplicity: Multiplicity, context: Context) -> None:
    lower, upper = multiplicity.lower, multiplicity.upper or multiplicity.lower
    fault = ""
    if lower == "*" and multiplicity.upper:
        fault = "starts with `*`: a lower bound is a number"
    elif upper != "*" and int(upper) == 0:
        fault = "allows no member at all"
    elif "*" not in (lower, upper) and int(lower) > int(upper):
        fault = "ends below its start"
    if fault:
        context.report.report(
            "empty-multiplicity",
            multiplicity.span,
            multiplicity=multiplicity.span.text,
            fault=fault,
            help="write `[3]`, `[1..5]`, `[2..*]` or `[*]`",
        )
