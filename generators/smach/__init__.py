"""Target `smach`: a package for ROS 1 or 2 whose nodes run the state machines with SMACH."""

from __future__ import annotations

from swarmdsl.codegen import ALL_FEATURES, Feature, Generator, chosen_machines, emit_of

from .mapping import MAPPING
from .options import Options
from .ros2.mapping import MAPPING as MAPPING_FOR_ROS_2

generator = Generator(
    target="smach",
    summary="ROS 1 (noetic) or 2: a package that runs the state machines with SMACH",
    emit=emit_of(f"{__name__}.render"),
    options_type=Options,
    machines=chosen_machines,
    mapping=MAPPING,
    supports=ALL_FEATURES - {Feature.NEIGHBORS},
    mapping_with={"ros=2": MAPPING_FOR_ROS_2},
)
