"""ROS 2: an ament_python package whose nodes run the state machines on rclpy."""

from swarmdsl.generator import Generator, chosen_machines

from .mapping import MAPPING
from .options import Options
from .render import emit

generator = Generator(
    target="ros2",
    summary="ROS 2 (humble and later): a package whose nodes run the state machines on rclpy",
    emit=emit,
    options_type=Options,
    machines=chosen_machines,
    mapping=MAPPING,
)
