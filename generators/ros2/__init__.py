"""Target `ros2`: an ament_python package whose nodes run the state machines on rclpy."""

from __future__ import annotations

from swarmdsl.codegen import ALL_FEATURES, Feature, Generator, chosen_machines, emit_of

from .mapping import MAPPING
from .options import NodeOptions

generator = Generator(
    target="ros2",
    summary="ROS 2 (humble and later): a package whose nodes run the state machines on rclpy",
    emit=emit_of(f"{__name__}.render"),
    options_type=NodeOptions,
    machines=chosen_machines,
    mapping=MAPPING,
    supports=ALL_FEATURES - {Feature.NEIGHBORS},
)
