"""Target `gazebo`: the environments as worlds in SDF, for the simulator Gazebo."""

from __future__ import annotations

from swarmdsl.codegen import Generator, emit_of

from .mapping import MAPPING
from .options import Options

generator = Generator(
    target="gazebo",
    summary="a world in SDF for each environment, for the simulator Gazebo",
    emit=emit_of(f"{__name__}.render"),
    options_type=Options,
    mapping=MAPPING,
    # A world has no behaviour.
    machines=lambda system: (),
)
