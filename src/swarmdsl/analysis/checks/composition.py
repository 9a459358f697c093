"""Checks of swarms and environments."""

from __future__ import annotations

from math import isinf

from swarmdsl.analysis.checks.context import Context
from swarmdsl.base.diagnostics.advice import Advice, sizes
from swarmdsl.syntax.ast import (
    Environment,
    EnvironmentUse,
    FitnessUse,
    Multiplicity,
    Role,
    Size,
    Swarm,
    World,
    in_metres,
)

# The number of members has at most this many digits.
_MAX_DIGITS = 9


def check_swarm(swarm: Swarm, context: Context) -> None:
    """Check the roles of a swarm and their multiplicities."""
    roles = [item for item in swarm.items if isinstance(item, Role)]
    if not roles:
        context.report.report(
            "empty-swarm",
            swarm.name.span,
            name=swarm.name,
            help=Advice("add a member: `role : Member[3]`", "add member"),
        )
    for role in roles:
        if role.multiplicity is not None:
            _check_multiplicity(role.multiplicity, context)
    uses = [item.span for item in swarm.items if isinstance(item, EnvironmentUse)]
    context.check_single(uses, "the environment")
    goals = [item.span for item in swarm.items if isinstance(item, FitnessUse)]
    context.check_single(goals, "the fitness")


def check_environment(environment: Environment, context: Context) -> None:
    """Check that an environment has one world and one size."""
    for kind, what in ((World, "the world"), (Size, "the size")):
        places = [item.span for item in environment.items if isinstance(item, kind)]
        context.check_single(places, what)
    for item in environment.items:
        if isinstance(item, Size):
            _check_size(item, context)


def _check_size(size: Size, context: Context) -> None:
    for length in filter(None, (size.width, size.depth, size.height)):
        metres = in_metres(length)
        if metres == 0 or isinf(metres):
            context.report.report(
                "impossible-size",
                size.span,
                size=length,
                fault="leaves no room" if metres == 0 else "is too large",
            )


def _check_multiplicity(multiplicity: Multiplicity, context: Context) -> None:
    lower, upper = multiplicity.lower, multiplicity.upper or multiplicity.lower
    fault = ""
    if max(len(lower), len(upper)) > _MAX_DIGITS:
        fault = "is too large"
    elif lower == "*" and multiplicity.upper:
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
            help=sizes("[3]", "[1..5]", "[2..*]", "[*]"),
        )
