"""ROS 1: a catkin package whose nodes run the state machines with SMACH."""

from swarmdsl.generator import Generator, chosen_machines

from .mapping import MAPPING
from .options import Options
from .render import emit

generator = Generator(
    target="smach",
    summary="ROS 1 (noetic): a catkin package that runs the state machines with SMACH",
    emit=emit,
    options_type=Options,
    machines=chosen_machines,
    mapping=MAPPING,
)
