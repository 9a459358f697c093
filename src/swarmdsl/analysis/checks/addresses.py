"""Checks of the addresses of events, in each swarm that runs the machine."""

from __future__ import annotations

from collections.abc import Iterator

from swarmdsl.analysis.checks.context import Context
from swarmdsl.analysis.event_topics import received_topic
from swarmdsl.analysis.resolve.addresses import (
    Crew,
    NamedRole,
    crews_of,
    named_roles,
    roles_of,
    values_like_roles,
)
from swarmdsl.analysis.resolve.identities import robot_named
from swarmdsl.analysis.resolve.multiplicity import greatest
from swarmdsl.base.diagnostics.advice import Advice, last_robot, write
from swarmdsl.base.diagnostics.collector import Label, listed
from swarmdsl.base.suggest import suggest
from swarmdsl.project.loader import Project
from swarmdsl.syntax.ast import Address, Role, Send, StateMachine, Swarm, nodes_of

EVERYBODY = ("all", "everybody", "everyone", "others")
"""Words for all robots, which no role has for a name."""


def check_addresses(project: Project, context: Context) -> None:
    """Check the roles that machines name: a swarm that runs a machine has them."""
    used = [node for _, node in context.used]
    complete = (node for node in used if node not in context.incomplete)
    crews = crews_of(node for node in complete if isinstance(node, Swarm))
    missing: dict[Address, list[NamedRole]] = {}
    for machine in used:
        if isinstance(machine, StateMachine):
            sends = {send.to: send for send in nodes_of(machine, Send)}
            for found in named_roles(machine, crews):
                if found.role is None:
                    missing.setdefault(found.address, []).append(found)
                else:
                    tree = found.address.index
                    number = context.typing.folding.value(tree) if tree is not None else None
                    _check_index(found, found.role, number, context)
                    _check_handled(sends[found.address], found, found.role, context)
            for found, number in _constant_ids(machine, crews, context):
                if found.role is None:
                    missing.setdefault(found.address, []).append(found)
                else:
                    _check_index(found, found.role, number, context)
    for names in missing.values():
        _report_missing(names, context)
    for crew in crews:
        for machine in crew.machines:
            for use, role in values_like_roles(machine, crew):
                context.report.report(
                    "unclear-address",
                    use.span,
                    name=use.name,
                    swarm=crew.swarm.name,
                    related=(Label(role.name.span, "a role has this name"),),
                    help="give the value another name",
                )


def _constant_ids(
    machine: StateMachine, crews: list[Crew], context: Context
) -> Iterator[tuple[NamedRole, int | None]]:
    """Yield the ids that are known at compile time, `"uav"` and `"uav[2]"`, in each swarm."""
    for address in nodes_of(machine, Address):
        tree = address.id.tree
        if tree is None or address.named_role is not None:
            continue
        value = context.typing.folding.value(tree)
        if not isinstance(value, str):
            continue
        name, number = robot_named(value)
        for crew in crews:
            if machine in crew.machines:
                role = crew.roles.get(name)
                yield NamedRole(address, name, address.span, crew.swarm, role), number


def _check_index(found: NamedRole, role: Role, number: object, context: Context) -> None:
    most = greatest(role)
    if most is not None and isinstance(number, int) and number >= most:
        context.report.report(
            "unknown-robot",
            found.address.span,
            role=role.name,
            robot=f"{role.name}[{number}]",
            related=(Label(role.span, "the robots are counted from 0"),),
            help=last_robot(role.name, most) if most else None,
        )


def _check_handled(send: Send, found: NamedRole, role: Role, context: Context) -> None:
    """Report an event for a role that does not handle it, but another role does."""
    event, exchanges = send.event.target, context.facts.exchanges
    of_swarm, of_role = exchanges.get(found.swarm), exchanges.get(role.member.target)
    if event is None or of_swarm is None or of_role is None or not of_swarm.complete:
        return
    topic = received_topic(event)
    if event.swarm and topic in of_swarm.awaited and topic not in of_role.awaited:
        context.report.report(
            "unhandled-event",
            found.span,
            where=f" by role `{role.name}` of swarm `{found.swarm.name}`",
            name=send.event.name,
            related=(Label(of_swarm.awaited[topic].span, "another role handles it here"),),
            help=f"add `on {send.event.name} -> ...` to a state of a machine of this role, "
            f"or choose another one",
        )


def _report_missing(found: list[NamedRole], context: Context) -> None:
    """Report a name that is no role in some swarms that run the machine."""
    help_ = None
    if context.report.wants_hint("unresolved-name"):
        roles = dict.fromkeys(name for each in found for name in roles_of(each.swarm))
        help_ = suggest(found[0].name, roles, "roles")
        if not found[0].name:
            help_ = Advice(
                "an empty address is that of nobody: leave out `to` to send to all others",
                "remove address",
            )
        elif found[0].name == "sender":
            help_ = write("event.sender")
        elif found[0].name in EVERYBODY:
            help_ = "leave out `to` to send to all others"
    swarms = listed([str(each.swarm.name) for each in found], "or")
    context.report.report(
        "unresolved-name",
        found[0].span,
        kind=f"role in swarm {swarms}",
        name=found[0].name,
        help=help_,
    )
