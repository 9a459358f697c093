"""Headers of sent events: robots fill in their name and the time."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from swarmdsl.ir import Event, Message, Named, System

_OF_ROS = Named("std_msgs", "Header")
_OF_BRIDGE = Named("swarmros", "EventHeader")


def signed(event: Event, data: Any, system: System, sender: str, now: int) -> Any:
    """Return the message of a sent event with its headers filled in, as nodes on robots do.

    An empty `stamp` becomes the time in nanoseconds, an empty `name` of the bridge's header the
    topic of the event. Its `node` is the robot that sends a swarm event, also where the message is
    that of another one.
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
        header = dict(filled.get(field.name) or {})
        if event.swarm and sender and "node" in given:
            header["node"] = sender
        filled[field.name] = {**header, **{k: header.get(k) or v for k, v in given.items()}}
    return filled
