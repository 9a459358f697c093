"""Packages for what is modelled and not written yet: functions and components as ROS nodes."""

from __future__ import annotations

from swarmdsl.codegen import Generator, emit_of

from .mapping import MAPPING
from .options import Options

generator = Generator(
    target="skeleton",
    summary="ROS 1 or 2: a package in C++ or Python for each function and component, to fill in",
    emit=emit_of(f"{__name__}.render"),
    options_type=Options,
    mapping=MAPPING,
    # Machines are not its business: it leaves out none of what it is for.
    machines=lambda system: (),
)
