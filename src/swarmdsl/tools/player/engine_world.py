"""World of a run as JSON, for the engine in the page: members, events, functions and network."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from typing import Any

from swarmdsl import ir
from swarmdsl.codegen.shared.default_values import default_result, default_value, result_fields
from swarmdsl.execution.simulate.machines.actors import Actor
from swarmdsl.execution.simulate.machines.subject import Subject
from swarmdsl.execution.simulate.scenario.durations import (
    Fixed,
    Length,
    Normal,
    Uniform,
    written_duration,
)
from swarmdsl.execution.simulate.scenario.scenario import FunctionBehavior, Robot, Scenario
from swarmdsl.execution.simulate.scenario.space import ABSTRACT
from swarmdsl.execution.simulate.world.world import World
from swarmdsl.execution.verify.report.toml_text import toml_text
from swarmdsl.ir import System
from swarmdsl.syntax.types import DURATION, Named, Primitive
from swarmdsl.tools.player.engine_table import written_machine
from swarmdsl.tools.player.engine_values import encoded

_HEADERS = {"std_msgs/Header": "ros", "swarmros/EventHeader": "bridge"}


def written_world(subject: Subject, cast: Sequence[Actor], world: World) -> dict[str, Any]:
    """Return what the engine in the page needs of a world that has not begun.

    That is nothing for an SCXML document.
    """
    system, scenario = subject.system, world.scenario
    if system is None:
        return {}
    machines = {actor.machine.name: system.machines_by_name[actor.machine.name] for actor in cast}
    robots = list(dict.fromkeys(actor.robot for actor in cast))
    return {
        "seed": str(world.seed),
        "swarm": subject.swarm is not None,
        "subject": subject.name,
        "machines": {name: written_machine(each, system) for name, each in machines.items()},
        "robots": [{"name": each.name, "role": each.role} for each in robots],
        "members": [
            {
                "name": actor.name or actor.machine.name,
                "robot": robots.index(actor.robot),
                "machine": actor.machine.name,
                "data": encoded({k: v for k, v in actor.data.items() if not callable(v)}),
            }
            for actor in cast
        ],
        "events": {each.name: _event(each, system) for each in system.events},
        "functions": _functions(machines.values(), robots, scenario, system),
        "scenario": _setting(scenario, system),
        "latency": _length(scenario.latency),
        "loss": scenario.loss,
        "limits": list(_limits(subject, world)),
    }


def _setting(scenario: Scenario, system: System) -> str:
    """Return the scenario of tests in TOML; no function ends by itself until the time `@end`."""
    params = [param for each in system.machines for param in each.params]
    params += [param for each in system.members for param in each.params]
    params += [param for each in system.components for param in each.params]
    times = {param.name for param in params if param.type == DURATION}
    values = {
        word: {name: written_duration(v) if name in times else v for name, v in given.items()}
        for word, given in scenario.params.items()
    }
    found: dict[str, Any] = {"count": scenario.counts, "params": values}
    found["functions"] = {"*": {"duration": "@end"}}
    found["world"] = {"kind": "abstract"}
    return toml_text({key: value for key, value in found.items() if value})


def _limits(subject: Subject, world: World) -> Iterator[str]:
    """Yield what the engine in the page does not simulate, in words."""
    assert subject.system is not None
    if world.space is not ABSTRACT:
        yield "places, sensors and the reach of radio are as in the recording"
    if subject.heartbeat is not None:
        yield "who is taken for lost, or heard again, is as in the recording"
    if any(fault.apart for fault in world.scenario.faults):
        yield "groups that do not reach each other do so after the fork"
    kept = (each.delivery for each in subject.system.events if each.swarm)
    if any(each is not None and (each.latest or each.lifespan is not None) for each in kept):
        yield "no event is sent again to robots that come later, and none is too old on arrival"


def _event(event: ir.Event, system: System) -> dict[str, Any]:
    message = system.known_interface(event.type)
    fields = message.fields if isinstance(message, ir.Message) else ()
    delivery = event.delivery
    return {
        "topic": event.topic,
        "incoming": event.incoming_topic,
        "swarm": event.swarm,
        "predefined": event.predefined,
        "reliable": delivery is not None and delivery.reliable,
        "headers": [
            [field.name, _HEADERS[str(field.type)]]
            for field in fields
            if str(field.type) in _HEADERS
        ],
        "blank": encoded(default_value(event.type, system)),
        "times": list(_times(fields, system)),
    }


def _times(fields: Iterable[ir.Field], system: System) -> Iterator[list[str]]:
    """Yield the paths of times and durations in a message, which tests have in words."""
    for field in fields:
        if isinstance(field.type, Primitive) and field.type.name in ("time", "duration"):
            yield [field.name]
        elif isinstance(field.type, Named):
            inner = system.known_interface(field.type)
            for path in _times(inner.fields if isinstance(inner, ir.Message) else (), system):
                yield [field.name, *path]


def _functions(
    machines: Any, robots: Sequence[Robot], scenario: Scenario, system: System
) -> dict[str, Any]:
    """Return the functions that machines call, with what they do on each robot."""
    called = (state.activity for machine in machines for state in machine.walk())
    names = dict.fromkeys(activity.function for activity in called if activity is not None)
    found = {}
    for name in names:
        call = system.function(name).communication
        kinds: list[dict[str, Any]] = []
        of_robots = []
        for robot in robots:
            kind = _behavior(scenario.behavior(name, robot))
            if kind not in kinds:
                kinds.append(kind)
            of_robots.append(kinds.index(kind))
        found[name] = {
            "service": call.paradigm == "service",
            "blank": encoded(default_result(call, system)),
            "times": list(_times(result_fields(call, system) or (), system)),
            "kinds": kinds,
            "robots": of_robots,
        }
    return found


def _behavior(behavior: FunctionBehavior) -> dict[str, Any]:
    return {
        "duration": _length(behavior.duration),
        "stopping": _length(behavior.stopping),
        "aborted": behavior.aborted,
        "preempted": behavior.preempted,
        "never": behavior.never,
        "results": [encoded(dict(each)) for each in behavior.results],
        "model": behavior.model,
    }


def _length(length: Length) -> list[Any]:
    """Return a length of time: a word, and nanoseconds."""
    match length:
        case Fixed(length=fixed):
            return ["fixed", fixed]
        case Uniform(low=low, high=high):
            return ["uniform", low, high]
        case Normal(mean=mean, deviation=deviation):
            return ["normal", mean, deviation]
