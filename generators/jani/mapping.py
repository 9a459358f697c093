"""Mapping of each construct of a swarm, for `swarmc targets jani`.

Text between backticks occurs in the generated files.
"""

from __future__ import annotations

from swarmdsl.codegen import Mapped

from ..composed.mapping import EMULATED, EXACT, rows

MAPPING: tuple[Mapped, ...] = rows(
    robot=(EXACT, "automaton: `drone_0`"),
    state=(EXACT, "location: `drone_Circle`"),
    step=(EXACT, 'edge without an action, and its assignments: `"destinations"`'),
    event=(EMULATED, "number in a variable, as any order is possible: `inbox_drone_1_Taken`"),
    watched=(EXACT, 'variable `watch` in step with the robots, and a property with `"Pmax"`'),
)
