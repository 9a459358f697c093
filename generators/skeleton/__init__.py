"""Target `skeleton`: ROS nodes to complete, for functions and components of the model."""

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
    # Machines are not part of this target, so it omits none.
    machines=lambda system: (),
)
