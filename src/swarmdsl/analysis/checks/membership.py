"""Checks of heartbeats, and of the machines that rely on them."""

from __future__ import annotations

from swarmdsl.analysis.checks.addresses import EVERYBODY
from swarmdsl.analysis.checks.context import Context
from swarmdsl.analysis.resolve.addresses import Crew, crews_of
from swarmdsl.analysis.resolve.membership import (
    MEMBER_EVENTS,
    is_member_event,
    neighbor_calls,
    presence_calls,
)
from swarmdsl.base.diagnostics.advice import Advice, insert
from swarmdsl.base.diagnostics.collector import Label, listed
from swarmdsl.base.source import Span
from swarmdsl.base.suggest import suggest
from swarmdsl.project.loader import Project
from swarmdsl.syntax.ast import (
    Cancel,
    Declaration,
    DeferredEvent,
    Event,
    EventTrigger,
    ExpressionTree,
    Fitness,
    Heartbeat,
    Property,
    RoleUse,
    Send,
    StateMachine,
    Swarm,
    Value,
    nodes_of,
)
from swarmdsl.syntax.types import DURATION


def check_heartbeat(swarm: Swarm, context: Context) -> None:
    """Check that a swarm has one heartbeat, and that no robot is lost between two of them."""
    found = [item for item in swarm.items if isinstance(item, Heartbeat)]
    context.check_single([item.span for item in found], "the heartbeat")
    for item in found:
        times = []
        for name, given in (("heartbeat", item.period), ("lost after", item.timeout)):
            if given.tree is None:
                continue
            context.check_constant(given, DURATION)
            value = context.typing.folding.value(given.tree)
            if not isinstance(value, (int, float)) or isinstance(value, bool):
                continue
            times.append(value)
            if value < 1_000_000:
                context.report.report("impossible-setting", given.span, name=name, least="1 ms")
        if len(times) == 2 and times[1] <= times[0] and min(times) > 0:
            context.report.report(
                "early-loss",
                item.timeout.span,
                related=(Label(item.period.span, "the time between two heartbeats"),),
                help=_longer(item.period.tree),
            )


def check_membership(project: Project, context: Context) -> None:
    """Check the machines that rely on heartbeats, in each swarm that runs them."""
    used = [node for _, node in context.used]
    complete = (node for node in used if node not in context.incomplete)
    crews: list[Crew] | None = None
    hidden: dict[Event, Crew] = {}
    for node in used:
        _check_values(node, context)
        if not isinstance(node, StateMachine):
            continue
        _check_sent(node, context)
        places, hiding = _places(node), _hiding_events(node)
        if not places and not hiding:
            continue
        if crews is None:
            crews = crews_of(each for each in complete if isinstance(each, Swarm))
        running = [crew for crew in crews if node in crew.machines]
        hidden.update({each: crew for crew in running if _beats(crew.swarm) for each in hiding})
        _check_beating(places, running, context)
        _check_roles(node, running, context)
    for event, crew in hidden.items():
        context.report.report(
            "hidden-heartbeat",
            event.name.span,
            name=event.name,
            swarm=crew.swarm.name,
            help=Advice(
                "give it another name, or delete it if the heartbeat shall raise it",
                "remove declaration",
            ),
        )


def _longer(period: ExpressionTree | None) -> str:
    text = "write a longer time, such as three heartbeats: one of them may be late"
    if isinstance(period, Value) and period.unit and isinstance(period.value, (int, float)):
        return Advice(text, "propose", f"{3 * period.value:g} {period.unit}")
    return text


def _awaited(machine: StateMachine) -> list[EventTrigger | DeferredEvent]:
    return [*nodes_of(machine, EventTrigger), *nodes_of(machine, DeferredEvent)]


def _hiding_events(machine: StateMachine) -> list[Event]:
    """Return the declared events of a machine that have the names of those of heartbeats."""
    events = [each.event.target for each in _awaited(machine) if each.event.name in MEMBER_EVENTS]
    return [each for each in events if each is not None and not is_member_event(each)]


def _beats(swarm: Swarm) -> bool:
    return any(isinstance(item, Heartbeat) for item in swarm.items)


def _places(machine: StateMachine) -> list[tuple[str, Span]]:
    """Return the uses of heartbeats in a machine, each with its name."""
    found = [
        (str(each.event.name), each.event.span)
        for each in _awaited(machine)
        if is_member_event(each.event.target)
    ]
    found += [("present", call.function.span) for call in presence_calls(machine)]
    return found


def _check_beating(places: list[tuple[str, Span]], crews: list[Crew], context: Context) -> None:
    silent = [crew.swarm for crew in crews if not _beats(crew.swarm)]
    if silent:
        name, span = min(places, key=lambda place: place[1].start)
        context.report.report(
            "no-heartbeat",
            span,
            name=name,
            swarms=listed([str(swarm.name) for swarm in silent], "and"),
            related=(Label(silent[0].name.span, "this swarm runs the machine"),),
            help=insert("heartbeat 1 s lost after 5 s", silent[0].name.span, to="the swarm"),
        )


def _check_roles(machine: StateMachine, crews: list[Crew], context: Context) -> None:
    """Report roles that a swarm which runs the machine does not have."""
    for call in presence_calls(machine):
        for use in call.arguments:
            if not isinstance(use, RoleUse):
                continue
            without = [crew for crew in crews if use.name not in crew.roles]
            if not without:
                continue
            help_ = None
            if context.report.wants_hint("unresolved-name"):
                roles = dict.fromkeys(name for crew in without for name in crew.roles)
                help_ = suggest(use.name, roles, "roles")
                if use.name in EVERYBODY:
                    help_ = "write `present()` for all robots of the swarm"
            swarms = listed([str(crew.swarm.name) for crew in without], "or")
            kind = f"role in swarm {swarms}"
            context.report.report("unresolved-name", use.span, kind=kind, name=use.name, help=help_)


def _check_sent(machine: StateMachine, context: Context) -> None:
    """Report events of heartbeats that a machine sends itself."""
    effects: list[Send | Cancel] = [*nodes_of(machine, Send), *nodes_of(machine, Cancel)]
    for effect in effects:
        if is_member_event(effect.event.target):
            context.report.report(
                "misplaced-membership",
                effect.event.span,
                name=effect.event.name,
                fault="cannot be sent: heartbeats raise it",
                help="declare an event of your own, under another name",
            )


def _check_values(owner: Declaration, context: Context) -> None:
    """Report counts of robots where no robot runs; constants are checked elsewhere."""
    if not isinstance(owner, (Fitness, Property)):
        return
    for call in (*presence_calls(owner), *neighbor_calls(owner)):
        context.report.report(
            "misplaced-membership",
            call.span,
            name=call.function,
            fault="is known to state machines only",
            help="use it in a guard, an effect or an argument of a state machine",
        )
