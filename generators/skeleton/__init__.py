"""Packages for what is modelled and not written yet: functions and components as ROS nodes."""

from __future__ import annotations

from collections.abc import Iterable

from swarmdsl.diagnostics import Diagnostics
from swarmdsl.generator import Generator, OutputFile
from swarmdsl.ir import System

from .mapping import MAPPING
from .options import Options


def emit(system: System, options: Options, report: Diagnostics) -> Iterable[OutputFile]:
    """The files of the packages."""
    # Imported here because whoever checks the options of a project needs no more than these.
    from .render import emit

    return emit(system, options, report)


generator = Generator(
    target="skeleton",
    summary="ROS 1 or 2: a package in C++ or Python for each function and component, to fill in",
    emit=emit,
    options_type=Options,
    mapping=MAPPING,
    # Machines are not its business: it leaves out none of what it is for.
    machines=lambda system: (),
)
