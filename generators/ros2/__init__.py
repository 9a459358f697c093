"""ROS 2: an ament_python package whose nodes run the state machines on rclpy."""

from __future__ import annotations

from collections.abc import Iterable

from swarmdsl.diagnostics import Diagnostics
from swarmdsl.generator import Generator, OutputFile, chosen_machines
from swarmdsl.ir import System

from .mapping import MAPPING
from .options import Options


def emit(system: System, options: Options, report: Diagnostics) -> Iterable[OutputFile]:
    """The files of the packages."""
    # Imported here because whoever checks the options of a project needs no more than these.
    from .render import emit

    return emit(system, options, report)


generator = Generator(
    target="ros2",
    summary="ROS 2 (humble and later): a package whose nodes run the state machines on rclpy",
    emit=emit,
    options_type=Options,
    machines=chosen_machines,
    mapping=MAPPING,
)
