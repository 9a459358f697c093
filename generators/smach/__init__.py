"""ROS 1: a catkin package whose nodes run the state machines with SMACH."""

from swarmdsl.generator import ALL_FEATURES, Feature, Generator

from .options import Options
from .package import chosen_machines
from .render import emit

generator = Generator(
    target="smach",
    summary="ROS 1 (noetic): a catkin package that runs the state machines with SMACH",
    emit=emit,
    options_type=Options,
    supports=ALL_FEATURES - {Feature.INTO_STATE, Feature.HISTORY, Feature.INTERNAL},
    machines=chosen_machines,
)
