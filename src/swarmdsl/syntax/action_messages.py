"""The messages that ROS makes of an action, by the names that they have in ROS 1 (actionlib).

Of `uav_msgs/Climb` there is `ClimbFeedback`, and `ClimbActionFeedback`, which is that with a
header, on the topic `<action>/feedback`; so it is with its goal and its result.
"""

from __future__ import annotations

import re
from collections.abc import Iterator

from swarmdsl.base.records import dataclass
from swarmdsl.syntax.types import Named

_PARTS = ("Goal", "Result", "Feedback")
_MADE = rf"(.+?)({'|'.join(_PARTS)})"
_WRAPPED = "Action"
_HEADER = ("header", Named("std_msgs", "Header"))
_STATUS = ("status", Named("actionlib_msgs", "GoalStatus"))
_GOAL_ID = ("goal_id", Named("actionlib_msgs", "GoalID"))


@dataclass(frozen=True)
class Made:
    """A message that is made of part `goal`, `result` or `feedback` of an action.

    It has the fields of that, or `fields`: one is the part, as a message of its own.
    """

    action: Named
    part: str
    fields: tuple[tuple[str, Named], ...] = ()


def names_made(action: str) -> tuple[str, ...]:
    """The names of all messages that are made of an action of that name."""
    return tuple(f"{action}{word}{part}" for word in ("", _WRAPPED) for part in _PARTS)


def ways_made(type_: Named) -> Iterator[Made]:
    """Of which actions a message of that name may be made, if there are such."""
    found = re.fullmatch(_MADE, type_.name)
    if found is None:
        return
    base, part = found.groups()
    action = base.removesuffix(_WRAPPED)
    if action and action != base:
        besides = _GOAL_ID if part == "Goal" else _STATUS
        inside = (part.lower(), Named(type_.package, f"{action}{part}"))
        yield Made(Named(type_.package, action), part.lower(), (_HEADER, besides, inside))
    yield Made(Named(type_.package, base), part.lower())
