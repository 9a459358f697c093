"""Mapping of each construct of a swarm, for `swarmc targets promela`.

Text between backticks occurs in the generated files.
"""

from __future__ import annotations

from swarmdsl.codegen import Mapped

from ..composed.mapping import EMULATED, EXACT, rows

MAPPING: tuple[Mapped, ...] = rows(
    robot=(EXACT, "process: `active [2] proctype robot_drone()`"),
    state=(EXACT, "number with a name: `#define at_drone_Circle`"),
    step=(EXACT, "option of its process, one indivisible step: `:: d_step {`"),
    event=(EMULATED, "number in an inbox, as any order is possible: `inbox(to, letter_Taken)++`"),
    watched=(EXACT, "automaton in step with the robots, and `assert(false)`"),
)
