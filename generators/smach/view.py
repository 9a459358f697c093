"""View of the package for the templates, with a module and a node for each machine."""

from __future__ import annotations

from swarmdsl.codegen import Diagnostics, Picture, chosen_machines, dataclass, pictures
from swarmdsl.codegen.ros import (
    InterfacePackage,
    check_described,
    group_by_package,
    interfaces_to_write,
    is_fully_described,
    manifest,
    third_party_packages,
)
from swarmdsl.codegen.shared import check_watchdogs, envelopes_of, missing_values
from swarmdsl.ir import System

from ..gazebo.render import report_left_out
from . import names, package
from .events import EventView, checked_events, event_views
from .imports import Imports, ros_types
from .launch import world_file
from .machine_view import MachineView, header, machine_view
from .module import TARGET
from .names import NAMES
from .options import Options
from .robots import Components, Fleet, Robot, fleets, robots


@dataclass(frozen=True)
class PackageView:
    """The whole package."""

    name: str
    doc: str
    header: str
    machines: tuple[MachineView, ...]
    events: tuple[EventView, ...]
    event_imports: tuple[str, ...]
    callbacks: tuple[tuple[str, str], ...]
    interfaces: tuple[InterfacePackage, ...]
    manifest: str
    pictures: tuple[Picture, ...]
    missing_values: str
    modules: tuple[str, ...]
    needs: tuple[str, ...]
    described: tuple[str, ...]
    timeouts: dict[str, int]
    robots: tuple[Robot, ...]
    fleets: tuple[Fleet, ...]
    simulation: bool

    @property
    def components(self) -> Components | None:
        """The package that starts the components of robots; None if they need no nodes."""
        found = (robot.components for robot in self.robots)
        return next((each for each in found if each is not None), None)

    @property
    def simulations(self) -> list[str]:
        """The launch files that simulate a swarm."""
        worlds = [fleet for fleet in self.fleets if self.simulation and world_file(fleet)]
        return [f"{fleet.name}_simulation" for fleet in worlds]

    @property
    def folders(self) -> list[str]:
        """The folders that are installed."""
        return ["launch", "param", *(["world"] if self.simulations else [])]

    @property
    def kept(self) -> list[tuple[str, str]]:
        """The user's files, and their purposes."""
        found = []
        if self.callbacks:
            found.append((f"src/{self.name}/callbacks.py", "callbacks that the model names"))
        for fleet in self.fleets:
            about = f"params of single robots of swarm `{fleet.swarm.name}`"
            found.append((f"param/{fleet.name}/*.yaml", about))
            if self.simulation and (world := world_file(fleet)):
                found.append((f"world/{world}", "the world that Gazebo simulates"))
        return found


def package_view(system: System, options: Options, report: Diagnostics) -> PackageView | None:
    """Return the view of a system, or None if no machine needs a node."""
    machines = chosen_machines(system)
    if not machines:
        return None
    name = NAMES.package(system, options.package, report)
    modules = NAMES.of_modules(machines, report)
    around = envelopes_of(system)
    written = [*interfaces_to_write(system, options.interfaces), *around.values()]
    interfaces = group_by_package(written, 1)
    check_described(system, options.interfaces, NAMES.target, report)
    check_watchdogs(
        system,
        frozenset(),
        NAMES.target,
        report,
        "nodes of ROS 1 have no watchdog",
        "build it for ROS 2, or let another program watch the node",
    )
    NAMES.check_interfaces(system, interfaces, name, report)
    used = package.used_types(system, machines)
    events = checked_events(system, machines, report)
    constants = names.event_constants(events, (type_.name for type_, _ in used), report)
    if report.has_errors:
        return None
    types = ros_types(name, constants.values(), used)
    callbacks: dict[str, str] = {}
    views = [
        machine_view(system, machine, modules[machine.name], types, constants, callbacks, report)
        for machine in machines
    ]
    doc = system.doc or f"Behaviour of {system.name}."
    event_imports = Imports(types)
    shown_events = event_views(events, around, constants, event_imports)
    launched = {machine.name for machine in machines}
    made = robots(system, launched, options.components, report)
    bringup = {each.components.package for each in made if each.components is not None}
    depends = [
        ("buildtool_depend", "catkin"),
        ("buildtool_depend", "python3-setuptools"),
        *(("exec_depend", needed) for needed in package.dependencies(used)),
        *([("exec_depend", "roslaunch"), ("test_depend", "rostest")] if made else []),
        *([("exec_depend", "gazebo_ros")] if made and options.simulation else []),
        *(("exec_depend", each) for each in bringup if options.components),
    ]
    started = tuple(fleets(system, made, report))
    for fleet in started if options.simulation else ():
        if fleet.environment is not None and (file := world_file(fleet)):
            names.check_world(fleet.environment, file, report)
            report_left_out(fleet.environment, TARGET, report)
    if report.has_errors:
        return None
    needs = third_party_packages((type_ for type_, _ in used), interfaces, system)
    return PackageView(
        name=name,
        doc=doc,
        header=header(system, (machine.origin for machine in machines)),
        machines=tuple(views),
        events=shown_events,
        event_imports=tuple(event_imports.lines()),
        callbacks=tuple(callbacks.items()),
        interfaces=interfaces,
        manifest=manifest(name, doc, depends, options, format_=2),
        pictures=pictures(system, machines),
        missing_values=missing_values(system),
        modules=(
            "chart",
            "containers",
            "identity",
            "node",
            "states",
            "topics",
            *package.activity_modules(used),
        ),
        needs=tuple(needs),
        described=tuple(each for each in needs if is_fully_described(system, each)),
        timeouts=options.timeouts,
        robots=tuple(made),
        fleets=started,
        simulation=options.simulation,
    )
