"""Regions that disagree: one event takes the machine out of a parallel state in two ways."""

from __future__ import annotations

from swarmdsl.diagnostics import Label
from swarmdsl.ir.types import Type
from swarmdsl.link_machines import regions
from swarmdsl.syntax import (
    Event,
    Parallel,
    Region,
    StateMachine,
    Transition,
    nodes_of,
    walk,
)
from swarmdsl.topics import awaited, heard_on
from swarmdsl.validate.context import Context


def check_conflicts(machine: StateMachine, context: Context) -> None:
    """Report the second of two transitions that leave a parallel state on one event.

    SCXML takes the first in the text (3.13); whoever reads the model should not have to know.
    """
    outline = context.outline(machine)
    for parallel in nodes_of(machine, Parallel):
        leaving: dict[tuple[str, Type | None], tuple[Region, Transition]] = {}
        for region in regions(parallel):
            for transition in walk(region):
                if not isinstance(transition, Transition) or transition.target is None:
                    continue
                target = transition.target.target
                if target is None or region in outline.around(target):
                    continue
                for trigger in transition.triggers:
                    event = awaited(trigger)
                    if event is None:
                        continue
                    heard = heard_on(event), event.type.type
                    first = leaving.setdefault(heard, (region, transition))
                    if (
                        first[0] is not region
                        and first[1].target is not None
                        and (first[1].target.target is not target)
                    ):
                        context.report.report(
                            "conflicting-regions",
                            transition.span,
                            event=f"event `{event.name}`"
                            if isinstance(event, Event)
                            else f"topic `{event.topic}`",
                            state=parallel.name,
                            related=(Label(first[1].span, "this one is taken"),),
                            help=f"move the transition to state `{parallel.name}`",
                        )
