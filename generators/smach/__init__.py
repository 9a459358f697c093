"""ROS 1 or 2: a package whose nodes run the state machines with SMACH."""

from swarmdsl.generator import Generator, chosen_machines

from .mapping import MAPPING
from .options import Options
from .render import emit
from .ros2.mapping import MAPPING as MAPPING_FOR_ROS_2

generator = Generator(
    target="smach",
    summary="ROS 1 (noetic) or 2: a package that runs the state machines with SMACH",
    emit=emit,
    options_type=Options,
    machines=chosen_machines,
    mapping=MAPPING,
    mapping_with={"ros=2": MAPPING_FOR_ROS_2},
)
