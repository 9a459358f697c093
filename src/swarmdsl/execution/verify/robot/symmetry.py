"""Key of the robots that nothing tells apart."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from typing import Any

from swarmdsl import ir
from swarmdsl.execution.simulate.machines.actors import Actor
from swarmdsl.execution.verify.abstraction.demands import Demands
from swarmdsl.execution.verify.robot.environment import Environment, Options


def activities(
    cast: Sequence[Actor], machines: Mapping[str, ir.StateMachine]
) -> Iterator[ir.Activity]:
    """Yield the activities of the machines of a robot."""
    for actor in cast:
        for state in machines[actor.machine.name].walk():
            if state.activity is not None:
                yield state.activity


def key_of(
    cast: Sequence[Actor],
    machines: Mapping[str, ir.StateMachine],
    system: ir.System,
    demands: Demands,
    options: Options,
    environment: Environment,
) -> Any:
    """Return what tells the robots of a kind from others."""
    if demands.identity:
        return cast[0].robot.name
    shown = []
    for actor in cast:
        machine = machines[actor.machine.name]
        names = [each.name for each in machine.params]
        names += [v.name for v in machine.variables if demands.keeps(machine.name, v.name)]
        # Conditions of properties can read params of the robot that its machine lacks.
        values = {**actor.params, **{name: actor.data.get(name) for name in names}}
        times = [
            options.timing.function(each.function, actor.robot)
            for each in activities([actor] if options.exact else (), machines)
        ]
        shown.append((machine.name, repr(sorted(values.items())), tuple(times)))
    happens = environment.key(
        cast[0].robot,
        (each.function for each in activities(cast, machines)),
        (event.name for event in system.events),
    )
    return cast[0].robot.role, tuple(shown), happens
