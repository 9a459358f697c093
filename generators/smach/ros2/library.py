"""Properties of SMACH as a library on ROS 2."""

from __future__ import annotations

from ...ros2.view import Variant
from ...ros2_outcomes.library import Library
from ..module import PREEMPTED, TARGET

SMACH = Library(
    target=TARGET,
    name="SMACH",
    stopped=PREEMPTED,
    variant=Variant(
        host="runner",
        suffix="_smach",
        depends=(("depend", "smach"), ("depend", "smach_ros")),
    ),
    packages=("smach", "smach_msgs", "smach_ros"),
)
