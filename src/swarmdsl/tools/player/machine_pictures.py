"""Pictures of machines for the player: every state is in them, also those of reused machines."""

from __future__ import annotations

from swarmdsl.codegen.diagram.statechart import statechart
from swarmdsl.ir import StateMachine
from swarmdsl.tools.diagram.layout import lay_out
from swarmdsl.tools.diagram.svg import draw

_MOST_NODES = 1_000
"""Larger pictures are slow to lay out and unreadable: the page lists the states instead."""


def machine_picture(machine: StateMachine) -> str:
    """Return the picture of a machine as a part of a page, which has the style of diagrams.

    It is empty for a machine that is too large to be drawn. Nodes and edges have the ids that
    trace lines have for them.
    """
    # Without other machines, a reused one is drawn where it is, with its states.
    diagram = statechart(machine, {})
    if sum(1 for _ in diagram.frame.walk()) > _MOST_NODES:
        return ""
    return draw(lay_out(diagram), lambda origin: None)
