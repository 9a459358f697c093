"""Target `jani`: the composed swarm for Storm and other model checkers that read JANI."""

from __future__ import annotations

from swarmdsl.codegen import Generator, emit_of

from ..composed.options import Options
from .mapping import MAPPING

generator = Generator(
    target="jani",
    summary="the composed swarm and its safety properties in JANI, for the model checker Storm",
    emit=emit_of(f"{__name__}.render"),
    options_type=Options,
    mapping=MAPPING,
    # Robots without a swarm or behaviour are no part of a composition.
    machines=lambda system: (),
)
