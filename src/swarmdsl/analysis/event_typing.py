"""Types of expressions in a transition, where `event` has the message of its triggers."""

from __future__ import annotations

from collections.abc import Sequence

from swarmdsl.analysis.event_topics import is_of_swarm
from swarmdsl.analysis.types import Typing
from swarmdsl.syntax.ast import Contract, EventTrigger, MonitorTrigger, Transition
from swarmdsl.syntax.types import Type


def in_transition(transition: Transition | Contract, typing: Typing) -> Typing:
    """Return the typing in a transition or contract: `event` has the type of all its events."""
    kinds = (EventTrigger, MonitorTrigger)
    return on_events([each for each in transition.triggers if isinstance(each, kinds)], typing)


def on_events(triggers: Sequence[EventTrigger | MonitorTrigger], typing: Typing) -> Typing:
    """Return a typing in which `event` is the message of any of these triggers."""
    types = [_message(each) for each in triggers] or [None]
    alike = all(each == types[0] for each in types)
    of_swarm = bool(triggers) and all(map(is_of_swarm, triggers))
    return typing.on_event(types[0], known=alike, of_swarm=of_swarm)


def _message(trigger: EventTrigger | MonitorTrigger) -> Type | None:
    if isinstance(trigger, MonitorTrigger):
        return trigger.type.type
    return trigger.event.target.type.type if trigger.event.target is not None else None
