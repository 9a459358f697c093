"""Mapping of each construct of a swarm, for `swarmc targets murphi`.

Text between backticks occurs in the generated files.
"""

from __future__ import annotations

from swarmdsl.codegen import Mapped

from ..composed.mapping import EMULATED, EXACT, rows

MAPPING: tuple[Mapped, ...] = rows(
    robot=(EXACT, "element of a symmetric set: `robot_drone: scalarset(2)`"),
    state=(EXACT, "value with a name: `in_drone_Circle`"),
    step=(EXACT, "rule: `ruleset me: robot_drone do`"),
    event=(EMULATED, "number in an inbox, as any order is possible: `letter_Taken`"),
    watched=(EXACT, "automaton in step with the robots, and `invariant`"),
)
