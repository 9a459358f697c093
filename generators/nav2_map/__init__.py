"""Target `nav2_map`: the environments as occupancy maps, for the navigation of ROS."""

from __future__ import annotations

from swarmdsl.codegen import Generator, emit_of

from .mapping import MAPPING
from .options import Options

generator = Generator(
    target="nav2_map",
    summary="an occupancy map of each environment, for the map servers of ROS 1 and ROS 2",
    emit=emit_of(f"{__name__}.render"),
    options_type=Options,
    mapping=MAPPING,
    # A map has no behaviour.
    machines=lambda system: (),
)
