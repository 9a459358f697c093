"""Headers of sent events: robots fill in their name and the time."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from swarmdsl.ir import Event, Message, Named, System

_OF_ROS = Named("std_msgs", "Header")
_OF_BRIDGE = Named("swarmros", "EventHeader")


def signed(event: Event, data: Any, system: System, sender: str, now: int) -> Any:
    """Return the message of a sent event with its headers filled in, as nodes on robots do.

    An empty `stamp` becomes the time in nanoseconds, an empty `name` and `node` of the bridge's
    header the topic of the event and the name of the robot.
    """
    message = system.known_interface(event.type)
    if not isinstance(message, Message) or not isinstance(data, Mapping):
        return data
    filled = dict(data)
    for field in message.fields:
        if field.type == _OF_ROS:
            given: dict[str, Any] = {"stamp": now}
        elif field.type == _OF_BRIDGE:
            given = {"name": event.topic, "node": sender}
        else:
            continue
        header = filled.get(field.name) or {}
        filled[field.name] = {**header, **{k: header.get(k) or v for k, v in given.items()}}
    return filled
