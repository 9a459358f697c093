"""Moments of a move: the lines of a robot, as far as findings and properties can see them."""

from __future__ import annotations

from collections.abc import Sequence

from swarmdsl.execution.verify.automata.labels import Moment
from swarmdsl.execution.verify.robot.body import Body


def moments_of(body: Body, shown: Sequence[tuple[int, int]]) -> tuple[Moment, ...]:
    """Return what the lines of a body show, with the machine of each and the facts that hold."""
    last = len(shown) - 1
    return tuple(
        Moment(
            actor,
            line.event,
            tuple(dict.fromkeys(map(line.actor.machine.called, line.taken))),
            tuple(dict.fromkeys(line.entered)),
            holding,
            line.ignored and not line.taken,
            tuple(line.started),
            tuple(line.sent),
            tuple(body.failures) if number == last else (),
            body.loop is not None and number == last,
        )
        for number, (line, (actor, holding)) in enumerate(zip(body.lines, shown, strict=True))
    )
