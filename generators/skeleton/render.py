"""Render the view: the files of packages in each language."""

from __future__ import annotations

import json
import re
from collections.abc import Iterator
from functools import cache
from pathlib import Path

from swarmdsl.codegen import Diagnostics, OutputFile, Templates, dataclass, fits, listed
from swarmdsl.codegen.cpp import comment_line
from swarmdsl.codegen.python import docstring
from swarmdsl.codegen.ros import (
    InterfacePackage,
    definition_files,
    interface_path,
    manifest,
    yaml_key,
)
from swarmdsl.codegen.xml import legal
from swarmdsl.ir import System

from .bringup import bringup
from .bringup_files import bringup_files
from .languages import language
from .names import TARGET
from .nodes import Node, nodes
from .options import Options
from .packages import generation, packages
from .readme import tables
from .view import NodeView, node_view

_KINDS = {"msg": "message", "srv": "service", "action": "action"}
# Files of each variant by template: `{}` is the package, a leading `!` marks the user's files.
_FILES = {
    "ros1_python": {
        "CMakeLists.txt": "CMakeLists.txt",
        "setup.py": "setup.py",
        "base.py": "src/{}/base.py",
        "implementation.py": "!src/{}/implementation.py",
        "node": "scripts/{}_node",
        "test.py": "!test/test_{}.py",
    },
    "ros1_cpp": {
        "CMakeLists.txt": "CMakeLists.txt",
        "base.h": "include/{}/{}_base.h",
        "base.cpp": "src/{}_base.cpp",
        "node.cpp": "src/{}_node.cpp",
        "user.h": "!include/{}/{}.h",
        "user.cpp": "!src/{}.cpp",
        "test.cpp": "!test/{}_test.cpp",
    },
    "ros2_python": {
        "setup.py": "setup.py",
        "setup.cfg": "setup.cfg",
        "__init__.py": "{}/__init__.py",
        "base.py": "{}/base.py",
        "implementation.py": "!{}/implementation.py",
        "node.py": "{}/node.py",
        "test.py": "!test/test_{}.py",
    },
    "ros2_cpp": {
        "CMakeLists.txt": "CMakeLists.txt",
        "base.hpp": "include/{}/{}_base.hpp",
        "base.cpp": "src/{}_base.cpp",
        "node.cpp": "src/{}_node.cpp",
        "user.hpp": "!include/{}/{}.hpp",
        "user.cpp": "!src/{}.cpp",
        "test.cpp": "!test/{}_test.cpp",
    },
}
_SHARED = {1: {"launch": "launch/{}.launch"}, 2: {"launch.py": "launch/{}.launch.py"}}
_SETTINGS = {1: {"param.yaml": "param/{}.yaml"}, 2: {"config.yaml": "config/{}.yaml"}}


def emit(system: System, options: Options, report: Diagnostics) -> list[OutputFile]:
    """Return the files of the packages of nodes and interfaces."""
    found = nodes(system, options, report)
    made = packages(system, found, options, report)
    robots = bringup(system, made, options.ros, report)
    if report.has_errors or not found:
        return []
    files: list[OutputFile] = []
    for node, inside in made.nodes:
        files += _node_files(node, inside, system, options, report)
    for package in made.interfaces:
        files += _interface_files(package, options, report)
    if robots is not None:
        files += bringup_files(robots, system, options, _fill)
    return files


def _node_files(
    node: Node,
    inside: InterfacePackage | None,
    system: System,
    options: Options,
    report: Diagnostics,
) -> Iterator[OutputFile]:
    view = node_view(node, system, language(options.language, generation(options)))
    depends = _Depends(view, inside, options)
    variant = f"ros{options.ros}_{options.language}"
    facts = view.relies
    values = {
        "node": view,
        "stamp": fits(facts),
        "guard": f"{node.package}_{node.package}".upper(),
        "refused": f"{node.model} is not implemented",
        "refused_literal": json.dumps(f"{node.model} is not implemented"),
        "doc": docstring("\n".join(view.doc)),
        "tables": tables(node, view),
        "options": options,
        "depends": depends.build,
        "run_depends": depends.run,
        "interface_files": _by_kind(inside),
        "interface_depends": inside.depends if inside is not None else (),
    }
    yield OutputFile(f"{node.package}/package.xml", depends.manifest, origin=node.origin)
    templates = {
        **{f"{variant}/{name}": path for name, path in _FILES[variant].items()},
        **{f"ros{options.ros}/{name}": path for name, path in _SHARED[options.ros].items()},
    }
    own = [path.removeprefix("!") for path in templates.values() if path.startswith("!")]
    values["own"] = listed([path.replace("{}", node.package) for path in own], "and")
    templates["README.md"] = "README.md"
    if view.settings:
        for name, path in _SETTINGS[options.ros].items():
            templates[f"ros{options.ros}/{name}"] = path
    for template, path in templates.items():
        keep = path.startswith("!")
        yield OutputFile(
            f"{node.package}/{path.removeprefix('!').replace('{}', node.package)}",
            _fill(template, **values),
            executable=path.startswith("scripts/"),
            keep=keep,
            owner=node.model,
            facts=facts if keep else (),
            origin=node.origin,
        )
    if variant == "ros2_python":
        path = f"{node.package}/resource/{node.package}"
        yield OutputFile(path, "", owner=node.model, origin=node.origin)
    if inside is not None:
        yield from definition_files(inside, generation(options), TARGET, report)


@dataclass(frozen=True)
class _Depends:
    """Dependencies of the package of a node."""

    view: NodeView
    inside: InterfacePackage | None
    options: Options

    @property
    def run(self) -> list[str]:
        """Dependencies at run time."""
        python = self.options.language == "python"
        if self.options.ros == 2:
            found = {"rclpy" if python else "rclcpp", *self.view.depends}
            found |= {"rcl_interfaces"} if self.view.settings else set()
            return sorted(found | ({"rclcpp_action"} if self.view.action and not python else set()))
        found = {"rospy" if python else "roscpp", *self.view.depends}
        if self.view.action is not None:
            found |= {"actionlib", "actionlib_msgs"}
        if self.inside is not None:
            found |= {"message_runtime", *self.inside.depends}
        return sorted(found)

    @property
    def build(self) -> list[str]:
        """Dependencies that CMake finds."""
        found = set(self.run) - {"message_runtime"}
        return sorted(found | ({"message_generation"} if self.inside is not None else set()))

    @property
    def manifest(self) -> str:
        region = f"{self.view.model}.dependencies"
        if self.options.ros == 2:
            python = self.options.language == "python"
            type_ = "ament_python" if python else "ament_cmake"
            tags = [] if python else [("buildtool_depend", "ament_cmake")]
            tags += (("depend", name) for name in self.run)
            tags += (("exec_depend", name) for name in ("launch", "launch_ros"))
            tags += [("test_depend", "python3-pytest" if python else "ament_cmake_gtest")]
            return manifest(
                self.view.package,
                self.view.summary,
                tags,
                self.options,
                format_=3,
                build_type=type_,
                region=region,
            )
        tags = [("buildtool_depend", "catkin")]
        if self.options.language == "python":
            tags.append(("buildtool_depend", "python3-setuptools"))
        if self.inside is not None:
            tags.append(("build_depend", "message_generation"))
        tags += (
            ("exec_depend" if name == "message_runtime" else "depend", name) for name in self.run
        )
        return manifest(
            self.view.package, self.view.summary, tags, self.options, format_=2, region=region
        )


def _interface_files(
    package: InterfacePackage, options: Options, report: Diagnostics
) -> Iterator[OutputFile]:
    """Yield the files of an interface package."""
    at = package.interfaces[0].origin
    text = _fill(
        f"interfaces/ros{options.ros}",
        package=package,
        interface_files=_by_kind(package),
        interface_depends=package.depends,
        interface_paths=[interface_path(interface) for interface in package.interfaces],
    )
    yield OutputFile(f"{package.name}/CMakeLists.txt", text, origin=at)
    tags = [
        ("buildtool_depend", "catkin"),
        ("build_depend", "message_generation"),
        *(("depend", name) for name in package.depends),
        ("exec_depend", "message_runtime"),
    ]
    if options.ros == 2:
        tags = [
            ("buildtool_depend", "ament_cmake"),
            ("buildtool_depend", "rosidl_default_generators"),
            *(("depend", name) for name in package.depends),
            ("exec_depend", "rosidl_default_runtime"),
            ("member_of_group", "rosidl_interface_packages"),
        ]
    doc = f"Interfaces of {package.name}."
    build_type = "ament_cmake" if options.ros == 2 else ""
    text = manifest(
        package.name,
        doc,
        tags,
        options,
        format_=3 if options.ros == 2 else 2,
        build_type=build_type,
    )
    yield OutputFile(f"{package.name}/package.xml", text, origin=at)
    yield from definition_files(package, generation(options), TARGET, report)


def _by_kind(package: InterfacePackage | None) -> list[tuple[str, list[str]]]:
    """Return the interface files of a package by kind, for the macros of catkin."""
    found: dict[str, list[str]] = {}
    for interface in package.interfaces if package is not None else ():
        folder, _, file = interface_path(interface).partition("/")
        found.setdefault(_KINDS[folder], []).append(file)
    return list(found.items())


def _fill(template: str, **values: object) -> str:
    return _templates().fill(f"{template}.j2", **values)


@cache
def _templates() -> Templates:
    folder = Path(__file__).parent / "templates"
    filters = (comment_line, docstring, xml_comment, yaml_key)
    return Templates(folder, **{each.__name__: each for each in filters})


def xml_comment(text: str) -> str:
    """Return a text that a comment of XML can hold."""
    return re.sub("-(?=-)", "- ", legal(text))
