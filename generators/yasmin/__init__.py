"""ROS 2 with YASMIN: an ament_python package whose nodes run the state machines as its own."""

from __future__ import annotations

from collections.abc import Iterable

from swarmdsl.diagnostics import Diagnostics
from swarmdsl.generator import Generator, OutputFile, chosen_machines
from swarmdsl.ir import System

from ..ros2.options import Options
from .mapping import MAPPING


def emit(system: System, options: Options, report: Diagnostics) -> Iterable[OutputFile]:
    """The files of the packages."""
    # Imported here because whoever checks the options of a project needs no more than these.
    from .render import emit

    return emit(system, options, report)


generator = Generator(
    target="yasmin",
    summary="ROS 2 with YASMIN 4.0 or later: a package that runs the state machines with it",
    emit=emit,
    options_type=Options,
    machines=chosen_machines,
    mapping=MAPPING,
)
