"""Mapping of each construct of a swarm, for `swarmc targets promela`.

Text between backticks occurs in the generated files.
"""

from __future__ import annotations

from swarmdsl.codegen import Mapped, Support

_EXACT, _EMULATED, _REJECTED = Support.EXACT, Support.EMULATED, Support.REJECTED

MAPPING = tuple(
    Mapped(*each)
    for each in (
        ("robot", _EXACT, "process: `active [2] proctype robot_drone()`"),
        ("state of a robot", _EXACT, "number with a name: `#define at_drone_Circle`"),
        ("step of a robot", _EXACT, "option of its process, one indivisible step: `:: d_step {`"),
        ("variable that decides on anything", _EXACT, "part of the state; its value in a comment"),
        (
            "event between robots",
            _EMULATED,
            "number in an inbox, as any order is possible: `inbox(to, letter_Taken)++`",
        ),
        ("loss of events", _EXACT, "step with option `lossy`"),
        ("outcome of a function, event from outside, delay", _EXACT, "step at any time"),
        (
            "property that a finite run violates",
            _EXACT,
            "automaton in step with the robots, and `assert(false)`",
        ),
        ("property of each robot", _EXACT, "a file for each robot that stands for others"),
        ("property about what must happen", _REJECTED, "left out (SW0916)"),
        ("`always possible`", _REJECTED, "left out: it is not about single runs (SW0916)"),
        ("`within`", _REJECTED, "left out: steps have no time (SW0916)"),
        ("probability", _REJECTED, "left out (SW0916)"),
        (
            "what proofs do not cover",
            _REJECTED,
            "only some runs are in the file (SW0916); `swarmc verify` tells `unknown` as well",
        ),
        ("robot with too many states", _REJECTED, "left out: bound a variable (SW0916)"),
    )
)
