"""Target `murphi`: the composed swarm for the model checkers rumur and Murphi."""

from __future__ import annotations

from swarmdsl.codegen import Generator, emit_of

from ..composed.options import Options
from .mapping import MAPPING

generator = Generator(
    target="murphi",
    summary="the composed swarm and its safety properties in Murphi, for the model checker rumur",
    emit=emit_of(f"{__name__}.render"),
    options_type=Options,
    mapping=MAPPING,
    # Robots without a swarm or behaviour are no part of a composition.
    machines=lambda system: (),
)
