"""ROS 2 with YASMIN: an ament_python package whose nodes run the state machines as its own."""

from swarmdsl.generator import Generator, chosen_machines

from ..ros2.options import Options
from .mapping import MAPPING
from .render import emit

generator = Generator(
    target="yasmin",
    summary="ROS 2 with YASMIN 4.0 or later: a package that runs the state machines with it",
    emit=emit,
    options_type=Options,
    machines=chosen_machines,
    mapping=MAPPING,
)
