"""Mapping of the constructs of a swarm, as far as it is the same in all languages."""

from __future__ import annotations

from swarmdsl.codegen import Mapped, Support

EXACT, EMULATED = Support.EXACT, Support.EMULATED
_REJECTED = Support.REJECTED

Row = tuple[Support, str]


def rows(*, robot: Row, state: Row, step: Row, event: Row, watched: Row) -> tuple[Mapped, ...]:
    """Return the table of a language, by what it makes of each part of a swarm."""
    return tuple(
        Mapped(construct, *row)
        for construct, row in (
            ("robot", robot),
            ("state of a robot", state),
            ("step of a robot", step),
            (
                "variable that decides on anything",
                (EXACT, "part of the state; its value in a comment"),
            ),
            ("event between robots", event),
            ("loss of events", (EXACT, "step with option `lossy`")),
            (
                "outcome of a function, event from outside, delay",
                (EXACT, "step at any time"),
            ),
            ("property that a finite run violates", watched),
            (
                "property of each robot",
                (EXACT, "a file for each robot that stands for others"),
            ),
            ("property about what must happen", (_REJECTED, "left out (SW0916)")),
            (
                "`always possible`",
                (_REJECTED, "left out: it is not about single runs (SW0916)"),
            ),
            ("`within`", (_REJECTED, "left out: steps have no time (SW0916)")),
            ("probability", (_REJECTED, "left out (SW0916)")),
            (
                "what proofs do not cover",
                (
                    _REJECTED,
                    "only some runs are in the file (SW0916); `swarmc verify` tells `unknown`",
                ),
            ),
            (
                "robot with too many states",
                (_REJECTED, "left out: bound a variable (SW0916)"),
            ),
        )
    )
