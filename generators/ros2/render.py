"""Render the view: the files of the packages."""

from __future__ import annotations

from collections.abc import Iterator
from functools import cache
from pathlib import Path
from textwrap import wrap

from swarmdsl.codegen import Diagnostics, MappedText, OutputFile, Templates, fits
from swarmdsl.codegen.ros import InterfacePackage, definition_files, interface_path, manifest
from swarmdsl.ir import System

from ..runtime_source import runtime_source
from .engine import engine_source, monitors_source
from .imports import WIDTH
from .launch import configuration
from .monitors import WatchedSwarm
from .names import TARGET
from .network_files import network_files
from .options import NodeOptions, Options
from .served import MODULES
from .view import MachineView, PackageView, Variant, package_view

_RUNTIME = Path(__file__).parent / "runtime"
_MODULES = (
    "alarms",
    "diagnostics",
    "functions",
    "host",
    "identity",
    "members",
    "models",
    "parameters",
    "topics",
    "tracing",
    "values",
)
_OF_LAUNCHES = ("launched_nodes", "launching", "robots")
_OF_WATCHDOGS = ("lease", "watchdog")
_OF_COMPOSED = ("container",)
_OF_MONITORS = (
    *("robot_lines", "swarm_measures", "swarm_monitor", "swarm_verdicts", "swarm_watch"),
)


def emit(system: System, options: NodeOptions, report: Diagnostics) -> list[OutputFile]:
    """Return the files of the package with the behaviour, and of interface packages."""
    if options.composed and options.network == "domains":
        fault = "robots in one process share a domain: `composed` goes without `network=domains`"
        report.report("bad-option", None, target=TARGET, fault=fault)
        return []
    variant = Variant(is_composed=options.composed)
    package = package_view(system, options, report, variant)
    if package is None:
        return []
    interfaces = [interface_files(each, options, report) for each in package.interfaces]
    return [*files(package, options), *(file for each in interfaces for file in each)]


def tables(
    package: PackageView, options: Options, *parameters: tuple[str, str, str]
) -> dict[str, MappedText]:
    """Return the tables of launch files and nodes of a README, with further parameters of nodes.

    A parameter has its name, its default and what it is.
    """
    values = {"package": package, "options": options, "parameters": parameters}
    return {name: _fill(f"package/{name}.md", **values) for name in ("launches", "nodes")}


def interface_files(
    package: InterfacePackage, options: Options, report: Diagnostics
) -> Iterator[OutputFile]:
    """Yield the files of an interface package."""
    yield from definition_files(package, 2, TARGET, report)
    at = package.interfaces[0].origin
    paths = [interface_path(interface) for interface in package.interfaces]
    text = _fill("interfaces/CMakeLists.txt", package=package, files=paths)
    yield OutputFile(f"{package.name}/CMakeLists.txt", text, origin=at)
    depends = [
        ("buildtool_depend", "ament_cmake"),
        ("buildtool_depend", "rosidl_default_generators"),
        *(("depend", name) for name in package.depends),
        ("exec_depend", "rosidl_default_runtime"),
        ("member_of_group", "rosidl_interface_packages"),
    ]
    doc = f"Interfaces of {package.name}."
    about = manifest(package.name, doc, depends, options, format_=3, build_type="ament_cmake")
    yield OutputFile(f"{package.name}/package.xml", about, origin=at)


def files(package: PackageView, options: Options) -> Iterator[OutputFile]:
    """Yield the files of the package with the behaviour."""
    root = package.name
    legal = legal_head(options)
    values = {"package": package, "options": options, "legal": legal}
    head = f"{legal}# {package.header}"
    yield OutputFile(f"{root}/package.xml", package.manifest)
    for name in ("setup.py", "setup.cfg", "README.md"):
        filled = _fill(f"package/{name}", header=head, parameters=(), **values)
        yield OutputFile(f"{root}/{name}", filled)
    yield OutputFile(f"{root}/resource/{root}", "")
    yield OutputFile(f"{root}/{root}/__init__.py", "")
    yield OutputFile(f"{root}/{root}/engine.py", f"{head}\n{engine_source()}")
    for module in _MODULES:
        text = runtime_source(_RUNTIME / f"{module}.py", head)
        yield OutputFile(f"{root}/{root}/{module}.py", text)
    model = {"NAME": package.system, "VERSION": options.version, "DIGEST": package.digest}
    text = runtime_source(_RUNTIME / "model.py", head, **model)
    yield OutputFile(f"{root}/{root}/model.py", text)
    node = _fill("package/package/node.py", header=head, lifecycle=options.lifecycle, **values)
    yield OutputFile(f"{root}/{root}/node.py", node)
    if package.callbacks:
        facts = tuple(f"{name}({parameters})" for name, parameters in package.callbacks)
        text = _fill("package/package/callbacks.py", stamp=fits(facts), **values)
        yield OutputFile(f"{root}/{root}/callbacks.py", text, keep=True, owner=root, facts=facts)
    for machine in package.machines:
        yield _machine(machine, package, legal)
    for served in package.served:
        text = _fill(f"package/package/{served.executable}.py", node=served, header=head)
        path = f"{root}/{root}/{served.executable}.py"
        yield OutputFile(path, text.rewritten(WIDTH, narrowed), origin=served.origin)
        for module in MODULES:
            text = runtime_source(_RUNTIME / f"{module}.py", head)
            yield OutputFile(f"{root}/{root}/{module}.py", text)
    if package.monitors:
        yield OutputFile(f"{root}/{root}/property_monitors.py", f"{head}\n{monitors_source()}")
        for module in _OF_MONITORS:
            text = runtime_source(_RUNTIME / f"{module}.py", head)
            yield OutputFile(f"{root}/{root}/{module}.py", text)
    for monitor in package.monitors:
        yield _monitor(monitor, package, head)
    for test in ("copyright", "machines"):
        text = _fill(f"package/test/test_{test}.py", header=head, **values)
        yield OutputFile(f"{root}/test/test_{test}.py", text)
    for test in ("flake8", "pep257"):
        text = runtime_source(_RUNTIME / "test" / f"test_{test}.py", head)
        yield OutputFile(f"{root}/test/test_{test}.py", text)
    if package.launches:
        text = _fill("package/launch/robot.launch.py", header=head, **values)
        yield OutputFile(f"{root}/launch/robot.launch.py", text)
        watching = _OF_WATCHDOGS if package.has_watchdogs else ()
        composing = _OF_COMPOSED if package.variant.is_composed else ()
        for module in (*_OF_LAUNCHES, *watching, *composing):
            text = runtime_source(_RUNTIME / f"{module}.py", head)
            yield OutputFile(f"{root}/{root}/{module}.py", text)
        yield from _started(package, options, values, head)
    yield from _networks(package, options)
    monitors = {monitor.launch: monitor.module for monitor in package.monitors}
    for launch in package.launches:
        text = _fill(
            "package/launch/swarm.launch.py",
            header=head,
            launch=launch,
            monitor=monitors.get(launch.name),
            lifecycle=options.lifecycle,
            **values,
        )
        yield OutputFile(f"{root}/launch/{launch.name}.launch.py", text, origin=launch.origin)
        for role in launch.roles:
            about = (package.header, f"Params of {role.member} in role {role.name}.")
            path = f"{root}/config/{launch.name}/{role.name}"
            text = configuration(role.nodes, about)
            yield OutputFile(f"{path}.yaml", text, origin=launch.origin)
            for number, nodes in role.robots.items():
                about = (package.header, f"Params of {role.name}[{number}], from the model.")
                text = configuration(nodes, about)
                yield OutputFile(f"{path}_{number}.model.yaml", text, origin=launch.origin)
            for number in range(min(role.least, _MOST_FILES)):
                text = _fill("package/config/instance.yaml", role=role, number=number)
                own = f"{path}_{number}.yaml"
                yield OutputFile(own, text, keep=True, owner=role.name, origin=launch.origin)


def _started(
    package: PackageView, options: Options, values: dict[str, object], head: str
) -> Iterator[OutputFile]:
    """Yield the files that start robots without a person, as the options say."""
    root = package.name
    if options.systemd:
        text = _fill("package/deploy/robot.service", header=head, **values)
        yield OutputFile(f"{root}/deploy/{root}@.service", text)
        launched = {launch.name: launch for launch in package.launches}
        for monitor in package.monitors:
            of_swarm = {"launch": launched[monitor.launch], "monitor": monitor}
            text = _fill("package/deploy/monitor.service", header=head, **of_swarm, **values)
            yield OutputFile(f"{root}/deploy/{root}_{monitor.module}.service", text)
    if options.compose:
        text = _fill("package/deploy/compose.yaml", header=head, most=_MOST_FILES, **values)
        yield OutputFile(f"{root}/deploy/compose.yaml", text)
        text = _fill("package/deploy/Dockerfile", header=head, **values)
        yield OutputFile(f"{root}/deploy/Dockerfile", text)


def _networks(package: PackageView, options: Options) -> Iterator[OutputFile]:
    origins = {launch.name: launch.origin for launch in package.launches}
    for network in package.networks:
        folder = f"{package.name}/config/{network.swarm}/network"
        for name, text in network_files(network, options, package.header, _fill):
            yield OutputFile(f"{folder}/{name}", text, origin=origins[network.swarm])


def _machine(machine: MachineView, package: PackageView, legal: str) -> OutputFile:
    head = f"{legal}# {machine.header}"
    text = _fill("package/package/machine.py", machine=machine, package=package, header=head)
    return OutputFile(
        f"{package.name}/{package.name}/{machine.module}.py",
        text.rewritten(WIDTH, narrowed),
        origin=machine.origin,
    )


def _monitor(monitor: WatchedSwarm, package: PackageView, head: str) -> OutputFile:
    text = _fill("package/package/monitor.py", monitor=monitor, header=head)
    return OutputFile(
        f"{package.name}/{package.name}/{monitor.module}.py",
        text.rewritten(WIDTH, narrowed),
        origin=monitor.origin,
    )


def narrowed(line: str) -> list[str]:
    """Return a line that is too long as shorter lines of comment, or marked for the linter."""
    stripped = line.lstrip()
    indent = line[: len(line) - len(stripped)]
    if stripped.startswith("#"):
        return [f"{indent}# {part}" for part in wrap(stripped[1:], WIDTH - len(indent) - 2)]
    return [f"{line}  # noqa: E501"]


def legal_head(options: Options) -> str:
    """Return the copyright notice at the head of a file, empty without option `copyright`."""
    if not options.copyright:
        return ""
    template = "package/apache.txt" if options.license == "Apache-2.0" else "package/other.txt"
    return _fill(template, options=options)


_MOST_FILES = 100
"""Number of members of a role up to which each has its own file of parameters."""


def _fill(template: str, **values: object) -> MappedText:
    return _templates().fill(f"{template}.j2", **values)


@cache
def _templates() -> Templates:
    return Templates(Path(__file__).parent / "templates")
