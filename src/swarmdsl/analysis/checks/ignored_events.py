"""Check of swarm events that arrive in states that ignore them.

It is off by default: most states ignore events on purpose.
"""

from __future__ import annotations

from collections.abc import Iterator

from swarmdsl.analysis.checks.context import Context
from swarmdsl.analysis.checks.events import behaviors_of, where_of
from swarmdsl.analysis.event_topics import event_of, received_topic
from swarmdsl.analysis.resolve.multiplicity import greatest
from swarmdsl.analysis.resolve.states import regions
from swarmdsl.base.diagnostics.advice import Advice
from swarmdsl.base.diagnostics.collector import Label, listed
from swarmdsl.base.records import dataclass, field
from swarmdsl.project.loader import Project
from swarmdsl.syntax.ast import (
    Activity,
    Container,
    Defer,
    DoneTrigger,
    Event,
    EventTrigger,
    MonitorTrigger,
    Parallel,
    Region,
    Role,
    Send,
    State,
    StateMachine,
    Swarm,
    Transition,
    nodes_of,
)

_MOST_NAMED = 3
"""Number of states that a message names."""

Topics = frozenset[str]


Sender = Send | Event
"""Effect that sends an event, or an event that a person may send."""


@dataclass
class _Ignored:
    """States that ignore an event that a transition elsewhere handles, and the swarms."""

    by: Sender
    states: dict[State, None] = field(default_factory=dict)
    swarms: dict[str, None] = field(default_factory=dict)


class _Behavior:
    """A machine with its submachines.

    `handled` has the first trigger of each topic; `waiting` are the innermost states in which the
    machine waits, each with the topics that it, a state around it or a region beside it handles
    or defers.
    """

    def __init__(self, machine: StateMachine) -> None:
        self.handled: dict[str, EventTrigger | MonitorTrigger] = {}
        self.waiting: list[tuple[State, Topics]] = []
        self._enter(machine, frozenset(), (machine,))

    def _enter(self, container: Container, above: Topics, around: tuple[StateMachine, ...]) -> None:
        for item in container.items:
            if isinstance(item, (State, Parallel)):
                self._enter_state(item, above, around)

    def _enter_state(
        self, state: State | Parallel, above: Topics, around: tuple[StateMachine, ...]
    ) -> None:
        """Add a state and the states inside; `around` ends a cycle of submachines."""
        for topic, trigger in _triggers(state):
            self.handled.setdefault(topic, trigger)
        topics = above | _own_topics(state)
        inner = regions(state)
        if inner:
            inside = {region: frozenset(_topics_inside(region)) for region in inner}
            for region in inner:
                beside = (inside[each] for each in inner if each is not region)
                self._enter(region, topics.union(*beside), around)
        elif isinstance(state, State) and state.machine is not None:
            machine = state.machine.target
            if machine is not None and machine not in around:
                self._enter(machine, topics, (*around, machine))
        elif isinstance(state, State) and any(
            isinstance(i, (State, Parallel)) for i in state.items
        ):
            self._enter(state, topics, around)
        elif isinstance(state, State) and not _is_left_at_once(state):
            self.waiting.append((state, topics))


def check_ignored_events(project: Project, context: Context) -> None:
    """Report events of other robots that some states of a machine handle and others ignore."""
    if not context.report.wants("ignored-event"):
        return
    found: dict[EventTrigger | MonitorTrigger, _Ignored] = {}
    behaviors: dict[StateMachine, _Behavior] = {}
    for _, swarm in context.used:
        if isinstance(swarm, Swarm) and context.facts.exchanges[swarm].complete:
            _check_swarm(swarm, behaviors, found, context)
    for trigger, ignored in found.items():
        _report(trigger, ignored, context)


def _check_swarm(
    swarm: Swarm,
    behaviors: dict[StateMachine, _Behavior],
    found: dict[EventTrigger | MonitorTrigger, _Ignored],
    context: Context,
) -> None:
    """Collect what the machines of a swarm ignore."""
    roles = [item for item in swarm.items if isinstance(item, Role)]
    for role in roles:
        member = role.member.target
        sent = _sent_to(role, roles, context)
        for machine in behaviors_of(member, context) if member is not None and sent else ():
            if machine is None:
                continue
            behavior = behaviors.get(machine)
            if behavior is None:
                behavior = behaviors[machine] = _Behavior(machine)
            for topic, trigger in behavior.handled.items():
                ignoring = [state for state, topics in behavior.waiting if topic not in topics]
                if topic in sent and ignoring:
                    ignored = found.setdefault(trigger, _Ignored(sent[topic]))
                    ignored.states.update(dict.fromkeys(ignoring))
                    ignored.swarms[str(swarm.name)] = None


def _sent_to(role: Role, roles: list[Role], context: Context) -> dict[str, Sender]:
    """Return the swarm events that others may send to those of a role, by topic."""
    found: dict[str, Sender] = {
        received_topic(event): event
        for _, event in context.used
        if isinstance(event, Event) and event.operator and event.swarm
    }
    for sender in roles:
        exchange = context.facts.exchanges.get(sender.member.target)
        if exchange is None or (sender is role and greatest(role) == 1):
            continue
        machines = sorted(exchange.machines, key=lambda machine: str(machine.name))
        for send in (each for machine in machines for each in nodes_of(machine, Send)):
            event = send.event.target
            if event is None or not event.swarm:
                continue
            named = send.to.named_role if send.to is not None else None
            if named is None or named[0] == role.name:
                found.setdefault(received_topic(event), send)
    return found


def _triggers(state: State | Parallel) -> Iterator[tuple[str, EventTrigger | MonitorTrigger]]:
    """Yield the events that trigger transitions of a state, with their topics."""
    for item in state.items:
        for trigger in item.triggers if isinstance(item, Transition) else ():
            source = event_of(trigger)
            if source is not None and isinstance(trigger, (EventTrigger, MonitorTrigger)):
                yield received_topic(source), trigger


def _own_topics(state: State | Parallel) -> Topics:
    """Topics of the events that a state handles or defers."""
    deferred = (each for item in state.items if isinstance(item, Defer) for each in item.events)
    events = (each.event.target for each in deferred)
    kept = {received_topic(event) for event in events if event is not None}
    return frozenset(kept | {topic for topic, _ in _triggers(state)})


def _topics_inside(container: Container) -> Iterator[str]:
    """Yield the topics that states inside a container handle or defer."""
    for item in container.items:
        if isinstance(item, (State, Parallel)):
            yield from _own_topics(item)
        if isinstance(item, (State, Parallel, Region)):
            yield from _topics_inside(item)


def _is_left_at_once(state: State) -> bool:
    """Return True for a state without an activity that completes as soon as it is entered."""
    if any(isinstance(item, Activity) for item in state.items):
        return False
    return any(
        item.guard is None and any(isinstance(trigger, DoneTrigger) for trigger in item.triggers)
        for item in state.items
        if isinstance(item, Transition)
    )


def _report(trigger: EventTrigger | MonitorTrigger, ignored: _Ignored, context: Context) -> None:
    names = [str(state.name) for state in ignored.states]
    states = listed(names, "and") if len(names) <= _MOST_NAMED else f"{len(names)} states"
    shown = [*ignored.states][:_MOST_NAMED]
    by = ignored.by
    name = by.name if isinstance(by, Event) else by.event.name
    who = "a person" if isinstance(by, Event) else "another robot"
    place = by.name.span if isinstance(by, Event) else by.event.span
    context.report.report(
        "ignored-event",
        trigger.span,
        name=name,
        states=states,
        where=where_of("swarm", [*ignored.swarms]),
        related=(
            *(Label(state.name.span, "it is ignored in this state") for state in shown),
            Label(place, f"{who} may send it at any time"),
        ),
        help=Advice(
            f"add `on {name}` or `defer {name}` to these states, or to one around them",
            "insert",
            f"defer {name}",
            *(state.name.span for state in ignored.states),
        ),
    )
