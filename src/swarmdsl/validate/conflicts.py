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
    walk,
)
from swarmdsl.topics import awaited, heard_on
from swarmdsl.validate.context import Context


def check_conflicts(machine: StateMachine, context: Context) -> None:
    """Report the second of two transitions that leave a parallel state on one event.

    SCXML takes the first in the text (3.13); whoever reads the model should not have to know.
    """
    for parallel in walk(machine):
        if not isinstance(parallel, Parallel):
            continue
        leaving: dict[tuple[str, Type | None], tuple[Region, Transition]] = {}
        for region in regions(parallel):
            inside = set(walk(region))
            for transition in walk(region):
                if not isinstance(transition, Transition) or transition.target is None:
                    continue
                if transition.target.target is None or transition.target.target in inside:
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
                        and (first[1].target.target is not transition.target.target)
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
