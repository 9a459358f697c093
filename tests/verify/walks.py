"""Random walks of a swarm in the simulator.

What chance decides depends on the seed alone, until two swarms do different things: the walk tells
them apart.
"""

from __future__ import annotations

from hashlib import sha256
from random import Random
from typing import Any, NamedTuple

from swarmdsl import ir
from swarmdsl.base.diagnostics.collector import Diagnostics
from swarmdsl.execution.engine import LoopError
from swarmdsl.execution.monitor import FALSE
from swarmdsl.execution.simulate.evaluation.properties import plan, watch, watchable
from swarmdsl.execution.simulate.inputs.events import Input
from swarmdsl.execution.simulate.machines.actors import Actor, actors
from swarmdsl.execution.simulate.machines.subject import Subject
from swarmdsl.execution.simulate.scenario.durations import SECOND, Uniform
from swarmdsl.execution.simulate.scenario.scenario import EVERY_FUNCTION, Scenario
from swarmdsl.execution.simulate.world.line import Line
from swarmdsl.execution.simulate.world.runner import run
from swarmdsl.execution.simulate.world.world import World

from ..agreement.values import Values

_LENGTH = 600 * SECOND
_EVENTS = 30
"""Number of events from outside in a walk."""
_RESULTS = 8
"""Number of results of a function among which chance decides in a walk."""

_WATCHED = 1_000


class Walk(NamedTuple):
    """Digest of what robots do, and the properties that are violated."""

    deeds: bytes
    violated: frozenset[str]


class Surroundings:
    """Chance around a swarm: events from outside with their messages, and results."""

    def __init__(self, system: ir.System, swarm: ir.Swarm) -> None:
        self.system = system
        self.subject = Subject(swarm.name, system, swarm)
        cast = actors(self.subject, self.subject.create_robots({}), Scenario(), Diagnostics())
        names = dict.fromkeys(actor.machine.name for actor in cast)
        values = [Values(system.machines_by_name[name], system) for name in names]
        self._activities = {
            state.activity.function: (state.activity, each)
            for each in values
            for state in each.machine.walk()
            if state.activity is not None
        }
        # An event that a robot sends can come from nobody else.
        sent = {effect.event for each in values for effect in _sends(each.machine)}
        self._events = [
            (event, each)
            for event in system.events
            for each in values
            if event.name not in sent
            and not event.predefined
            and any(a.machine.name == each.machine.name and a.listens(event.name) for a in cast)
        ]

    def functions(self, chance: Random) -> dict[tuple[str, str], dict[str, Any]]:
        """Return the behaviour of functions in a walk."""
        found: dict[tuple[str, str], dict[str, Any]] = {
            (EVERY_FUNCTION, ""): {
                "duration": Uniform(SECOND // 10, 20 * SECOND),
                "aborted": 0.25,
            }
        }
        for name, (activity, values) in self._activities.items():
            values.dice = chance
            results = tuple(values.result(activity) for _ in range(_RESULTS))
            found[name, ""] = {"results": results}
        return found

    def inputs(self, chance: Random, cast: list[Actor]) -> list[Input]:
        """Return events from outside, each for one robot or for all."""
        found = []
        robots = list(dict.fromkeys(actor.robot for actor in cast))
        for _ in range(_EVENTS if self._events else 0):
            event, values = chance.choice(self._events)
            values.dice = chance
            after, data = chance.randrange(40) * SECOND, values.message(event)
            chosen = robots if chance.random() < 0.5 else [chance.choice(robots)]
            to = tuple(a for a in cast if a.robot in chosen and a.listens(event.name))
            found.append(Input(event.name, after, data, to))
        return found


def walk(system: ir.System, swarm: ir.Swarm, around: Surroundings, seed: int) -> Walk:
    """Let a swarm run with chance as a seed decides.

    Properties are watched for small seeds only: that takes as long as all else.
    """
    chance = Random(seed)
    subject = Subject(swarm.name, system, swarm)
    scenario = Scenario(functions=around.functions(chance), latency=Uniform(0, 2 * SECOND))
    cast = actors(subject, subject.create_robots({}), scenario, Diagnostics())
    deeds: list[Any] = []

    def see(line: Line) -> None:
        done = (*line.entered, *line.exited, *line.started, *line.cancelled, *line.sent)
        if done:
            deeds.append((line.time, line.actor.name, done, tuple(line.configuration)))
        if is_watched:
            monitors.see(line)

    world = World(system, cast, scenario, seed, [see], subject.heartbeat)
    is_watched = seed < _WATCHED
    properties = [each for each in watchable(subject) if each.chance is None and is_watched]
    monitors = watch(plan(properties), world.data)
    try:
        ending = run(world, around.inputs(chance, cast), _LENGTH)
    except LoopError:
        return Walk(_digest(*deeds, "endless"), frozenset())
    results = monitors.results(world.clock.now, ended=ending == "ended")
    wrong = frozenset(each.property.name for each in results if each.verdict == FALSE)
    return Walk(_digest(*deeds, ending), wrong)


def _digest(*deeds: Any) -> bytes:
    return sha256(repr(deeds).encode()).digest()


def _sends(machine: ir.StateMachine) -> list[ir.Send]:
    return [
        effect
        for state in machine.walk()
        for effects in (state.entry, state.exit, *(each.effects for each in state.transitions))
        for effect in effects
        if isinstance(effect, ir.Send)
    ]
