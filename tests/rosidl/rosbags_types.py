"""The standard messages of `rosbags` in the format of the data file."""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator
from typing import NamedTuple

from rosbags.interfaces import Nodetype
from rosbags.typesys import Stores, get_typestore

ROS_1 = (Stores.ROS1_NOETIC,)
ROS_2 = (Stores.ROS2_HUMBLE, Stores.ROS2_JAZZY, Stores.ROS2_KILTED, Stores.ROS2_LYRICAL)
PACKAGES = {
    "action_msgs",
    "actionlib_msgs",
    "builtin_interfaces",
    "diagnostic_msgs",
    "geometry_msgs",
    "nav_msgs",
    "rcl_interfaces",
    "rosgraph_msgs",
    "sensor_msgs",
    "shape_msgs",
    "std_msgs",
    "stereo_msgs",
    "tf2_msgs",
    "trajectory_msgs",
    "unique_identifier_msgs",
    "visualization_msgs",
}
# rosbags describes the times of ROS 1 by messages that ROS 1 does not have,
NOT_IN_ROS_1 = {"builtin_interfaces"}
# and leaves this package out, which ROS 1 has with the same messages (ros/geometry2).
ALSO_IN_ROS_1 = {"tf2_msgs"}
# ROS 1 generates messages from actions.
OF_ACTIONS = (
    "Action",
    "ActionFeedback",
    "ActionGoal",
    "ActionResult",
    "Feedback",
    "Goal",
    "Result",
)
# ROS 2 adds it to messages without fields, for languages without empty structs.
PLACEHOLDER = "structure_needs_at_least_one_member"
TIMES = {"builtin_interfaces/msg/Time": "time", "builtin_interfaces/msg/Duration": "duration"}


class Item(NamedTuple):
    """A field, or a constant with its value."""

    type: str
    name: str
    value: object = None

    def __str__(self) -> str:
        return f"{self.type} {self.name}" + ("" if self.value is None else f"={self.value}")


Messages = dict[tuple[str, str], list[Item]]


def written(description: tuple, package: str) -> str:
    """Return a type of a field in the syntax of .msg files."""
    kind, inner = description
    match kind:
        case Nodetype.BASE:
            name, bound = inner
            return f"{name}<={bound}" if bound else name
        case Nodetype.NAME:
            home, _, name = inner.split("/")
            return TIMES.get(inner) or (name if home == package else f"{home}/{name}")
    element, size = inner
    bound = "<=" if size and kind is Nodetype.SEQUENCE else ""
    return f"{written(element, package)}[{bound}{size or ''}]"


def messages(store: Stores) -> Messages:
    """Return the messages of a release by package and name."""
    defined = get_typestore(store).fielddefs
    actions = {name.removesuffix("Action") for name in defined if name.endswith("Action")}
    all_of = [{action + suffix for suffix in OF_ACTIONS} for action in actions]
    generated = set().union(*(names for names in all_of if names <= defined.keys()))
    found = {}
    for full, (constants, fields) in defined.items():
        package, _, name = full.split("/")
        if package in PACKAGES and full not in generated:
            found[package, name] = [
                *(Item(type_, constant, value) for constant, type_, value in constants),
                *(Item(written(type_, package), f) for f, type_ in fields if f != PLACEHOLDER),
            ]
    return found


def both(first: list[Item], second: list[Item]) -> list[Item]:
    """Merge two lists of items; an added item keeps its position in the second."""
    items = list(first)
    after = -1
    for item in second:
        known = next((i for i, other in enumerate(items) if other.name == item.name), None)
        if known is None:
            items.insert(after + 1, item)
            known = after + 1
        else:
            items[known] = wider(items[known], item)
        after = known
    return items


def wider(first: Item, second: Item) -> Item:
    """Return the type that covers an item with different types."""
    assert first.value == second.value, (first, second)
    if first.type == second.type or first.value is not None:
        return second  # the same number, in the type that the later release gives it
    without_bounds = [
        item._replace(type=re.sub(r"\[<=\d+\]", "[]", item.type)) for item in (first, second)
    ]
    assert without_bounds[0] == without_bounds[1], (first, second)
    return without_bounds[0]


def union(stores: Iterable[Stores]) -> Messages:
    found: Messages = {}
    for store in stores:
        for key, items in messages(store).items():
            found[key] = both(found[key], items) if key in found else items
    return found


def text() -> str:
    """The data file."""
    return "\n".join(sections())


def sections() -> Iterator[str]:
    releases = ", ".join(store.value.split("_")[1] for store in ROS_2)
    yield f"The messages of ROS 1 noetic and of ROS 2 {releases}, made from those in rosbags.\n"
    one, two = union(ROS_1), union(ROS_2)
    for key in [key for key in one if key[0] in NOT_IN_ROS_1]:
        del one[key]
    one |= {key: items for key, items in two.items() if key[0] in ALSO_IN_ROS_1}
    for key in sorted(one.keys() | two.keys()):
        lines = [f"== {key[0]}/msg/{key[1]}"]
        if key not in one or key not in two:
            lines.append(f"# only in ROS {1 if key in one else 2}")
            lines += map(str, one.get(key) or two.get(key, []))
        else:
            names = [{item.name for item in of[key]} for of in (one, two)]
            for item in both(one[key], two[key]):
                lacking = [item.name not in those for those in names]
                mark = f"  # only in ROS {2 if lacking[0] else 1}" if any(lacking) else ""
                lines.append(f"{item}{mark}")
        yield "\n".join(lines) + "\n"
