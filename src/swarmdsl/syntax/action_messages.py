"""Messages that ROS 1 (actionlib) generates from an action, by their names.

From `uav_msgs/Climb` come `ClimbFeedback` and `ClimbActionFeedback`, the same with a header, which
is sent on the topic `<action>/feedback`; likewise for its goal and its result.
"""

from __future__ import annotations

import re
from collections.abc import Iterator

from swarmdsl.base.records import dataclass
from swarmdsl.syntax.types import Named

_PARTS = ("Goal", "Result", "Feedback")
_GENERATED = rf"(.+?)({'|'.join(_PARTS)})"
_WRAPPED = "Action"
_HEADER = ("header", Named("std_msgs", "Header"))
_STATUS = ("status", Named("actionlib_msgs", "GoalStatus"))
_GOAL_ID = ("goal_id", Named("actionlib_msgs", "GoalID"))


@dataclass(frozen=True)
class GeneratedMessage:
    """A message generated from part `goal`, `result` or `feedback` of an action.

    It has the fields of that part, or, if given, `fields`: a header and the part as a message.
    """

    action: Named
    part: str
    fields: tuple[tuple[str, Named], ...] = ()


def generated_names(action: str) -> tuple[str, ...]:
    """Return the names of all messages that are generated from an action of that name."""
    return tuple(f"{action}{word}{part}" for word in ("", _WRAPPED) for part in _PARTS)


def generated_from(type_: Named) -> Iterator[GeneratedMessage]:
    """Yield each reading of a message's name as generated from an action, existing or not."""
    found = re.fullmatch(_GENERATED, type_.name)
    if found is None:
        return
    base, part = found.groups()
    action = base.removesuffix(_WRAPPED)
    if action and action != base:
        besides = _GOAL_ID if part == "Goal" else _STATUS
        inside = (part.lower(), Named(type_.package, f"{action}{part}"))
        fields = (_HEADER, besides, inside)
        yield GeneratedMessage(Named(type_.package, action), part.lower(), fields)
    yield GeneratedMessage(Named(type_.package, base), part.lower())
