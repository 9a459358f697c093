"""A generated launch file, run by the real `launch`, which is in no package index.

It runs where the Python of ROS 2 has `launch`, or SWARMDSL_LAUNCH_PATH names the folders of
`launch`, `launch_ros` and what they import.
"""

from __future__ import annotations

import contextlib
import os
import signal
import subprocess
import time
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

LAUNCH = """
import sys
from launch import LaunchDescription, LaunchService
from launch.actions import IncludeLaunchDescription
from launch.launch_description_sources import PythonLaunchDescriptionSource
path, *given = sys.argv[1:]
arguments = [tuple(each.split(":=")) for each in given]
swarm = IncludeLaunchDescription(PythonLaunchDescriptionSource(path), launch_arguments=arguments)
service = LaunchService()
service.include_launch_description(LaunchDescription([swarm]))
sys.exit(service.run())
"""
MEMBERS = [*(f"rover[{n}]" for n in range(2)), *(f"uav[{n}]" for n in range(3))]


@pytest.fixture
def launching(ros: Any) -> None:
    """Let processes of ROS import the real `launch`."""
    named = os.environ.get("SWARMDSL_LAUNCH_PATH")
    if named is not None:
        for place in reversed(named.split(os.pathsep)):
            ros.prefer(Path(place))
    found = subprocess.run(
        [ros.python, "-c", "import launch_ros.actions"], env=ros.environment, capture_output=True
    )
    if found.returncode != 0:
        pytest.skip("no real launch: SWARMDSL_LAUNCH_PATH names the folders of it")


@pytest.mark.usefixtures("launching")
def test_launch_starts_a_swarm(ros: Any, variant: Callable[..., Path], tmp_path: Path) -> None:
    package = variant("examples/search_and_rescue")
    colcon = [ros.python.parent / "colcon", "build", "--base-paths", package]
    subprocess.run(colcon, cwd=tmp_path, env=ros.environment, capture_output=True, check=True)
    prefix = tmp_path / "install" / package.name
    ros.prefer(next(prefix.glob("lib/python3.*/site-packages")))
    paths = [str(prefix), ros.environment["AMENT_PREFIX_PATH"]]
    ros.environment["AMENT_PREFIX_PATH"] = os.pathsep.join(paths)
    traces = tmp_path / "traces"
    traces.mkdir()
    file = prefix / "share" / package.name / "launch" / "search_and_rescue.launch.py"
    words = [f"trace_dir:={traces}", "rover_count:=2"]
    log = tmp_path / "launch.txt"
    with log.open("w") as stream:
        process = ros.start(
            *("-c", LAUNCH, file, *words),
            stdout=stream,
            stderr=subprocess.STDOUT,
            start_new_session=True,
        )

    end = time.monotonic() + 60
    try:
        while log.read_text().count("start -> ") < len(MEMBERS):
            assert time.monotonic() < end, log.read_text()
            assert process.poll() is None, log.read_text()
            time.sleep(0.05)
        os.killpg(process.pid, signal.SIGINT)  # as a terminal does
        assert process.wait(60) == 0, log.read_text()
    finally:
        with contextlib.suppress(ProcessLookupError):
            os.killpg(process.pid, signal.SIGKILL)
    written = {path.stem: path.read_text() for path in traces.iterdir()}
    assert sorted(written) == MEMBERS, log.read_text()
    assert all('"event": "node.shutdown"' in text for text in written.values())
