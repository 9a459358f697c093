"""Package that starts the functions and components of members, and connects them."""

from __future__ import annotations

from collections.abc import Mapping

from swarmdsl.codegen import (
    Diagnostics,
    Label,
    Span,
    dataclass,
    fresh,
    incoming_topic,
    is_ros_package_name,
    snake_case,
)
from swarmdsl.codegen.python import comment_lines, file_name
from swarmdsl.codegen.ros import yaml_value
from swarmdsl.codegen.shared import (
    Remaps,
    Wiring,
    bringup_package,
    check_wiring,
    has_node,
    member_functions,
    member_wiring,
    params_by_name,
)
from swarmdsl.ir import Part, System

from .names import TARGET
from .nodes import Node
from .packages import Packages
from .settings import value_of


@dataclass(frozen=True)
class Started:
    """The node of a part or function: its package, params as YAML, and remapped topics."""

    name: str
    package: str
    kind: str
    has_settings: bool
    values: tuple[tuple[str, str], ...]
    remaps: Remaps
    doc: tuple[str, ...]
    origin: Span | None


@dataclass(frozen=True)
class Robot:
    """A robot type with the nodes of its functions and parts."""

    name: str
    member: str
    nodes: tuple[Started, ...]
    doc: tuple[str, ...]
    origin: Span | None

    @property
    def has_values(self) -> bool:
        """True if the model has values for params of parts."""
        return any(node.values for node in self.nodes)


@dataclass(frozen=True)
class Bringup:
    """The package with a launch file for each robot type."""

    package: str
    header: str
    robots: tuple[Robot, ...]

    @property
    def depends(self) -> list[str]:
        """Packages of the nodes that are started."""
        return sorted({node.package for robot in self.robots for node in robot.nodes})

    @property
    def has_values(self) -> bool:
        """True if the model has values for params of any part."""
        return any(robot.has_values for robot in self.robots)


def bringup(system: System, made: Packages, ros: int, report: Diagnostics) -> Bringup | None:
    """Return the package that starts the nodes; None if no member has any.

    The package exists even if none of the nodes is written, because launch files of behaviours
    include its launch files.
    """
    written = {node.model: node for node, _ in made.nodes if node.kind == "component"}
    functions = {node.model: node for node, _ in made.nodes if node.kind == "function"}
    components = system.components_by_name
    robots = []
    for member in system.members:
        parts = [part for part in member.parts if has_node(components[part.component])]
        # In ROS 1, launch files of behaviours include this package unasked, whatever is beside it.
        called = member_functions(member, system) if ros == 2 else []
        if not parts and not called:
            continue
        wired = member_wiring(member, system)
        check_wiring(wired, TARGET, report)
        if ros == 2:
            _check_crossing(wired, system, report)
        started = tuple(
            _started(part, written[part.component], wired, ros, report)
            for part in parts
            if part.component in written
        )
        names = [part.name for part in member.parts]
        for name in called:
            if name in functions:
                started += (_function(functions[name], fresh(functions[name].package, names)),)
        doc = tuple(comment_lines(member.doc)) or (f"The nodes of one {member.name}.",)
        robots.append(Robot(snake_case(member.name), member.name, started, doc, member.origin))
    if not robots:
        return None
    name = bringup_package(system)
    packages = {package.name: package.interfaces[0].origin for package in made.interfaces}
    packages.update((node.package, node.origin) for node, _ in made.nodes)
    _check_name(name, system.origin, packages, report)
    return Bringup(name, _header(system), tuple(robots))


def _check_crossing(wired: Wiring, system: System, report: Diagnostics) -> None:
    """Report ports on topics of swarm events, which have no bridge in ROS 2."""
    between = {event.topic for event in system.events if event.swarm}
    heard = incoming_topic("", swarm=True)
    for ref, port in wired.ports.items():
        if ref.part is None:
            continue
        topic = wired.topic(ref)
        others = "listen" if port.direction != "in" and topic in between else ""
        if port.direction != "out" and topic.startswith(heard):
            others = "send"
        if others:
            report.report(
                "no-place",
                port.origin,
                target=TARGET,
                what=f"a port between robots, `{ref}` on `{topic}`",
                notes=(f"in ROS 2 this is a local topic; other robots {others} on another one",),
                help="use a behaviour to send and receive events between robots",
            )


def _started(part: Part, node: Node, wired: Wiring, ros: int, report: Diagnostics) -> Started:
    settings = {setting.key: setting for setting in node.settings}
    known = params_by_name(wired.member.params)
    values = []
    for name, expression in part.values:
        if name not in settings:
            continue
        value = value_of(expression, settings[name].type, known, ros, report)
        if value is not None:
            values.append((name, yaml_value(value)))
    return Started(
        part.name,
        node.package,
        "components",
        bool(node.settings),
        tuple(values),
        wired.remaps(part.name),
        tuple(comment_lines(part.doc)),
        part.origin,
    )


def _function(node: Node, name: str) -> Started:
    doc = tuple(comment_lines(node.doc))
    return Started(name, node.package, "functions", bool(node.settings), (), (), doc, node.origin)


def _check_name(
    name: str, origin: Span | None, packages: Mapping[str, Span | None], report: Diagnostics
) -> None:
    """Check that the name is valid in ROS, and that no other written package has it."""
    if name in packages:
        at = packages[name]
        related = (Label(at, "the other package is for this element"),) if at is not None else ()
        use = "the package that starts components: another package has this name"
        report.report("bad-identifier", origin, target=TARGET, name=name, use=use, related=related)
    elif not is_ros_package_name(name):
        use = "the name of a ROS package"
        report.report("bad-identifier", origin, target=TARGET, name=name, use=use)


def _header(system: System) -> str:
    files = dict.fromkeys(file_name(m.origin) for m in system.members if m.origin is not None)
    return f"Generated by swarmc from {', '.join(files) or system.name}; do not edit."
