"""Interfaces between a served world and ROS 2; only `graph.py` knows rclpy."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, Protocol

from swarmdsl.ir import Communication, Delivery, Named


class MissingInterfaceError(Exception):
    """An interface that is not installed."""


class Request(Protocol):
    """A goal of an action, or a request of a service, that waits for its end."""

    data: Any
    """Fields of the goal or request, as plain data."""

    def end(self, outcome: str, fields: dict[str, Any]) -> None:
        """Answer: `succeeded`, `aborted` or `preempted`, with fields of the result."""


Taker = Callable[[Request], None]
"""Called with a request that has come, or is cancelled."""


class Sender(Protocol):
    """A publisher on a topic."""

    @property
    def listeners(self) -> int:
        """Number of subscriptions, those of this process included."""

    def wire(self, data: Any) -> bytes:
        """Return a message as it is sent, from plain data."""

    def read(self, wire: bytes) -> Any:
        """Return a message as plain data."""

    def send(self, wire: bytes) -> None:
        """Publish a message."""


class Graph(Protocol):
    """The part of the ROS graph in which the world is."""

    @property
    def clocks(self) -> int:
        """Number of nodes that follow the time of the world."""

    def serve(self, name: str, call: Communication, begin: Taker, cancel: Taker) -> None:
        """Serve an action or a service."""

    def sender(self, topic: str, type_: Named, delivery: Delivery) -> Sender:
        """Return a publisher on a topic."""

    def hear(self, topic: str, type_: Named, hear: Callable[[Any], None]) -> None:
        """Call a function with each message on a topic as plain data, also with earlier ones."""

    def hear_wire(
        self, topic: str, type_: Named, delivery: Delivery, hear: Callable[[bytes], None]
    ) -> None:
        """Call a function with each message on a topic, as it comes."""

    def tell_time(self, time: int) -> None:
        """Publish the time of the world, in nanoseconds."""

    def spin(self, seconds: float) -> None:
        """Let one thing happen, or wait for so long."""
