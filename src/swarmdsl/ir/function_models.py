"""Catalogue of the models that functions can have in space, with their arguments.

What they do is in `execution/space/functions/`; this is what a model or a scenario may say of them.
Lengths are in metres, speeds in m/s, angles in radians, times in nanoseconds.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import Literal, NamedTuple

ArgumentKind = Literal[
    "length",
    "speed",
    "angle",
    "time",
    "number",
    "share",
    "place",
    "path",
    "area",
    "target",
    "text",
]
"""A `place` is a message with a position in it, a `path` a list of them; an `area`, a `target` and
a `text` are strings: the name of an area, a kind of target or the name of one, and anything."""

NAMES: tuple[ArgumentKind, ...] = ("area", "target", "text")
"""Kinds of arguments that are strings."""
ANY_TARGET = "any"
"""Name of all targets, of any kind."""
MOST = 1e9
"""Greatest value of an argument that is a number, in its unit; a time has no greatest one."""
_LEAST = {"length": 0.0, "speed": 0.001, "time": 0.0, "share": 0.0}
_UNITS = {"length": " m", "speed": " m/s", "angle": " rad", "time": " s"}


class Argument(NamedTuple):
    """Argument of a model; with `default` None, the model chooses a value by itself.

    A text with `choices` is one of them. A number has a `least` value, in metres, m/s or seconds:
    if it is None, 0.001 for a speed, and 0 for a length, a time or a share.
    """

    name: str
    kind: ArgumentKind
    default: float | str | None
    doc: str
    choices: tuple[str, ...] = ()
    least: float | None = None

    @property
    def range(self) -> tuple[float, float]:
        """Least and greatest value of a number, in metres, m/s, radians or seconds."""
        least = _LEAST.get(self.kind, -MOST) if self.least is None else self.least
        return least, {"share": 1.0, "time": math.inf}.get(self.kind, MOST)

    def limits(self, value: float) -> str | None:
        """Return how a number must be, if a value is out of the range: "at least 0.1 m"."""
        least, most = self.range
        if least <= value <= most:
            return None
        if self.kind == "share":
            return "from 0 to 1"
        unit = _UNITS.get(self.kind, "")
        return f"at least {least:g}{unit}" if not value >= least else f"at most {most:g}{unit}"


class FunctionModel(NamedTuple):
    """Model of a function: what it does, its arguments, and how it can end."""

    name: str
    doc: str
    arguments: tuple[Argument, ...] = ()
    outcomes: tuple[str, ...] = ("succeeded", "aborted")

    def argument(self, name: str) -> Argument | None:
        """Return the argument of that name, or None."""
        return next((each for each in self.arguments if each.name == name), None)


_HEIGHT = Argument("height", "length", None, "height above the ground; that of now without it")
_SPEED = Argument("speed", "speed", None, "speed; that of the body without it")
_WHICH = Argument(
    "which", "text", "any", "targets that end it: any, or new for the robot", ("any", "new")
)
_TARGET = Argument("target", "target", None, "kind or name of the target; without it, any")
_TOLERANCE = Argument("tolerance", "length", 0.1, "distance at which it has arrived", least=0.001)
_SECOND = 1_000_000_000


def _time(seconds: float | None, doc: str) -> Argument:
    return Argument("time", "time", None if seconds is None else seconds * _SECOND, doc)


def _charger(doc: str) -> Argument:
    return Argument("target", "target", "charger", doc)


MODELS: Mapping[str, FunctionModel] = {
    each.name: each
    for each in (
        FunctionModel(
            "go_to",
            "Go to a place, around what is in the way.",
            (
                Argument("to", "place", None, "the place; without it, the first one in the goal"),
                _HEIGHT,
                _SPEED,
                _TOLERANCE,
            ),
        ),
        FunctionModel(
            "go_home",
            "Go to where the robot started, around what is in the way.",
            (
                Argument("to", "place", None, "another home; that in the goal, unless all is 0"),
                Argument("end", "length", None, "height in the end; that of the way without it"),
                _HEIGHT,
                _SPEED,
                _TOLERANCE,
            ),
        ),
        FunctionModel(
            "random_walk",
            "Go straight on, and in another direction after a distance or a contact.",
            (
                Argument("leg", "length", 10.0, "mean distance between two turns", least=0.01),
                Argument("turn", "angle", math.tau, "width of the interval of a turn"),
                Argument("target", "target", None, "target that ends it, or any; without it, none"),
                _WHICH,
                Argument("time", "time", None, "time after which it ends; without it, never"),
                _HEIGHT,
                _SPEED,
            ),
        ),
        FunctionModel(
            "coverage",
            "Sweep an area in parallel lanes, each robot its share; end where a target is seen.",
            (
                Argument("width", "length", 5.0, "distance between two lanes", least=0.01),
                Argument("area", "area", None, "name of the area; without it, the environment"),
                Argument(
                    "view", "angle", None, "angle seen from above, which makes the lanes: no width"
                ),
                _HEIGHT,
                _SPEED,
                Argument("target", "target", None, "kind of target that ends it; without it, any"),
                _WHICH,
            ),
        ),
        FunctionModel(
            "take_off",
            "Climb to a height, above the place of now.",
            (Argument("height", "length", None, "height; the altitude in the goal, or 2 m"),),
        ),
        FunctionModel("land", "Go down to the ground, below the place of now."),
        FunctionModel(
            "hover",
            "Stay where the robot is, against the wind.",
            (_time(None, "time after which it succeeds; without it, never"),),
        ),
        FunctionModel(
            "follow_path",
            "Go from one place of a path to the next, in straight lines.",
            (
                Argument("path", "path", None, "the path; without it, the first one in the goal"),
                _HEIGHT,
                _SPEED,
                _TOLERANCE,
            ),
        ),
        FunctionModel(
            "drive",
            "Go straight on or backwards, turn on the spot, or both along an arc.",
            (
                Argument("distance", "length", 0.0, "way; negative to go backwards", least=-MOST),
                Argument("turn", "angle", 0.0, "angle of the turn, to the left"),
                Argument("rate", "number", 1.0, "fastest turn, in radians per second", least=0.001),
                _HEIGHT,
                _SPEED,
            ),
        ),
        FunctionModel(
            "track",
            "Stay near a target; aborted when it has been out of sight for a time.",
            (
                _TARGET,
                Argument("to", "place", None, "where it should be; else where it was seen last"),
                Argument("distance", "length", 0.0, "distance to keep"),
                Argument("lost", "time", 10 * _SECOND, "time out of sight after which it is lost"),
                _time(None, "time after which it succeeds; without it, never"),
                _HEIGHT,
                _SPEED,
            ),
        ),
        FunctionModel(
            "avoid",
            "Move away from walls, obstacles, zones and robots that are too near.",
            (
                Argument("distance", "length", 1.0, "distance to have to all of them", least=0.01),
                _time(30, "time after which it is aborted"),
                _HEIGHT,
                _SPEED,
            ),
        ),
        FunctionModel(
            "flock",
            "Move with the robots in reach that do the same; aborted when it has lost them.",
            (
                Argument("rule", "text", "reynolds", "rule of the flock", ("reynolds", "vicsek")),
                Argument(
                    "range", "length", 10.0, "distance at which robots see each other", least=0.01
                ),
                Argument("spacing", "length", 3.0, "distance below which robots part", least=0.01),
                Argument("separation", "number", 1.5, "weight of parting"),
                Argument("alignment", "number", 1.0, "weight of going the same way"),
                Argument("cohesion", "number", 0.3, "weight of staying together"),
                Argument("noise", "angle", 0.0, "width of the noise of a change of direction"),
                Argument("period", "time", _SECOND, "time between two changes of direction"),
                Argument("lost", "time", None, "time alone after which it is aborted; else never"),
                _time(None, "time after which it succeeds; without it, never"),
                _HEIGHT,
                _SPEED,
            ),
        ),
        FunctionModel(
            "disperse",
            "Move away from robots that are too near.",
            (
                Argument("distance", "length", 5.0, "distance to have to all others", least=0.01),
                _time(None, "time after which it is aborted; without it, never"),
                _HEIGHT,
                _SPEED,
            ),
        ),
        FunctionModel(
            "aggregate",
            "Walk about, and rest beside others that rest.",
            (
                Argument("turn", "angle", math.tau, "width of the interval of a turn"),
                Argument(
                    "range", "length", 1.0, "distance at which robots see each other", least=0.01
                ),
                Argument("size", "number", None, "number of robots that are enough", least=1.0),
                Argument("leg", "length", 5.0, "mean distance between two turns", least=0.01),
                _time(None, "time after which it ends; without it, never"),
                _HEIGHT,
                _SPEED,
            ),
        ),
        FunctionModel(
            "form_up",
            "Go to the place of the robot in a formation of its role.",
            (
                Argument("shape", "text", "line", "formation", ("line", "wedge", "circle")),
                Argument("spacing", "length", 3.0, "distance between neighbours"),
                Argument("heading", "angle", 0.0, "direction in which the formation looks"),
                Argument("at", "place", None, "its middle; without it, that of the robots"),
                _HEIGHT,
                _SPEED,
                _TOLERANCE,
            ),
        ),
        FunctionModel(
            "dock",
            "Wait for a free charger, go there and land: one robot at a charger at a time.",
            (
                _charger("kind of target that is a charger"),
                Argument("power", "number", 0.0, "power in watts while it stays there", least=0.0),
                _HEIGHT,
                _SPEED,
            ),
        ),
        FunctionModel(
            "charge",
            "Charge at a charger, up to a level, or have the battery swapped.",
            (
                _charger("kind or name of the charger"),
                Argument("power", "number", 100.0, "power of the charger, in watts", least=0.001),
                Argument("level", "share", 1.0, "share of the capacity to charge up to"),
                _time(None, "time after which the battery is swapped for a full one"),
            ),
        ),
        FunctionModel(
            "grasp",
            "Take the nearest target in reach.",
            (
                _TARGET,
                Argument("reach", "length", 0.5, "distance up to which the robot reaches"),
                _time(2, "time that it takes"),
            ),
        ),
        FunctionModel(
            "carry",
            "Go to a place with what the robot has taken.",
            (
                Argument("to", "place", None, "the place; without it, the first one in the goal"),
                _HEIGHT,
                _SPEED,
                _TOLERANCE,
            ),
        ),
        FunctionModel(
            "place",
            "Put down what the robot carries.",
            (_time(2, "time that it takes"),),
        ),
        FunctionModel(
            "spray",
            "Spray the targets around the robot, with what is in its tank.",
            (
                _TARGET,
                Argument("width", "length", 2.0, "width of the jet"),
                Argument("amount", "share", 0.1, "share of a full tank that it takes"),
                _time(10, "time that it takes"),
            ),
        ),
        FunctionModel("refill", "Fill the tank.", (_time(60, "time that it takes"),)),
        FunctionModel(
            "bid",
            "Bid for a task: the nearest robot of a role gets it; aborted for the others.",
            (
                Argument("task_id", "text", None, "name of the task, which is given away once"),
                Argument("to", "place", None, "where the task is; without it, that in the goal"),
                _time(2, "time for bids of others"),
            ),
        ),
        FunctionModel(
            "sense",
            "Stay and look for a target; aborted when a time is over.",
            (_TARGET, _time(None, "time after which it is aborted; without it, never")),
        ),
    )
}
