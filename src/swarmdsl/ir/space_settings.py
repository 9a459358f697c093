"""Values that a robot's body, battery and radio and a sensor's sight have in space.

They are plain data for checks, hints, documents and the simulation of space.
"""

from __future__ import annotations

from collections.abc import Mapping
from math import inf, pi

from swarmdsl.base.records import dataclass


@dataclass(frozen=True, slots=True)
class SpaceSetting:
    """Value in a unit of ROS, from 0 to `most`, and more than 0 if it is `positive`.

    Without a `default`, it must be given if it is `required`, else where something uses it.
    """

    name: str
    unit: str
    default: float | None
    doc: str
    most: float = inf
    positive: bool = False
    required: bool = False


def _table(*settings: SpaceSetting) -> Mapping[str, SpaceSetting]:
    return {setting.name: setting for setting in settings}


SPACE_SETTINGS: Mapping[str, Mapping[str, SpaceSetting]] = {
    "body": _table(
        SpaceSetting("radius", "m", 0.2, "Half the width of the robot.", positive=True),
        SpaceSetting("mass", "kg", 1.0, "Mass of the robot.", positive=True),
        SpaceSetting("speed", "m/s", None, "Greatest speed over ground.", positive=True),
        SpaceSetting("climb", "m/s", 0.0, "Greatest speed up and down; with one, it flies."),
        SpaceSetting("turn", "rad/s", 2 * pi, "Greatest rate of turning.", positive=True),
    ),
    "battery": _table(
        SpaceSetting(
            "capacity", "J", None, "Energy of the full battery.", positive=True, required=True
        ),
        SpaceSetting("moving", "W", 0.0, "Power while the robot moves."),
        SpaceSetting("hovering", "W", 0.0, "Power while it is in the air and does not move."),
        SpaceSetting("sensing", "W", 0.0, "Power of the sensors, all the time."),
        SpaceSetting("idling", "W", 0.0, "Power while it stands on the ground."),
    ),
    "radio": _table(
        SpaceSetting(
            "range",
            "m",
            None,
            "Distance at which others hear the robot.",
            positive=True,
            required=True,
        ),
        SpaceSetting("loss", "", 0.0, "Share of messages lost at this distance.", most=1.0),
        SpaceSetting(
            "through", "", 1.0, "Share of messages that pass a wall or an obstacle.", most=1.0
        ),
    ),
    "senses": _table(
        SpaceSetting(
            "range",
            "m",
            None,
            "Distance at which the target is seen.",
            positive=True,
            required=True,
        ),
        SpaceSetting(
            "view", "rad", 2 * pi, "Width of the field of view.", most=2 * pi, positive=True
        ),
        SpaceSetting("miss", "", 0.0, "Probability to overlook a target in one look.", most=1.0),
        SpaceSetting("wrong", "", 0.0, "Probability to see one that is not there.", most=1.0),
        SpaceSetting("rate", "Hz", 1.0, "Looks in a second.", positive=True),
    ),
}
"""Settings by the word before the block and by name."""
