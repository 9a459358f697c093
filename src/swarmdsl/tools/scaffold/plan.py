"""What a new project is to have."""

from __future__ import annotations

import re
from collections import Counter

from swarmdsl.base.diagnostics.collector import Diagnostics
from swarmdsl.base.naming import camel_case, snake_case
from swarmdsl.base.records import dataclass
from swarmdsl.tools.scaffold.names import check_project_name, check_type_name, command_line_span

# One of them: packages of both generations of ROS have the same names.
TARGETS = ("ros2", "smach")
# What the template itself has: files, declarations, and a param of each robot.
_FILES = ("behaviour", "members", "interfaces", "cpswarm")
# Projects whose package of interfaces would hide one that ROS comes with.
_OF_ROS = ("builtin", "composition", "example", "rcl", "test")
_DECLARED = ("Explore", "Field", "Finds", "Speed")
_COUNT = re.compile(r"\*|([0-9]+)(?:\.\.(\*|[0-9]+))?")


@dataclass(frozen=True)
class Robots:
    """A type of member of the swarm, and how many of them there are: `3`, `1..5`, `2..*`, `*`."""

    member: str
    count: str = "3"

    @property
    def role(self) -> str:
        """What they are called in the swarm."""
        return snake_case(self.member)

    @property
    def least(self) -> int:
        """How many there are at least: so many run in a simulation."""
        lowest = self.count.partition("..")[0]
        return int(lowest) if lowest.isdecimal() else 1


@dataclass(frozen=True)
class Plan:
    """A project: its name, its robots, and what they are made of."""

    name: str
    description: str = ""
    swarm: str = ""
    robots: tuple[Robots, ...] = (Robots("Robot"),)
    sensor: str = "Camera"
    controller: str = "Pilot"
    actuator: str = "Wheels"
    target: str = "ros2"

    @property
    def package(self) -> str:
        """The package of the model."""
        return snake_case(self.name)

    @property
    def swarm_name(self) -> str:
        """The name of the swarm: that given, else that of the project."""
        if self.swarm:
            return self.swarm
        name = camel_case(self.name)
        taken = {robots.member for robots in self.robots} | set(self.components)
        return f"{name}Swarm" if name in taken else name

    @property
    def launch(self) -> str:
        """What the launch file of the swarm is called."""
        return snake_case(self.swarm_name)

    @property
    def components(self) -> tuple[str, str, str]:
        """What each robot has: a sensor, a controller and an actuator."""
        return self.sensor, self.controller, self.actuator

    @property
    def parts(self) -> tuple[str, ...]:
        """What these are called in a robot."""
        return tuple(map(snake_case, self.components))


def check_plan(plan: Plan, report: Diagnostics) -> None:
    """Report names and numbers that a model cannot have."""
    check_project_name(plan.name, report)
    if plan.package in _FILES:
        _report_taken(plan.name, "a project", report)
    if plan.package in _OF_ROS:
        package = f"`{plan.package}_interfaces`"
        _report_taken(plan.name, "a project", report, f"ROS has a package {package} already")
    kinds = ("a sensor", "a controller", "an actuator")
    names = [(robots.member, "a member") for robots in plan.robots]
    names += zip(plan.components, kinds, strict=True)
    if plan.swarm:
        names.append((plan.swarm, "a swarm"))
    for name, kind in names:
        check_type_name(name, kind, report)
        if name in _DECLARED:
            _report_taken(name, kind, report)
    for name, times in Counter(name for name, _ in names).items():
        if times > 1:
            way = "each member and component has a name of its own"
            what = f"the name of {times} things"
            report.report("bad-name", command_line_span(name), name=name, what=what, help=way)
    for robots in plan.robots:
        if not _is_count(robots.count):
            way = "write `3`, `1..5`, `2..*` or `*`, for at least one"
            what = f"the number of `{robots.member}`"
            report.report(
                "bad-name", command_line_span(robots.count), name=robots.count, what=what, help=way
            )


def _report_taken(
    name: str,
    kind: str,
    report: Diagnostics,
    why: str = "what is made has something of this name already",
) -> None:
    way = f"{why}: choose another one"
    report.report(
        "bad-name", command_line_span(name), name=name, what=f"the name of {kind}", help=way
    )


def _is_count(text: str) -> bool:
    found = _COUNT.fullmatch(text)
    if found is None:
        return False
    lowest, highest = found.groups()
    if highest is None:
        return lowest is None or int(lowest) > 0
    return highest == "*" or int(highest) >= max(1, int(lowest))
