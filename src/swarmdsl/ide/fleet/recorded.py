"""Fleet in a recording of ROS 2: a bag in MCAP or SQLite."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import ExitStack, contextmanager
from pathlib import Path
from typing import Any

from swarmdsl.base.read_files import is_file, is_folder
from swarmdsl.execution.simulate.scenario.scenario import Robot
from swarmdsl.ide.fleet.sensed import BATTERY, TYPES, moved_line, place_of, share_of
from swarmdsl.ide.fleet.told_lines import LINES, TOPICS, member_in, model_in, time_of
from swarmdsl.ide.fleet.watch import Watch

_SECOND = 1_000_000_000
_MILLISECOND = 1_000_000
_STRING = "std_msgs/msg/String"
SUFFIXES = (".mcap", ".db3")
_NEEDED = "`pip install 'swarmdsl[bags]'`"


class UnreadableBagError(Exception):
    """A bag cannot be read; the message names the reason."""

    def __init__(self, reason: str, hint: str) -> None:
        super().__init__(reason)
        self.hint = hint


def is_bag(name: str) -> bool:
    """Return True for a bag, or for the folder of one."""
    path = Path(name)
    return path.suffix in SUFFIXES or is_file(path / "metadata.yaml")


class BagClock:
    """Time of the last message of a bag, in seconds: heartbeats are late by it."""

    def __init__(self) -> None:
        self.now = 0.0

    def __call__(self) -> float:
        """Return the time."""
        return self.now


def read_bag(name: str, watch: Watch, clock: BagClock) -> None:
    """Add all messages of a bag to a watch. Raises UnreadableBagError."""
    lines: list[str] = []
    robots: dict[str, str] = {}
    """Robots by their namespaces."""
    moved: dict[str, int] = {}
    """Time of the last place of each robot that is shown: one a second."""
    with _opened(Path(name)) as reader:
        for topic, type_, time, message in _messages(Path(name), reader):
            clock.now = time / _SECOND
            space, _, last = topic.rpartition("/")
            robot = next((name for at, name in robots.items() if f"{space}/".startswith(at)), "")
            if last in LINES and type_ == _STRING:
                lines.append(message.data)
                if member := member_in(message.data):
                    _note_robot(member, space, robots)
            elif type_ == _STRING:
                _note(watch, last, message.data)
            elif robot and type_ == BATTERY:
                with watch.noting() as standing:
                    standing.charge(robot, share_of(message))
            elif not robot or time - moved.get(robot, 0) < _SECOND:
                continue
            elif (place := place_of(message)) is not None:
                moved[robot] = time
                lines.append(moved_line({robot: place}, time // _MILLISECOND))
    watch.read(sorted(lines, key=time_of))


def _is_wanted(topic: str, type_: str) -> bool:
    last = topic.rpartition("/")[2]
    return type_ in TYPES or (type_ == _STRING and last in (*LINES, *TOPICS))


def _note_robot(member: str, space: str, robots: dict[str, str]) -> None:
    robot = Robot.called(member)
    name = f"{robot.role}_{robot.index}"
    around, found, _ = f"{space}/".partition(f"/{name}/")
    if robot.role and found:
        robots[f"{around}/{name}/"] = robot.name or member


def _note(watch: Watch, last: str, text: str) -> None:
    with watch.noting() as standing:
        if last == "members":
            standing.beat(text)
        elif (told := model_in(text)) is not None:
            standing.tell_model(*told)


def _messages(path: Path, reader: Any) -> Iterator[tuple[str, str, int, Any]]:
    """Yield the topic, the type, the time and the content of each message that is wanted."""
    with _told(path):
        wanted = [each for each in reader.connections if _is_wanted(each.topic, each.msgtype)]
        for connection, time, data in reader.messages(wanted):
            message = reader.deserialize(data, connection.msgtype)
            yield connection.topic, connection.msgtype, time, message


@contextmanager
def _opened(path: Path) -> Iterator[Any]:
    try:
        from rosbags.highlevel import AnyReader
        from rosbags.typesys import Stores, get_typestore
    except ImportError as error:
        raise UnreadableBagError(
            f"bags need the Python package rosbags: {error}", _NEEDED
        ) from None
    folder = path if is_folder(path) else path.parent
    with ExitStack() as stack:
        with _told(path):
            types = get_typestore(Stores.ROS2_JAZZY)
            reader = stack.enter_context(AnyReader([folder], default_typestore=types))
        yield reader


@contextmanager
def _told(path: Path) -> Iterator[None]:
    """Raise UnreadableBagError for what is wrong with a bag."""
    try:
        yield
    except Exception as error:  # each decoder fails in its own way at damaged bytes
        hint = "name the folder that `ros2 bag record` has written, with its metadata.yaml"
        reason = str(error) or type(error).__name__
        raise UnreadableBagError(f"{path}: {reason}", hint) from None
