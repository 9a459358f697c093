"""Topics of events. All events on one topic, declared or monitored, are the same event."""

from __future__ import annotations

from swarmdsl.base.naming import incoming_topic, snake_case
from swarmdsl.syntax.ast import Event, EventTrigger, MonitorTrigger, Trigger


def topic_of(event: Event) -> str:
    """Return the topic that an event is sent on, by default its name."""
    return str(event.topic) if event.topic is not None else snake_case(event.name)


def received_topic(source: Event | MonitorTrigger) -> str:
    """Return the topic on which a machine receives an event."""
    if isinstance(source, MonitorTrigger):
        return str(source.topic)
    return incoming_topic(topic_of(source), source.swarm)


def is_of_swarm(trigger: Trigger) -> bool:
    """Return True for an event that other robots send, or one that is not known."""
    if not isinstance(trigger, EventTrigger):
        return False
    return trigger.event.target is None or trigger.event.target.swarm


def event_of(trigger: Trigger) -> Event | MonitorTrigger | None:
    """Return the event of a trigger; None for other triggers and unresolved events."""
    match trigger:
        case MonitorTrigger():
            return trigger
        case EventTrigger():
            return trigger.event.target
    return None
