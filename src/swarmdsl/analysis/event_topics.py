"""The topics on which events are heard: what is heard on one topic is one event.

An event that is declared and a topic that a transition monitors are the same where the
topic is, as are two events that are declared with one topic.
"""

from __future__ import annotations

from swarmdsl.base.naming import incoming_topic, snake_case
from swarmdsl.syntax.ast import Event, EventTrigger, MonitorTrigger, Trigger


def topic_of(event: Event) -> str:
    """The topic that an event is sent on: its name where none is given."""
    return str(event.topic) if event.topic is not None else snake_case(event.name)


def heard_on(source: Event | MonitorTrigger) -> str:
    """The topic on which a machine hears of an event."""
    if isinstance(source, MonitorTrigger):
        return str(source.topic)
    return incoming_topic(topic_of(source), source.swarm)


def awaited(trigger: Trigger) -> Event | MonitorTrigger | None:
    """The event that a trigger waits for; None for what is no event, or is not resolved."""
    match trigger:
        case MonitorTrigger():
            return trigger
        case EventTrigger():
            return trigger.event.target
    return None
