"""World of a run as JSON, for the engine in the page: members, events, functions and network."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import Any

from swarmdsl import ir
from swarmdsl.codegen.shared.default_values import default_result, default_value
from swarmdsl.execution.simulate.actors import Actor
from swarmdsl.execution.simulate.durations import Fixed, Length, Normal, Uniform
from swarmdsl.execution.simulate.scenario import FunctionBehavior, Robot, Scenario
from swarmdsl.execution.simulate.subject import Subject
from swarmdsl.ir import System
from swarmdsl.tools.player.engine_table import written_machine
from swarmdsl.tools.player.engine_values import encoded

_HEADERS = {"std_msgs/Header": "ros", "swarmros/EventHeader": "bridge"}


def written_world(
    subject: Subject, cast: Sequence[Actor], scenario: Scenario, seed: int, *, has_places: bool
) -> dict[str, Any]:
    """Return what the engine in the page needs; nothing for an SCXML document.

    `cast` is that of a run before it begins.
    """
    system = subject.system
    if system is None:
        return {}
    machines = {actor.machine.name: system.machines_by_name[actor.machine.name] for actor in cast}
    robots = list(dict.fromkeys(actor.robot for actor in cast))
    return {
        "seed": str(seed),
        "swarm": subject.swarm is not None,
        "subject": subject.name,
        "machines": {name: written_machine(each, system) for name, each in machines.items()},
        "robots": [
            {"name": each.name, "role": each.role, "words": each.words} for each in robots
        ],
        "members": [
            {
                "name": actor.name or actor.machine.name,
                "robot": robots.index(actor.robot),
                "machine": actor.machine.name,
                "data": encoded(actor.data),
            }
            for actor in cast
        ],
        "events": {each.name: _event(each, system) for each in system.events},
        "functions": _functions(machines.values(), robots, scenario, system),
        "counts": dict(scenario.counts),
        "latency": _length(scenario.latency),
        "loss": scenario.loss,
        "limits": list(_limits(subject, scenario, has_places)),
    }


def _limits(subject: Subject, scenario: Scenario, has_places: bool) -> Iterator[str]:
    """Yield what the engine in the page does not simulate, in words."""
    assert subject.system is not None
    if has_places:
        yield "places, sensors and the reach of radio are as in the recording"
    if subject.heartbeat is not None:
        yield "who is taken for lost, or heard again, is as in the recording"
    if any(fault.apart for fault in scenario.faults):
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
    }


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
