"""Parts of state machines that proofs do not cover."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from itertools import islice

from swarmdsl import ir
from swarmdsl.codegen.shared.identity import member_uses, neighbor_uses
from swarmdsl.execution.simulate.machines.actors import Actor
from swarmdsl.execution.simulate.scenario.scenario import Robot
from swarmdsl.execution.verify.abstraction.doubt import Doubt
from swarmdsl.execution.verify.robot.environment import Options


def uncovered(
    machine: ir.StateMachine, robot: Robot, options: Options, *, has_heartbeat: bool
) -> Iterator[Doubt]:
    """Yield what a machine of a robot uses that proofs do not cover."""
    if not has_heartbeat:
        for _, place in member_uses(machine):
            yield Doubt("without a swarm, it is open which robots are there", place)
    for _, place in islice(neighbor_uses(machine) if robot.name is None else (), 1):
        yield Doubt("without a swarm, it is open how many robots are near", place)
    for activity in (state.activity for state in machine.walk() if state.activity is not None):
        place = activity.origin
        if activity.result_callback is not None:
            yield Doubt(f"callback `{activity.result_callback}` is not covered", place)
        if options.exact and options.timing.stops_late(activity.function, robot):
            yield Doubt(f"the time in which `{activity.function}` stops is not covered", place)


def uncovered_lifespans(system: ir.System, cast: Sequence[Actor]) -> Iterator[Doubt]:
    """Yield the events with a `lifespan` that some machines listen to."""
    for event in system.events:
        has_lifespan = event.delivery is not None and event.delivery.lifespan is not None
        if has_lifespan and any(actor.listens(event.name) for actor in cast):
            yield Doubt(f"the `lifespan` of `{event.name}` is not covered", event.origin)
