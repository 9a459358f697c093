"""Names of robots' topics and services, as the launch files of target `ros2` make them."""

from __future__ import annotations

from swarmdsl.base.naming import incoming_topic, snake_case
from swarmdsl.execution.simulate.scenario.scenario import Robot
from swarmdsl.ir import Event

RADIO = "radio"
"""Namespace in that of a robot for its swarm events, with `world:=true` of the launch file."""
_INCOMING = incoming_topic("", swarm=True)


def swarm_namespace(swarm: str) -> str:
    """Return the namespace of a swarm."""
    return f"/{snake_case(swarm) or 'swarm'}"


def namespace(swarm: str, robot: Robot) -> str:
    """Return the namespace of a robot."""
    return f"{swarm_namespace(swarm)}/{robot.role}_{robot.index}"


def name_in(space: str, name: str) -> str:
    """Return the whole name of a topic or a service; one from the root on stays as it is."""
    return name if name.startswith("/") else f"{space}/{name}"


def radio_topic(space: str, topic: str) -> str:
    """Return the topic on which a robot sends and hears an event of the swarm."""
    return f"{space}/{RADIO}/{topic.lstrip('/')}"


def topic_of_swarm(event: Event) -> str | None:
    """Return the topic of an event between robots; None for one of the robot itself."""
    if event.swarm:
        return event.topic.lstrip("/")
    if event.topic.startswith(_INCOMING):
        return event.topic.removeprefix(_INCOMING).lstrip("/")
    return None
