"""Checks of events between machines: sent events are handled, awaited events are sent.

A swarm event is checked in each swarm, over the machines of its members; a swarm event of a
machine in no swarm over all machines. Other events can come from or go to nodes outside of
the model.
"""

from __future__ import annotations

from collections import deque
from collections.abc import Iterator, Mapping

from swarmdsl.analysis.checks.context import Context
from swarmdsl.analysis.checks.facts import Exchange
from swarmdsl.analysis.event_topics import event_of, received_topic
from swarmdsl.analysis.resolve.inheritance import all_items, lineage
from swarmdsl.base.diagnostics.advice import Advice
from swarmdsl.base.diagnostics.collector import Label, listed
from swarmdsl.project.loader import Project
from swarmdsl.syntax.ast import (
    BehaviorUse,
    Component,
    Declaration,
    Event,
    EventTrigger,
    Member,
    MonitorTrigger,
    Part,
    Ref,
    Role,
    Send,
    State,
    StateMachine,
    Swarm,
    nodes_of,
)


def check_events(project: Project, context: Context) -> None:
    """Check the events of all machines of the system."""
    before = context.facts.exchanges
    found: dict[Declaration | None, Exchange] = {}
    nodes = [node for _, node in context.used if isinstance(node, (StateMachine, Member, Swarm))]
    machines = [node for node in nodes if isinstance(node, StateMachine)]
    members = [node for node in nodes if isinstance(node, Member)]
    swarms = [node for node in nodes if isinstance(node, Swarm)]
    for machine in machines:
        found[machine] = before.get(machine) or _of_machine(machine, context)
    for member in members:
        found[member] = before.get(member) or _of_member(member, found, context)
    for swarm in swarms:
        found[swarm] = before.get(swarm) or _of_swarm(swarm, found, context)
    context.facts.exchanges = found
    groups = [(found[swarm], found[swarm]) for swarm in swarms]
    in_swarms: set[StateMachine | None] = set().union(*(group.machines for group, _ in groups))
    alone = [found[machine] for machine in machines if machine not in in_swarms]
    if alone:
        everyone = Exchange().add(found[machine] for machine in machines)
        groups.append((Exchange().add(alone), everyone))
    _check_swarm_events(groups, context)
    if swarms:
        _check_operator_events([found[machine] for machine in machines], context)
    _check_own_events([found[member] for member in members], context)


def _check_swarm_events(groups: list[tuple[Exchange, Exchange]], context: Context) -> None:
    """Check the swarm events of the first exchange of each pair over the second."""
    unhandled: dict[Send, list[str]] = {}
    unsent: dict[EventTrigger, list[str]] = {}
    for judged, known in groups:
        if not known.complete:
            continue
        for topic, send in judged.sent.items():
            if _is_swarm_event(send) and topic not in known.awaited:
                unhandled.setdefault(send, []).append(known.name)
        for topic, trigger in judged.awaited.items():
            if topic in known.sent or isinstance(trigger, MonitorTrigger):
                continue
            if trigger.event.target is not None and trigger.event.target.operator:
                continue
            if _is_swarm_event(trigger):
                unsent.setdefault(trigger, []).append(known.name)
    for send, names in unhandled.items():
        context.report.report(
            "unhandled-event",
            send.event.span,
            where=where_of("swarm", names),
            name=send.event.name,
            help=f"add `on {send.event.name} -> ...` to a state of a machine that should react",
        )
    if not context.report.wants("unsent-event"):
        return
    for trigger, names in unsent.items():
        context.report.report(
            "unsent-event",
            trigger.span,
            where=where_of("swarm", names),
            name=trigger.event.name,
            help=Advice(
                f"add `send {trigger.event.name}` to an effect, or declare it as `swarm operator`",
                "operator event",
                str(trigger.event.name),
            ),
        )


def _check_operator_events(machines: list[Exchange], context: Context) -> None:
    """Report events that a person may send although no machine waits for them."""
    known = Exchange().add(machines)
    declared = [node for _, node in context.used if isinstance(node, Event) and node.operator]
    for event in declared if known.complete else ():
        if event.swarm and received_topic(event) not in known.awaited:
            context.report.report(
                "unhandled-event",
                event.name.span,
                where="",
                name=event.name,
                help=f"add `on {event.name} -> ...` to a state of a machine that should react",
            )


def _check_own_events(members: list[Exchange], context: Context) -> None:
    """Report events that reach no other member, but for which another member waits.

    An event that no member waits for is meant for a node outside of the model.
    """
    senders: dict[str, list[Exchange]] = {}
    hearing: dict[str, EventTrigger | MonitorTrigger] = {}
    for member in members:
        for topic in member.sent:
            senders.setdefault(topic, []).append(member)
        for topic, trigger in member.awaited.items():
            hearing.setdefault(topic, trigger)
    for topic, own in senders.items():
        send = own[0].sent[topic]
        if _is_swarm_event(send) or topic not in hearing:
            continue
        if any(topic in member.awaited or not member.complete for member in own):
            continue
        context.report.report(
            "unhandled-event",
            send.event.span,
            where=where_of("member", [member.name for member in own]),
            name=send.event.name,
            related=(Label(hearing[topic].span, "another member waits for it here"),),
            help=Advice(
                f"as `swarm event {send.event.name}` it reaches the other members",
                "declare swarm event",
                str(send.event.name),
            ),
        )


def _is_swarm_event(node: Send | EventTrigger) -> bool:
    return node.event.target is not None and node.event.target.swarm


def where_of(kind: str, names: list[str]) -> str:
    """Return ` in swarms A and B` for a message; nothing without names."""
    plural = "s" if len(names) > 1 else ""
    return f" in {kind}{plural} {listed(names, 'and')}" if all(names) else ""


def _of_machine(machine: StateMachine, context: Context) -> Exchange:
    """Exchange of one machine."""
    found = Exchange(machines={machine}, complete=machine not in context.incomplete)
    kinds: tuple[type[Send | EventTrigger | MonitorTrigger], ...]
    kinds = (Send, EventTrigger, MonitorTrigger)
    nodes = (node for kind in kinds for node in nodes_of(machine, kind))
    for node in sorted(nodes, key=lambda node: node.span.start):
        match node:
            case Send(event=Ref(target=None)) | EventTrigger(event=Ref(target=None)):
                found.complete = False
            case Send(event=Ref(target=Event() as event)):
                found.sent.setdefault(received_topic(event), node)
            case EventTrigger() | MonitorTrigger():
                source = event_of(node)
                assert source is not None
                found.awaited.setdefault(received_topic(source), node)
    return found


def _of_member(
    member: Member, known: Mapping[Declaration | None, Exchange], context: Context
) -> Exchange:
    """Exchange of the machines of a member."""
    machines = _machines(member, context)
    return Exchange(str(member.name)).add(known.get(machine) for machine in machines)


def _of_swarm(
    swarm: Swarm, known: Mapping[Declaration | None, Exchange], context: Context
) -> Exchange:
    """Exchange of the members of a swarm."""
    roles = [item for item in swarm.items if isinstance(item, Role)]
    found = Exchange(str(swarm.name), complete=swarm not in context.incomplete)
    return found.add(known.get(role.member.target) for role in roles)


def _machines(member: Member, context: Context) -> Iterator[StateMachine | None]:
    """Behaviours of a member and its parts with their submachines.

    None stands for a machine that may be missing.
    """
    ahead = deque(behaviors_of(member, context))
    seen = set()
    while ahead:
        machine = ahead.popleft()
        if machine in seen:
            continue
        seen.add(machine)
        yield machine
        for state in nodes_of(machine, State) if machine is not None else ():
            if state.machine is not None:
                ahead.append(state.machine.target)


def behaviors_of(member: Member, context: Context) -> Iterator[StateMachine | None]:
    """Yield the behaviours of a member and its parts; None stands for one that may be missing."""
    parts = [part.component.target for part in all_items(member, Part)]
    owners: list[Member | Component | None] = [member, *parts]
    for owner in owners:
        for each in lineage(owner) if owner is not None else ():
            if each in context.incomplete or (each.base is not None and each.base.target is None):
                yield None
        for use in all_items(owner, BehaviorUse) if owner is not None else ():
            yield use.machine.target
        if owner is None:
            yield None
