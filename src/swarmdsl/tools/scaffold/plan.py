"""Plan of a new project."""

from __future__ import annotations

import re
from collections import Counter

from swarmdsl.base.diagnostics.collector import Diagnostics
from swarmdsl.base.naming import camel_case, snake_case
from swarmdsl.base.numerals import integer
from swarmdsl.base.records import dataclass
from swarmdsl.tools.scaffold.libraries import LIBRARIES
from swarmdsl.tools.scaffold.names import check_project_name, check_type_name, command_line_span

# A project has one of them: packages for ROS 1 and ROS 2 have the same names.
TARGETS = ("ros2", "smach")
# Names of files in the template.
_TEMPLATE_FILES = ("behaviour", "members", "interfaces", "cpswarm")
# Projects whose `*_interfaces` package would hide one of ROS.
_ROS_PROJECTS = ("builtin", "composition", "example", "rcl", "test")
# Names that the template declares; `Speed` would clash with a param.
_TEMPLATE_NAMES = ("Explore", "Field", "Finds", "Speed")
_MULTIPLICITY = re.compile(r"\*|([0-9]+)(?:\.\.(\*|[0-9]+))?")


@dataclass(frozen=True)
class Robots:
    """A member type and its multiplicity in the swarm: `3`, `1..5`, `2..*` or `*`."""

    member: str
    count: str = "3"

    @property
    def role(self) -> str:
        """Name of the role."""
        return snake_case(self.member)

    @property
    def minimum(self) -> int:
        """Minimum number of robots, which is the number in a simulation."""
        lowest = self.count.partition("..")[0]
        return integer(lowest) if lowest.isdecimal() else 1


@dataclass(frozen=True)
class Plan:
    """Names and other settings of a new project."""

    name: str
    description: str = ""
    swarm: str = ""
    robots: tuple[Robots, ...] = (Robots("Robot"),)
    sensor: str = "Camera"
    controller: str = "Pilot"
    actuator: str = "Wheels"
    target: str = "ros2"
    library: str = ""
    """A library whose robots the project has, instead of `robots` with components."""

    @property
    def package(self) -> str:
        """Package name of the model."""
        return snake_case(self.name)

    @property
    def swarm_name(self) -> str:
        """Name of the swarm, by default derived from the project name."""
        if self.swarm:
            return self.swarm
        name = camel_case(self.name)
        return f"{name}Swarm" if name in self.declared else name

    @property
    def declared(self) -> frozenset[str]:
        """Names with which the swarm's may not clash."""
        if self.library:
            # `robot.launch.py` starts one robot.
            return LIBRARIES[self.library].declared | {"Robot"}
        return frozenset((*(robots.member for robots in self.robots), *self.components))

    @property
    def launch(self) -> str:
        """Name of the swarm's launch file."""
        return snake_case(self.swarm_name)

    @property
    def components(self) -> tuple[str, str, str]:
        """Components of each robot: a sensor, a controller and an actuator."""
        return self.sensor, self.controller, self.actuator

    @property
    def parts(self) -> tuple[str, ...]:
        """Names of the components' parts in a robot."""
        return tuple(map(snake_case, self.components))


def check_plan(plan: Plan, report: Diagnostics) -> None:
    """Report invalid names and multiplicities."""
    check_project_name(plan.name, report)
    if plan.package in _TEMPLATE_FILES or (plan.library and plan.package in LIBRARIES):
        _report_taken(plan.name, "a project", report)
    if plan.package in _ROS_PROJECTS:
        package = f"`{plan.package}_interfaces`"
        _report_taken(plan.name, "a project", report, f"ROS has a package {package}")
    if plan.library:
        _check_swarm(plan, report)
    else:
        _check_members(plan, report)


def _check_swarm(plan: Plan, report: Diagnostics) -> None:
    """Report an invalid name of the swarm; a library has the names of all else."""
    if plan.swarm:
        check_type_name(plan.swarm, "a swarm", report)
        if plan.swarm in plan.declared:
            _report_taken(plan.swarm, "a swarm", report)


def _check_members(plan: Plan, report: Diagnostics) -> None:
    """Report invalid names and multiplicities of members, and names of components."""
    kinds = ("a sensor", "a controller", "an actuator")
    names = [(robots.member, "a member") for robots in plan.robots]
    names += zip(plan.components, kinds, strict=True)
    if plan.swarm:
        names.append((plan.swarm, "a swarm"))
    for name, kind in names:
        check_type_name(name, kind, report)
        if name in _TEMPLATE_NAMES:
            _report_taken(name, kind, report)
    for name, times in Counter(name for name, _ in names).items():
        if times > 1:
            hint = "give each member and component a different name"
            what = f"the name of {times} elements"
            report.report("bad-name", command_line_span(name), name=name, what=what, help=hint)
    for robots in plan.robots:
        if not _is_multiplicity(robots.count):
            hint = "write a multiplicity of at least one: `3`, `1..5`, `2..*` or `*`"
            what = f"the number of `{robots.member}`"
            report.report(
                "bad-name", command_line_span(robots.count), name=robots.count, what=what, help=hint
            )


def _report_taken(
    name: str,
    kind: str,
    report: Diagnostics,
    reason: str = "the template uses this name",
) -> None:
    hint = f"{reason}: choose another name"
    report.report(
        "bad-name", command_line_span(name), name=name, what=f"the name of {kind}", help=hint
    )


def _is_multiplicity(text: str) -> bool:
    found = _MULTIPLICITY.fullmatch(text)
    if found is None:
        return False
    lowest, highest = found.groups()
    if highest is None:
        return lowest is None or integer(lowest) > 0
    return highest == "*" or integer(highest) >= max(1, integer(lowest))
