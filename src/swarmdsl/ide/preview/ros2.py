"""Live states of robots, received from nodes of target `ros2`."""

from __future__ import annotations

import json
import os
import re
import sys
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from importlib import import_module
from threading import Event, Thread
from typing import Any, NamedTuple, Protocol

from swarmdsl.base.diagnostics.collector import Diagnostics
from swarmdsl.execution.simulate.world.trace_line import NAMES
from swarmdsl.ide.preview.live_trace import TraceReader
from swarmdsl.ide.preview.serving import Snapshot

PREFIX = "ros2:"
"""Prefix of a node or namespace on the command line; alone, it selects all nodes."""
_NAME = re.compile(r"/?(?:[A-Za-z_]\w*(?:/[A-Za-z_]\w*)*/?)?", re.ASCII)
_TYPE = "std_msgs/msg/String"
POLL_INTERVAL = 0.5
"""Seconds between two polls of the ROS graph."""
_GRACE = 5.0
"""Seconds that callbacks and ROS may take to end."""


class UnavailableError(Exception):
    """ROS 2 is not available, or a name is invalid; the message names the reason."""

    def __init__(self, reason: str, hint: str) -> None:
        super().__init__(reason)
        self.hint = hint


@contextmanager
def listening(
    names: Sequence[str], snapshot: Snapshot, tell: Callable[[Diagnostics], None]
) -> Iterator[None]:
    """Publish the states of nodes while the context lasts, including later nodes.

    A name selects a node or a namespace. Raises UnavailableError.
    """
    if not names:
        yield
        return

    def listen(ros: Ros, node: Any) -> Callable[[], None]:
        def begun(owner: str) -> NodeTrace:
            # There may be other nodes, now or later.
            return _NodeTrace(TraceReader(owner, True, snapshot, tell))

        return NodeListener(ros, node, names, begun).poll

    with spinning("preview", names, listen):
        yield


class Ros(NamedTuple):
    """Modules of ROS 2 that a listener needs."""

    qos: Any
    string: Any


Listen = Callable[[Ros, Any], Callable[[], None]]
"""Begins to listen with a node; returns what looks at the graph from time to time."""


@contextmanager
def spinning(purpose: str, names: Sequence[str], listen: Listen) -> Iterator[None]:
    """Run a node of our own while the context lasts; its name has the purpose.

    The names are those that it follows. Raises UnavailableError.
    """
    for name in names:
        if _NAME.fullmatch(name) is None:
            raise UnavailableError(
                f"`{name}` is not a valid ROS name",
                "name a node or a namespace, e.g. `ros2:/sar/uav_0`",
            )
    try:
        rclpy = import_module("rclpy")
        make_executor = import_module("rclpy.executors").SingleThreadedExecutor
        string = import_module("std_msgs.msg").String
    except ImportError as error:
        raise UnavailableError(
            f"{sys.executable} has no {error.name or 'rclpy'}: {error}",
            "source the setup file of ROS 2 (`. /opt/ros/DISTRO/setup.sh`) and run a swarmc "
            "that is installed for its Python",
        ) from error

    def run(begun: Callable[[], None]) -> None:
        context = rclpy.Context()
        try:
            rclpy.init(context=context)
            node = rclpy.create_node(
                f"swarmc_{purpose}_{os.getpid()}",
                context=context,
                enable_rosout=False,
                start_parameter_services=False,
            )
            executor = make_executor(context=context)
            executor.add_node(node)
            node.create_timer(POLL_INTERVAL, listen(Ros(rclpy.qos, string), node))
        except Exception:
            context.try_shutdown()
            raise
        begun()
        try:
            while not stop.is_set():
                executor.spin_once()  # the timer ends it
        finally:
            executor.shutdown()
            node.destroy_node()
            context.try_shutdown()

    stop = Event()
    with _in_thread(run, stop):
        yield


@contextmanager
def _in_thread(listen: Callable[[Callable[[], None]], None], stop: Event) -> Iterator[None]:
    """Run a function that calls its argument when it has begun, and returns after `stop`.

    All calls of ROS are in this thread, because they may hang and then hear of no signal. It ends
    with the process if it does not end in time. Raises UnavailableError if it does not begin.
    """
    begun = Event()
    failures: list[Exception] = []

    def run() -> None:
        try:
            listen(begun.set)
        except Exception as error:
            if begun.is_set():
                raise
            failures.append(error)
            begun.set()

    thread = Thread(target=run, daemon=True)
    thread.start()
    try:
        begun.wait()
        if failures:
            raise UnavailableError(
                f"{failures[0]}".partition("\n")[0], "run `ros2 doctor` for details"
            ) from failures[0]
        yield
    finally:
        stop.set()
        if begun.is_set():
            thread.join(_GRACE)


class NodeTrace(Protocol):
    """Receiver of the messages of a node, until it ends."""

    def on_transition(self, message: Any) -> None:
        """Handle `~/transitions`: a line of the trace."""

    def on_state(self, message: Any) -> None:
        """Handle `~/state`, the latched state for late subscribers."""

    def on_end(self) -> None:
        """Handle the end of the node."""


class NodeListener:
    """Subscribes to nodes that have a name or are in its namespace.

    `begun` returns what is done with their messages, by the name of the node; with its `history`,
    this also gets those that the node has kept.
    """

    def __init__(
        self,
        ros: Ros,
        node: Any,
        names: Sequence[str],
        begun: Callable[[str], NodeTrace],
        *,
        history: bool = False,
    ) -> None:
        self._node = node
        self._names = [f"/{name.strip('/')}".rstrip("/") for name in names]
        self._begun = begun
        self._string = ros.string
        latched = ros.qos.DurabilityPolicy.TRANSIENT_LOCAL
        kept = {"durability": latched} if history else {}
        self._all = ros.qos.QoSProfile(depth=1000, **kept)
        self._last = ros.qos.QoSProfile(depth=1, durability=latched)
        self._traces: dict[str, tuple[NodeTrace, list[Any]]] = {}
        self._publishers: dict[str, set[tuple[int, ...]]] = {}
        """Endpoint ids of the publishers of each node."""

    def poll(self) -> None:
        """Subscribe to new nodes, and drop those that ended."""
        known = dict(self._node.get_topic_names_and_types())
        publishing = {
            owner: publishers
            for topic, types in known.items()
            for owner, _, last in [topic.rpartition("/")]
            if last == "transitions" and _TYPE in types and _TYPE in known.get(f"{owner}/state", ())
            if any(owner == name or owner.startswith(f"{name}/") for name in self._names)
            # A topic with subscribers exists even without publishers.
            if (publishers := self._publishers_of(topic))
        }
        for owner, before in self._publishers.items():
            # A killed node stays in the graph for a while, also beside its successor.
            if (now := publishing.get(owner)) and now <= before:
                continue
            robot, subscriptions = self._traces.pop(owner)
            for each in subscriptions:
                self._node.destroy_subscription(each)
            robot.on_end()
        for owner in sorted(publishing.keys() - self._traces.keys()):
            robot = self._begun(owner)
            listen = self._node.create_subscription
            self._traces[owner] = (
                robot,
                [
                    listen(self._string, f"{owner}/transitions", robot.on_transition, self._all),
                    listen(self._string, f"{owner}/state", robot.on_state, self._last),
                ],
            )
        self._publishers = publishing

    def _publishers_of(self, topic: str) -> set[tuple[int, ...]]:
        found = self._node.get_publishers_info_by_topic(topic)
        return {tuple(each.endpoint_gid) for each in found}


class _NodeTrace:
    """Trace of one node."""

    def __init__(self, reader: TraceReader) -> None:
        self._reader = reader
        self._has_moved = False

    def on_transition(self, message: Any) -> None:
        """Handle `~/transitions`: a line of the trace."""
        self._has_moved = True
        self._reader.read([message.data])

    def on_state(self, message: Any) -> None:
        """Handle `~/state`, the latched state for late subscribers."""
        if not self._has_moved:
            self._reader.read([_as_line(message.data)])

    def on_end(self) -> None:
        """Handle the end of the node."""
        self._reader.forget()


def _as_line(state: str) -> str:
    """Convert a state message to a trace line; return invalid input unchanged."""
    try:
        value = json.loads(state)
        state_of = {key: value[key] for key in ("member", "configuration")}
    except (ValueError, RecursionError, LookupError, TypeError):
        return state
    return json.dumps({"t": 0, "event": None, **{name: [] for name in NAMES}, **state_of})
