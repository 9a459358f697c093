"""Messages that a robot may get from others, whatever these do."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence

from swarmdsl import ir
from swarmdsl.execution.engine import Envelope, Event
from swarmdsl.execution.simulate.network.members import DEPARTED
from swarmdsl.execution.simulate.scenario.scenario import Robot
from swarmdsl.execution.verify.abstraction.demands import Demands
from swarmdsl.execution.verify.abstraction.doubt import Doubt
from swarmdsl.execution.verify.robot.environment import Environment
from swarmdsl.execution.verify.robot.robot_kind import Kind


def messages_to(
    kind: Kind,
    senders: Sequence[Robot],
    sends: Iterable[ir.Send],
    demands: Demands,
    environment: Environment,
    doubts: list[Doubt],
) -> Iterator[Event]:
    """Yield what can arrive at a robot: of each event that others send, all values.

    They are of each sender if that counts. What the values leave out is a doubt.
    """
    robots = list(dict.fromkeys(senders))
    names = [robot.name or "" for robot in robots]
    for event in dict.fromkeys(send.event for send in sends):
        if kind.listens(event) and demands.is_for_swarm(event):
            for data in environment.noted(demands.messages(event), doubts):
                for name in names if demands.reads_sender(event) else names[:1]:
                    yield Event(event, data, envelope=Envelope(name, 0, None))
    if kind.has_heartbeat and kind.listens(DEPARTED):
        for robot in filter(environment.can_be_lost, robots):
            yield Event(DEPARTED, {"id": robot.name or "", "role": robot.role})
