"""ROS 1 or 2: a package whose nodes run the state machines with SMACH."""

from __future__ import annotations

from collections.abc import Iterable

from swarmdsl.diagnostics import Diagnostics
from swarmdsl.generator import Generator, OutputFile, chosen_machines
from swarmdsl.ir import System

from .mapping import MAPPING
from .options import Options
from .ros2.mapping import MAPPING as MAPPING_FOR_ROS_2


def emit(system: System, options: Options, report: Diagnostics) -> Iterable[OutputFile]:
    """The files of the packages."""
    # Imported here because whoever checks the options of a project needs no more than these.
    from .render import emit

    return emit(system, options, report)


generator = Generator(
    target="smach",
    summary="ROS 1 (noetic) or 2: a package that runs the state machines with SMACH",
    emit=emit,
    options_type=Options,
    machines=chosen_machines,
    mapping=MAPPING,
    mapping_with={"ros=2": MAPPING_FOR_ROS_2},
)
