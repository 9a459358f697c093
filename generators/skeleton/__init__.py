"""Packages for what is modelled and not written yet: functions and components as ROS nodes."""

from swarmdsl.generator import Generator

from .mapping import MAPPING
from .options import Options
from .render import emit

generator = Generator(
    target="skeleton",
    summary="ROS 1 or 2: a package in C++ or Python for each function and component, to fill in",
    emit=emit,
    options_type=Options,
    mapping=MAPPING,
    # Machines are not its business: it leaves out none of what it is for.
    machines=lambda system: (),
)
