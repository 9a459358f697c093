"""Models as ROS 1 can have them."""

from __future__ import annotations

from dataclasses import replace

from swarmdsl.ir import System


def for_ros_1(system: System) -> System:
    """The same with events that never expire: topics of ROS 1 have no lifespan and no deadline."""
    events = (
        replace(event, delivery=replace(event.delivery, lifespan=None, deadline=None))
        if event.delivery is not None
        else event
        for event in system.events
    )
    return replace(system, events=tuple(events))
