"""The world as a node of rclpy, the only module that uses it.

It is imported when a graph is made: rclpy is in no package index, but in every sourced ROS 2.
"""

from __future__ import annotations

import time
from collections import deque
from collections.abc import Callable
from importlib import import_module
from importlib.util import find_spec
from typing import Any

from swarmdsl.execution.ros2_world.messages import fill, plain
from swarmdsl.execution.ros2_world.ports import MissingInterfaceError, Taker
from swarmdsl.execution.simulate.scenario.durations import SECOND
from swarmdsl.ir import Communication, Delivery, Named

_DEPTH = 10_000
_HISTORY = 1000
_NAP = 0.1
"""Longest wait in the middleware, in seconds: a signal is only seen after it."""
_BLINK = 0.001


def is_there() -> bool:
    """Return True if this process can use rclpy."""
    return find_spec("rclpy") is not None


class RclpyGraph:
    """The node of the world."""

    def __init__(self) -> None:
        self._rclpy = rclpy = import_module("rclpy")
        # Ctrl-C is an exception in this process, as without ROS.
        none = import_module("rclpy.signals").SignalHandlerOptions.NO
        rclpy.init(args=[], signal_handler_options=none)
        self._action = import_module("rclpy.action")
        self._qos = import_module("rclpy.qos")
        self._node = rclpy.create_node("world")
        self._executor = import_module("rclpy.executors").SingleThreadedExecutor()
        self._executor.add_node(self._node)
        self._later: deque[Callable[[], None]] = deque()
        self._responses = 0
        """Requests of services that wait: for them, the executor asks again and again."""
        self._clock_type = interface(Named("rosgraph_msgs", "Clock"), "msg")
        self._clock = self._node.create_publisher(self._clock_type, "/clock", 1)

    @property
    def clocks(self) -> int:
        """Number of nodes that follow the time of the world."""
        return int(self._clock.get_subscription_count())

    def close(self) -> None:
        """Leave the graph."""
        self._executor.shutdown(timeout_sec=1)
        self._node.destroy_node()
        self._rclpy.try_shutdown()

    def serve(self, name: str, call: Communication, begin: Taker, cancel: Taker) -> None:
        """Serve an action or a service."""
        if call.paradigm == "action":
            self._serve_action(name, call.type, begin, cancel)
        else:
            self._serve_service(name, call.type, begin)

    def sender(self, topic: str, type_: Named, delivery: Delivery) -> RclpySender:
        """Return a publisher on a topic."""
        made = interface(type_, "msg")
        publisher = self._node.create_publisher(made, topic, self._quality(delivery, hears=False))
        return RclpySender(publisher, made)

    def hear(self, topic: str, type_: Named, hear: Callable[[Any], None]) -> None:
        """Call a function with each message on a topic as plain data, also with earlier ones."""
        made = interface(type_, "msg")
        durability = self._qos.DurabilityPolicy.TRANSIENT_LOCAL
        quality = self._qos.QoSProfile(depth=_HISTORY, durability=durability)
        self._node.create_subscription(made, topic, lambda each: hear(plain(each)), quality)

    def hear_wire(
        self, topic: str, type_: Named, delivery: Delivery, hear: Callable[[bytes], None]
    ) -> None:
        """Call a function with each message on a topic, as it comes."""
        made, quality = interface(type_, "msg"), self._quality(delivery, hears=True)
        self._node.create_subscription(made, topic, hear, quality, raw=True)

    def tell_time(self, time: int) -> None:
        """Publish the time of the world, in nanoseconds."""
        message = self._clock_type()
        message.clock.sec, message.clock.nanosec = divmod(time, SECOND)
        self._clock.publish(message)

    def spin(self, seconds: float) -> None:
        """Let one thing happen, or wait for so long."""
        self._executor.spin_once(timeout_sec=min(max(seconds, 0.0), _NAP))
        if self._responses:
            time.sleep(_BLINK)
        while self._later:
            self._later.popleft()()

    # ---- internal

    def _serve_action(self, name: str, type_: Named, begin: Taker, cancel: Taker) -> None:
        made = interface(type_, "action")
        goals: dict[bytes, _Goal] = {}

        def accepted(handle: Any) -> None:
            goal = _Goal(handle, made.Result)
            goals[bytes(handle.goal_id.uuid)] = goal
            self._later.append(lambda: begin(goal))

        def cancelled(handle: Any) -> Any:
            goal = goals.get(bytes(handle.goal_id.uuid))
            if goal is not None:
                # When it is answered, the state of the goal has changed.
                self._later.append(lambda: cancel(goal))
            return self._action.CancelResponse.ACCEPT

        self._action.ActionServer(
            self._node,
            made,
            name,
            execute_callback=lambda handle: made.Result(),
            handle_accepted_callback=accepted,
            cancel_callback=cancelled,
        )

    def _serve_service(self, name: str, type_: Named, begin: Taker) -> None:
        made = interface(type_, "srv")
        future_type = import_module("rclpy.task").Future

        async def respond(request: Any, response: Any) -> Any:
            future = future_type()
            self._responses += 1
            called = _Called(plain(request), response, future)
            self._later.append(lambda: begin(called))
            try:
                return await future
            finally:
                self._responses -= 1

        self._node.create_service(made, name, respond)

    def _quality(self, delivery: Delivery, *, hears: bool) -> Any:
        """Return the quality of service with which generated nodes send or hear an event."""
        qos = self._qos
        best = delivery.reliable is False
        latest = delivery.latest and not hears
        return qos.QoSProfile(
            depth=(delivery.keep or 1) if latest else _DEPTH,
            reliability=qos.ReliabilityPolicy.BEST_EFFORT
            if best
            else qos.ReliabilityPolicy.RELIABLE,
            durability=qos.DurabilityPolicy.TRANSIENT_LOCAL
            if latest
            else qos.DurabilityPolicy.VOLATILE,
        )


class _Goal:
    """A goal of an action, which is not executed before its end is known."""

    def __init__(self, handle: Any, result: Callable[[], Any]) -> None:
        self.data = plain(handle.request)
        self._handle = handle
        self._result = result
        self._has_ended = False

    def end(self, outcome: str, fields: dict[str, Any]) -> None:
        if self._has_ended:
            return
        self._has_ended = True

        def execute(handle: Any) -> Any:
            if handle.is_cancel_requested:
                handle.canceled()
            elif outcome == "succeeded":
                handle.succeed()
            else:
                handle.abort()
            return fill(self._result(), fields, _empty)

        self._handle.execute(execute)


class _Called:
    """A request of a service."""

    def __init__(self, data: Any, response: Any, future: Any) -> None:
        self.data = data
        self._response = response
        self._future = future

    def end(self, outcome: str, fields: dict[str, Any]) -> None:
        if self._future.done():
            return
        response = fill(self._response, fields, _empty)
        if "success" in response.get_fields_and_field_types():
            response.success = outcome == "succeeded" and fields.get("success", True)
        self._future.set_result(response)


class RclpySender:
    """A publisher."""

    def __init__(self, publisher: Any, made: Callable[[], Any]) -> None:
        self._publisher = publisher
        self._made = made
        self._serialization = import_module("rclpy.serialization")

    @property
    def listeners(self) -> int:
        """Number of subscriptions, those of this process included."""
        return int(self._publisher.get_subscription_count())

    def wire(self, data: Any) -> bytes:
        """Return a message as it is sent, from plain data."""
        return bytes(self._serialization.serialize_message(fill(self._made(), data, _empty)))

    def read(self, wire: bytes) -> Any:
        """Return a message as plain data."""
        return plain(self._serialization.deserialize_message(wire, self._made))

    def send(self, wire: bytes) -> None:
        """Publish a message."""
        self._publisher.publish(wire)


def interface(type_: Named, kind: str) -> Any:
    """Return the class of an interface."""
    try:
        return getattr(import_module(f"{type_.package}.{kind}"), type_.name)
    except (ImportError, AttributeError):
        name = f"{type_.package}/{kind}/{type_.name}"
        raise MissingInterfaceError(name) from None


def _empty(type_: str) -> Any:
    package, _, name = type_.rpartition("/")
    return interface(Named(package, name), "msg")()
