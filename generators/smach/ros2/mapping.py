"""Mapping of each construct of a model to SMACH on ROS 2, for `swarmc targets smach`."""

from __future__ import annotations

from swarmdsl.codegen import Mapped, Support

from ...ros2_outcomes.mapping import mapping

_KEYS = "not a valid key: `keys`, `_n` (SW0905)"

MAPPING = mapping(
    "set_initial_state(['Deep'])",
    "userdata",
    own=[Mapped("name that userdata cannot have", Support.REJECTED, _KEYS)],
)
