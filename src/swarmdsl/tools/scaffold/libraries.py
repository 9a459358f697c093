"""Libraries whose robots `swarmc new --robots` puts into a project."""

from __future__ import annotations

from collections.abc import Mapping

from swarmdsl.base.records import dataclass


@dataclass(frozen=True)
class Library:
    """A library with members, and what the template for its robots declares and needs."""

    about: str
    """Purpose of the project, if the user gives none."""
    summary: str
    """Robots of the library, with the software that serves them."""
    role: str
    """Role of the robots in the swarm."""
    interfaces: str
    """Packages with the interfaces of the functions, separated by commas."""
    declared: frozenset[str]
    """CamelCase names of the template and of the library elements that it imports."""

    @property
    def packages(self) -> tuple[str, ...]:
        """Packages with the interfaces of the functions."""
        return tuple(self.interfaces.split(","))


LIBRARIES: Mapping[str, Library] = {
    "turtlebot4": Library(
        "TurtleBots that patrol, and return to their docks when a person says so.",
        "TurtleBot 4, with Nav2",
        "guard",
        "irobot_create_msgs,nav2_msgs",
        frozenset({"Guard", "Patrol", "Site", "Waits", "TurtleBot4"}),
    ),
    "nav2": Library(
        "Robots that patrol, and return to their places when a person says so.",
        "robots that Nav2 drives",
        "guard",
        "nav2_msgs",
        frozenset({"Guard", "Patrol", "Site", "Waits", "NavigatingRobot"}),
    ),
    "crazyswarm2": Library(
        "Crazyflies that fly to and fro, and land when a person says so.",
        "Crazyflies, with Crazyswarm2",
        "flyer",
        "crazyflie_interfaces",
        frozenset({"Flyer", "Fly", "Cage", "Waits", "CrazyflieWithFlow"}),
    ),
    "mavros": Library(
        "Copters that take off, stay, and land when their time is over or a person says so.",
        "copters with ArduPilot, with MAVROS",
        "copter",
        "mavros_msgs",
        frozenset({"Copter", "Fly", "Site", "Waits", "MavrosVehicle"}),
    ),
    "px4": Library(
        "Copters that take off, stay, and land when their time is over or a person says so.",
        "copters with PX4, over XRCE-DDS",
        "copter",
        "px4_msgs",
        frozenset({"Copter", "Fly", "Site", "Waits", "Px4Vehicle"}),
    ),
}
