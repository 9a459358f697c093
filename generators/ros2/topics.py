"""Topics of events: robots have their own, swarm events are in the namespace of the swarm."""

from __future__ import annotations

from swarmdsl.codegen import Diagnostics, incoming_topic
from swarmdsl.codegen.python import Call, Source
from swarmdsl.codegen.shared import envelopes_of
from swarmdsl.ir import Delivery, Event, Named, StateMachine, System

from .actions import feedback_topic
from .imports import Imports
from .names import check_topic
from .package import heard_events, sent_events

_INCOMING = incoming_topic("", swarm=True)


def topics(
    machine: StateMachine,
    system: System,
    imports: Imports,
    report: Diagnostics,
) -> list[tuple[Event, Call]]:
    """Return the declaration of each event of a machine."""
    heard, sent = heard_events(machine), sent_events(machine)
    is_heard, is_sent = frozenset(heard), frozenset(sent)
    found = []
    around = envelopes_of(system)
    for name in dict.fromkeys([*heard, *sent]):
        event = system.event(name)
        if event.predefined:
            continue  # heartbeats raise it
        assert isinstance(event.type, Named)
        topic, of_swarm = place(event, name in is_sent)
        if event.type in imports.messages_of_actions:
            topic = feedback_topic(event, name in is_sent, report)
        check_topic(topic, event.origin, report, of_swarm=of_swarm)
        arguments = (name, Source(imports.interface(event.type, "msg")), topic)
        keywords: list[tuple[str, object]] = []
        keywords += [("swarm", True)] if of_swarm else []
        keywords += [("heard", True)] if name in is_heard else []
        keywords += [("sent", True)] if name in is_sent else []
        if event.swarm and name in is_sent and _is_heard_here(event, system):
            keywords.append(("local", event.topic))
        if name in around:
            interface = imports.interface(around[name].type, "msg")
            keywords.append(("envelope", Source(interface)))
        if event.delivery is not None:
            keywords.append(("delivery", _delivery(event.delivery)))
        found.append((event, Call("Topic", arguments, tuple(keywords))))
    return found


def _delivery(delivery: Delivery) -> Call:
    """Return the call for the settings of a delivery; events are reliable unless it says else."""
    given: list[tuple[str, object]] = []
    given += [("reliable", False)] if delivery.reliable is False else []
    given += [("latest", True)] if delivery.latest else []
    for name in ("keep", "lifespan", "deadline"):
        value = getattr(delivery, name)
        given += [(name, value)] if value is not None else []
    return Call("Delivery", (), tuple(given))


def place(event: Event, is_sent: bool) -> tuple[str, bool]:
    """Return the topic of an event, and True if it is in the namespace of the swarm."""
    if event.swarm:
        return event.topic.lstrip("/"), True
    # Events from other robots: in ROS 1 the bridge has topics of its own for them.
    if event.topic.startswith(_INCOMING) and not is_sent:
        return event.topic.removeprefix(_INCOMING).lstrip("/"), True
    return event.topic, False


def _is_heard_here(sent: Event, system: System) -> bool:
    """Return True if a swarm event is also an event of the robot that sends it."""
    return sent.topic in system.robot_topics
