"""Target `promela`: the composed swarm for the model checker SPIN."""

from __future__ import annotations

from swarmdsl.codegen import Generator, emit_of

from ..composed.options import Options
from .mapping import MAPPING

generator = Generator(
    target="promela",
    summary="the composed swarm and its safety properties in Promela, for the model checker SPIN",
    emit=emit_of(f"{__name__}.render"),
    options_type=Options,
    mapping=MAPPING,
    # Robots without a swarm or behaviour are no part of a composition.
    machines=lambda system: (),
)
