"""Models as ROS 1 can have them."""

from __future__ import annotations

from dataclasses import replace

from swarmdsl.codegen.shared import follows_members
from swarmdsl.ir import System


def for_ros_1(system: System) -> System:
    """The same with what ROS 1 has: events never expire, and nobody sends heartbeats."""
    events = (
        replace(event, delivery=replace(event.delivery, lifespan=None, deadline=None))
        if event.delivery is not None
        else event
        for event in system.events
    )
    machines = tuple(machine for machine in system.machines if not follows_members(machine))
    names = {machine.name for machine in machines}
    members = (
        replace(each, behavior=each.behavior if each.behavior in names else None)
        for each in system.members
    )
    return replace(system, events=tuple(events), machines=machines, members=tuple(members))
