"""Where robots are, as the nodes of target `ros2` say while they run."""

from __future__ import annotations

import json
import os
import re
import sys
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from importlib import import_module
from threading import Thread
from typing import Any

from swarmdsl.base.diagnostics.collector import Diagnostics
from swarmdsl.execution.simulate.trace_line import NAMES
from swarmdsl.ide.preview.live_trace import Follower
from swarmdsl.ide.preview.serving import News

PREFIX = "ros2:"
"""What a node or a namespace is named with, beside files; alone, it stands for all nodes."""
_NAME = re.compile(r"/?(?:[A-Za-z_]\w*(?:/[A-Za-z_]\w*)*/?)?", re.ASCII)
_TYPE = "std_msgs/msg/String"
_LOOK = 0.5
"""Seconds between two looks at which nodes there are."""


class UnavailableError(Exception):
    """ROS 2 cannot be used, or not with this name; says why."""

    def __init__(self, reason: str, way_out: str) -> None:
        super().__init__(reason)
        self.way_out = way_out


@contextmanager
def listening(
    names: Sequence[str], news: News, tell: Callable[[Diagnostics], None]
) -> Iterator[None]:
    """Tell pages what nodes say while the context lasts, also those that start later.

    A name is that of a node or of a namespace. Raises UnavailableError.
    """
    if not names:
        yield
        return
    for name in names:
        if _NAME.fullmatch(name) is None:
            raise UnavailableError(
                f"`{name}` is no name in ROS", "name a node or a namespace, as `ros2:/sar/uav_0`"
            )
    try:
        rclpy = import_module("rclpy")
        make_executor = import_module("rclpy.executors").SingleThreadedExecutor
        string = import_module("std_msgs.msg").String
    except ImportError as error:
        raise UnavailableError(
            f"{sys.executable} has no {error.name or 'rclpy'}: {error}",
            "source the setup file of ROS 2, as `. /opt/ros/DISTRO/setup.sh`, and run a swarmc "
            "that is installed for its Python",
        ) from error
    context = rclpy.Context()
    try:
        rclpy.init(context=context)
        node = rclpy.create_node(
            f"swarmc_preview_{os.getpid()}",
            context=context,
            enable_rosout=False,
            start_parameter_services=False,
        )
    except Exception as error:
        context.try_shutdown()
        raise UnavailableError(f"{error}".partition("\n")[0], "`ros2 doctor` says more") from error
    executor = make_executor(context=context)
    executor.add_node(node)
    ears = _Ears(rclpy.qos, string, node, names, news, tell)
    node.create_timer(_LOOK, ears.look)
    thread = Thread(target=executor.spin, daemon=True)
    thread.start()
    try:
        yield
    finally:
        executor.shutdown()
        thread.join()
        node.destroy_node()
        context.try_shutdown()


class _Ears:
    """Hears those nodes that have a name, or are in a namespace of it."""

    def __init__(
        self,
        qos: Any,
        string: Any,
        node: Any,
        names: Sequence[str],
        news: News,
        tell: Callable[[Diagnostics], None],
    ) -> None:
        self._node = node
        self._names = [f"/{name.strip('/')}".rstrip("/") for name in names]
        self._news = news
        self._tell = tell
        self._string = string
        self._all = qos.QoSProfile(depth=1000)
        self._last = qos.QoSProfile(depth=1, durability=qos.DurabilityPolicy.TRANSIENT_LOCAL)
        self._heard: dict[str, tuple[_Robot, list[Any]]] = {}
        self._publishers: dict[str, set[tuple[int, ...]]] = {}
        """Those of what is heard, by their ids in the middleware."""

    def look(self) -> None:
        """Listen to nodes that have come, and forget those that are gone."""
        known = dict(self._node.get_topic_names_and_types())
        speaking = {
            owner: publishers
            for topic, types in known.items()
            for owner, _, last in [topic.rpartition("/")]
            if last == "transitions" and _TYPE in types and _TYPE in known.get(f"{owner}/state", ())
            if any(owner == name or owner.startswith(f"{name}/") for name in self._names)
            # A topic that is listened to is there without anybody who speaks.
            if (publishers := self._publishers_of(topic))
        }
        for owner, before in self._publishers.items():
            # A node that is killed stays in the graph for a while, also beside the next one.
            if (now := speaking.get(owner)) and now <= before:
                continue
            robot, subscriptions = self._heard.pop(owner)
            for each in subscriptions:
                self._node.destroy_subscription(each)
            robot.gone()
        for owner in sorted(speaking.keys() - self._heard.keys()):
            # There may be others, now or later.
            robot = _Robot(Follower(owner, True, self._news, self._tell))
            listen = self._node.create_subscription
            self._heard[owner] = (
                robot,
                [
                    listen(self._string, f"{owner}/transitions", robot.moved, self._all),
                    listen(self._string, f"{owner}/state", robot.placed, self._last),
                ],
            )
        self._publishers = speaking

    def _publishers_of(self, topic: str) -> set[tuple[int, ...]]:
        found = self._node.get_publishers_info_by_topic(topic)
        return {tuple(each.endpoint_gid) for each in found}


class _Robot:
    """What one node says."""

    def __init__(self, follower: Follower) -> None:
        self._follower = follower
        self._has_moved = False

    def moved(self, message: Any) -> None:
        """On `~/transitions`: a line of its trace."""
        self._has_moved = True
        self._follower.hear([message.data])

    def placed(self, message: Any) -> None:
        """On `~/state`, which tells those who come late where it is already."""
        if not self._has_moved:
            self._follower.hear([_as_line(message.data)])

    def gone(self) -> None:
        """It has ended."""
        self._follower.forget()


def _as_line(state: str) -> str:
    """A line of a trace in which nothing is said but where a node is; any other text as it is."""
    try:
        said = json.loads(state)
        where = {key: said[key] for key in ("member", "configuration")}
    except (ValueError, RecursionError, LookupError, TypeError):
        return state
    return json.dumps({"t": 0, "event": None, **{name: [] for name in NAMES}, **where})
