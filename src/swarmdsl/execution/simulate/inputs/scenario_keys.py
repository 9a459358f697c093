"""Keys of scenarios."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from swarmdsl.driver.config.keys import (
    ANY,
    TEXT,
    Key,
    Shape,
    list_of,
    one_of,
    one_or_several,
    table,
    table_of,
    whole,
)
from swarmdsl.execution.simulate.inputs.choose_space import KINDS
from swarmdsl.execution.simulate.scenario.durations import WRITTEN
from swarmdsl.ir.function_models import MODELS, Argument

DURATION: Shape = {"type": "string", "pattern": f"^{WRITTEN.pattern}$"}
SHARE: Shape = {"type": "number", "minimum": 0, "maximum": 1}
NAMES = one_or_several(TEXT)
_PLACE: Shape = {
    "type": "array",
    "items": {"type": "number"},
    "minItems": 2,
    "maxItems": 3,
}
_PAIR: Shape = {"type": "array", "items": DURATION, "minItems": 2, "maxItems": 2}
_UNIFORM = {"uniform": Key(_PAIR, "The least and the greatest time.")}
_NORMAL = {"normal": Key(_PAIR, "The mean and the deviation.")}
LENGTH: Shape = {
    "anyOf": [DURATION, table(_UNIFORM, required=_UNIFORM), table(_NORMAL, required=_NORMAL)]
}

SHARES: Mapping[str, Key] = {
    "aborted": Key(SHARE, "Probability that a call is aborted; 1 for a function that is missing."),
    "preempted": Key(SHARE, "Probability that a call is preempted."),
    "never": Key(SHARE, "Probability that a call is never answered."),
}
FUNCTION_OF_MEMBER: Mapping[str, Key] = {
    "duration": Key(LENGTH, "Time that a call takes."),
    "stopping": Key(LENGTH, "Time that it takes to stop when it is cancelled."),
    **SHARES,
    "results": Key(list_of({"type": "object"}), "Results, of which each call has one."),
    "model": Key(
        {"anyOf": [one_of(MODELS), TEXT]},
        "Model of its work in space, which decides when and how it ends.",
    ),
    "arguments": Key({"type": "object"}, "Arguments of the model."),
}


def _argument(argument: Argument) -> Shape:
    """Shape of an argument of a model."""
    match argument.kind:
        case "time":
            return DURATION
        case "place":
            return _PLACE
        case "path":
            return {**list_of(_PLACE), "minItems": 1}
        case "text" if argument.choices:
            return one_of(argument.choices)
        case "text" | "area" | "target":
            return {"type": "string"}
        case "share":
            return SHARE
    least, most = argument.range
    return {"type": "number", "minimum": least, "maximum": most}


# Taplo completes nothing in a table that has `allOf` itself.
_WITH_MODEL: Mapping[str, Any] = {
    "allOf": [
        {
            "if": {"properties": {"model": one_of([name])}, "required": ["model"]},
            "then": {
                "properties": {
                    "arguments": table(
                        {each.name: Key(_argument(each), each.doc) for each in model.arguments}
                    )
                }
            },
        }
        for name, model in MODELS.items()
    ]
}


FUNCTION: Mapping[str, Key] = {
    **FUNCTION_OF_MEMBER,
    "of": Key(
        table_of(table(FUNCTION_OF_MEMBER, dependencies={"model": _WITH_MODEL})),
        "Other values for a robot, a role or a type of member.",
    ),
}
SELF: Mapping[str, Key] = {
    "id": Key(TEXT, "Id of the robot, like `uav[1]`."),
    "count": Key(whole(1), "Number of robots of its role."),
}
NETWORK: Mapping[str, Key] = {
    "latency": Key(LENGTH, "Time that an event takes from robot to robot."),
    "loss": Key(SHARE, "Probability that an event is lost."),
}
WORLD: Mapping[str, Key] = {
    "kind": Key(one_of(KINDS), "Kind of the world."),
    "step": Key(DURATION, "Time between two steps of the space, from 1 ms to 10 s."),
}
MESSAGE: Mapping[str, Key] = {
    "event": Key(TEXT, "Event that comes from outside."),
    "at": Key(LENGTH, "Time at which it comes; a random one is drawn for each robot."),
    "every": Key(DURATION, "Time after which it comes again."),
    "to": Key(NAMES, "Robots, roles or types of member that get it; by default all."),
    "data": Key(ANY, "Fields of its message."),
    "sender": Key(TEXT, "Robot in whose name it comes."),
}
FAULT: Mapping[str, Key] = {
    "at": Key(LENGTH, "Time at which it begins."),
    "lost": Key(NAMES, "Robots, roles or types of member that do nothing any more."),
    "apart": Key(
        {"type": "array", "items": NAMES, "minItems": 2},
        "Groups of robots that do not reach each other.",
    ),
    "silent": Key(TEXT, "Function that is not answered any more."),
    "of": Key(NAMES, "Robots, roles or types of member whose function is silent."),
    "lasts": Key(DURATION, "Time after which it is over; by default it stays."),
}
_CAUSES = [{"required": [each]} for each in ("lost", "apart", "silent")]

TABLES: Mapping[str, Key] = {
    "seed": Key(whole(), "Seed of the random numbers."),
    "until": Key(DURATION, "Time at which the run ends."),
    "self": Key(table(SELF), "Robot on which a machine alone runs."),
    "count": Key(table_of(whole(0)), "Number of members of each role."),
    "params": Key({"type": "object"}, "Values of params, by role, type of member or robot."),
    "network": Key(table(NETWORK), "Network between the robots."),
    "world": Key(table(WORLD), "Space in which the robots are."),
    "functions": Key(
        table_of(table(FUNCTION, dependencies={"model": _WITH_MODEL})),
        "Durations, outcomes and results of functions, by name; `*` is for all.",
    ),
    "messages": Key(list_of(table(MESSAGE, required=("event", "at"))), "Events from outside."),
    "faults": Key(
        list_of(table(FAULT, required=("at",), anyOf=_CAUSES)),
        "Failures of robots, of functions and of the network.",
    ),
}
