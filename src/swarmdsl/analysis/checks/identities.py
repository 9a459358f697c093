"""Checks of comparisons with the names of robots and roles."""

from __future__ import annotations

from collections.abc import Sequence

from swarmdsl.analysis.checks.context import Context
from swarmdsl.analysis.resolve.addresses import Crew, crews_of
from swarmdsl.analysis.resolve.identities import Comparison, comparisons, is_about, robot_named
from swarmdsl.analysis.resolve.membership import is_member_event
from swarmdsl.analysis.resolve.multiplicity import greatest
from swarmdsl.base.diagnostics.advice import Advice, meant
from swarmdsl.base.diagnostics.collector import listed
from swarmdsl.base.suggest import closest, suggest
from swarmdsl.project.loader import Project
from swarmdsl.syntax.ast import EventTrigger, Fitness, Property, StateMachine, Swarm

_WITH_IDENTITIES = (StateMachine, Property, Fitness)


def check_identities(project: Project, context: Context) -> None:
    """Report comparisons with a robot or role that no swarm which runs the machine has."""
    used = [node for _, node in context.used]
    crews: list[Crew] | None = None
    for node in used:
        found = list(comparisons(node)) if isinstance(node, _WITH_IDENTITIES) else ()
        if not found:
            continue
        if crews is None:
            crews = crews_of(each for each in used if isinstance(each, Swarm))
        running = [crew for crew in crews if is_about(node, crew)]
        if not context.incomplete.isdisjoint({node, *(crew.swarm for crew in running)}):
            continue
        for each in found if running else ():
            # An event from outside and a machine alone have an empty name.
            value = str(each.value.value)
            if value and _is_fact(each, context) and not any(_has(c, each) for c in running):
                _report(each, running, context)


def _is_fact(comparison: Comparison, context: Context) -> bool:
    """Return False for a field of the message with the name of a fact about the event."""
    if comparison.around is not None:
        heard = comparison.around.event
        of_member = heard is not None and is_member_event(heard.target)
        return of_member or context.typing.in_fact(comparison.around).is_envelope("sender")
    events = [each for each in comparison.triggers if isinstance(each, EventTrigger)]
    if not events or comparison.fact.name != "sender":
        return True
    return len(events) == len(comparison.triggers) and context.with_event(list(events)).is_envelope(
        "sender"
    )


def _has(crew: Crew, comparison: Comparison) -> bool:
    name = str(comparison.value.value)
    if comparison.of_role:
        return name in crew.roles
    role, number = robot_named(name)
    if role not in crew.roles or number is None:
        return False
    most = greatest(crew.roles[role])
    return most is None or number < most


def _report(comparison: Comparison, running: Sequence[Crew], context: Context) -> None:
    name = str(comparison.value.value)
    role, number = robot_named(name)
    roles = dict.fromkeys(each for crew in running for each in crew.roles)
    help_: str | None = None
    if context.report.wants_hint("unknown-identity"):
        if comparison.of_role and role in roles:
            help_ = Advice(f"this is a robot; its role is `{role}`", "rename", role)
        elif not comparison.of_role and number is None and role in roles:
            help_ = Advice(
                f"this is a role; its robots are `{role}[0]` and so on", "rename", f"{role}[0]"
            )
        elif role in roles:
            most = max(greatest(crew.roles[role]) or 0 for crew in running if role in crew.roles)
            help_ = "robots are counted from 0"
            if most:
                help_ = Advice(help_, "last robot", f"{role}[{most - 1}]")
        elif number is not None and (close := closest(role, roles)):
            help_ = meant(f"{close}[{number}]")
        else:
            help_ = suggest(role, roles, "roles")
    context.report.report(
        "unknown-identity",
        comparison.value.span,
        swarms=listed([str(crew.swarm.name) for crew in running], "or"),
        what="role" if comparison.of_role else "id",
        name=name,
        help=help_,
    )
