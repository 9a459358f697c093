"""Target `yasmin`: an ament_python package whose nodes run the state machines in YASMIN."""

from __future__ import annotations

from swarmdsl.codegen import ALL_FEATURES, Feature, Generator, chosen_machines, emit_of

from ..ros2.options import Options
from .mapping import MAPPING

generator = Generator(
    target="yasmin",
    summary="ROS 2 with YASMIN 4.0 or later: a package that runs the state machines with it",
    emit=emit_of(f"{__name__}.render"),
    options_type=Options,
    machines=chosen_machines,
    mapping=MAPPING,
    supports=ALL_FEATURES - {Feature.NEIGHBORS},
)
