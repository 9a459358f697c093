"""Packages in C++ are built by catkin, with all warnings as errors."""

from __future__ import annotations

import subprocess
from pathlib import Path
from typing import Any

_NEEDED = (
    "/usr/bin/catkin_make",
    "/usr/include/ros/ros.h",
    "/usr/include/actionlib/action_definition.h",
)
_CPP = "-Wall -Wextra -Werror"


def missing_of_catkin() -> str | None:
    """Return the reason that catkin cannot build C++ here, None where it can."""
    missing = next((path for path in _NEEDED if not Path(path).exists()), None)
    if missing is None:
        return None
    return (
        f"no catkin for C++ ({missing} is missing): apt-get install catkin g++ cmake libroscpp-dev"
        " libactionlib-dev libgtest-dev ros-message-generation ros-message-runtime"
    )


def make(graph: Any, folder: Path, *targets: str, optimisation: str = "-O1") -> None:
    """Build targets of a workspace; it has to succeed."""
    command = [
        *("catkin_make", "-C", str(folder), "-l99", "-DPYTHON_EXECUTABLE=/usr/bin/python3"),
        f"-DCMAKE_CXX_FLAGS={_CPP} {optimisation}",
        *targets,
    ]
    environment = {**graph.environment(), "HOME": str(graph.home), "PWD": str(folder)}
    del environment["ROS_DISTRO"]  # catkin_make finds another in Debian's setup
    run = subprocess.run(
        command, cwd=folder, env=environment, capture_output=True, text=True, check=False
    )
    assert run.returncode == 0, run.stdout[-3000:] + run.stderr[-3000:]
