"""Mapping of each construct of a model, for `swarmc targets skeleton`.

Text between backticks occurs in the generated files for ROS 1 and Python.
"""

from __future__ import annotations

from swarmdsl.codegen import Mapped, Support

_EXACT, _REJECTED = Support.EXACT, Support.REJECTED

MAPPING = tuple(
    Mapped(*each)
    for each in (
        ("function with an action", _EXACT, "node with an `actionlib.SimpleActionServer(`"),
        ("function with a service", _EXACT, "node with a `rospy.Service(`"),
        ("component", _EXACT, "node, with a class to complete: `class Stereo(StereoBase)`"),
        ("operation of a component", _EXACT, "service in the namespace of the node: `'~forget'`"),
        ("port that hears", _EXACT, "`rospy.Subscriber(`, and a method `def on_left(`"),
        ("port that sends", _EXACT, "`rospy.Publisher(`"),
        ("param", _EXACT, "ROS parameter, checked at the start: `self.rate = _parameter(`"),
        ("part of a member", _EXACT, 'node of a launch file: `name="right"`'),
        ("param of a part", _EXACT, "ROS parameter of that node: `rate: 4.0`"),
        ("connector", _EXACT, 'remapping of a topic: `<remap from="image" to="right/image"/>`'),
        ("connectors that would part one topic", _REJECTED, "a topic has only one name (SW0903)"),
    )
)
