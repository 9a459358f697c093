"""Use of a generated package: build, test, manage its nodes, edit."""

from __future__ import annotations

import os
import signal
import subprocess
import time
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

HERE = Path(__file__).resolve().parent
Variant = Callable[..., Path]
WORK = ("/lab/work", "lab_msgs/action/Work")
ASK = ("/lab/ask", "lab_msgs/srv/Ask")
CHANGE = ("/lab/lab/change_state", "lifecycle_msgs/srv/ChangeState")
GET = ("/lab/lab/get_state", "lifecycle_msgs/srv/GetState")
CONFIGURE, CLEAN_UP, ACTIVATE, DEACTIVATE = 1, 2, 3, 4


def test_colcon_builds_and_tests_it(ros: Any, variant: Variant, tmp_path: Path) -> None:
    model, holder = "examples/search_and_rescue", "2026 Example Robotics"
    package = variant(model, copyright=holder)
    in_smach = variant(model, target="smach", ros="2", package="sar_smach", copyright=holder)
    for stand_in in (HERE.parent / "smach" / "stand_in", HERE / "smach_stand_in"):
        ros.prefer(stand_in)
    bin_ = ros.python.parent
    environment = {**ros.environment, "PATH": f"{bin_}{os.pathsep}{os.environ['PATH']}"}

    def colcon(*arguments: str) -> str:
        ran = subprocess.run(
            [bin_ / "colcon", *arguments],
            cwd=tmp_path,
            env=environment,
            capture_output=True,
            text=True,
            check=False,
        )
        assert ran.returncode == 0, ran.stdout + ran.stderr
        return ran.stdout

    here = ("--base-paths", str(package), str(in_smach))
    colcon("build", *here)
    colcon("test", *here)
    # ament_copyright is in no package index.
    assert "12 tests, 0 errors, 0 failures, 2 skipped" in colcon("test-result", "--all")

    nodes = [_installed(ros, tmp_path / "install", name) for name in ("sar_behavior", "sar_smach")]
    for node, trace in nodes:
        end = time.monotonic() + 60
        while not (trace.exists() and trace.read_text()) and time.monotonic() < end:
            assert node.poll() is None
            time.sleep(0.05)
        node.terminate()
        assert node.wait(20) == 0
        assert '"Mission.Idle"' in trace.read_text()


def _installed(ros: Any, folder: Path, package: str) -> tuple[subprocess.Popen[str], Path]:
    """Start a node of a package that is installed there, which writes a trace."""
    prefix = folder / package
    share = prefix / "share" / package
    assert (share / "launch" / "search_and_rescue.launch.py").exists()
    assert (share / "config" / "search_and_rescue" / "uav_0.yaml").exists()
    assert (prefix / "share" / "ament_index" / "resource_index" / "packages").is_dir()
    (site,) = prefix.glob("lib/python3.*/site-packages")
    ros.prefer(site)
    trace = folder / f"{package}.jsonl"
    node = ros.start(
        prefix / "lib" / package / "uav_search",
        *("--ros-args", "--params-file"),
        share / "config" / "search_and_rescue" / "uav.yaml",
        *("-p", f"trace.file:={trace}"),
    )
    return node, trace


class Managed:
    """A managed node of the lab, and whoever manages it."""

    def __init__(self, ros: Any, package: Path, stopping: float = 0.2, **parameters: Any) -> None:
        ros.prefer(package)
        self.fakes = ros.fakes()
        self.fakes.action(*WORK, "never", stopping=stopping)
        self.fakes.service(*ASK)
        self.fakes.publisher("/go", "lab_msgs/msg/Order")
        self.node = ros.node("lab_behavior.lab", "/lab", **parameters)

    def change(self, transition: int) -> bool:
        response = self.fakes.call(*CHANGE, transition={"id": transition})
        return bool(response["success"])

    def state(self) -> str:
        return str(self.fakes.call(*GET)["current_state"]["label"])

    def work(self, count: int) -> None:
        self.fakes.listeners("/go")
        self.fakes.publish("/go", name="box", speed=1.0)
        self.fakes.wait("goal", WORK[0], count)


def test_a_managed_node(ros: Any, variant: Variant) -> None:
    managed = Managed(ros, variant("tests/ros2/models", lifecycle="true"))
    assert managed.state() == "unconfigured"
    assert managed.change(CONFIGURE)
    assert managed.node.trace == []
    assert managed.change(ACTIVATE)
    managed.node.wait_in("Idle")
    managed.work(1)
    assert managed.change(DEACTIVATE)
    managed.fakes.wait("stopped", WORK[0])
    assert "work" in managed.node.wait_for("node.shutdown")["cancelled"]
    assert managed.state() == "inactive"

    assert managed.change(ACTIVATE)
    managed.work(2)
    assert managed.change(DEACTIVATE)
    assert managed.change(CLEAN_UP)
    assert managed.state() == "unconfigured"
    assert managed.node.terminate() == 0
    # A trace is of one life of a machine; here it has two.
    ros.nodes.remove(managed.node)
    managed.node.log_stream.close()


def test_a_managed_node_may_start_itself(ros: Any, variant: Variant) -> None:
    package = variant("tests/ros2/models", lifecycle="true")
    managed = Managed(ros, package, lifecycle__autostart=True)

    managed.node.wait_in("Idle")
    assert managed.state() == "active"
    managed.work(1)
    assert managed.node.terminate() == 0
    managed.fakes.wait("stopped", WORK[0])


def test_a_managed_node_that_is_deactivated_while_it_ends(ros: Any, variant: Variant) -> None:
    """It ends as soon as its server has stopped: nobody who waits for that is forgotten."""
    package = variant("tests/ros2/models", lifecycle="true")
    settings = {"lifecycle__autostart": True, "timeouts__cancel": 300.0}
    managed = Managed(ros, package, stopping=2.0, **settings)
    managed.node.wait_in("Idle")
    managed.work(1)
    managed.node.process.send_signal(signal.SIGTERM)
    managed.node.wait_for("node.shutdown")
    assert managed.change(DEACTIVATE)
    managed.fakes.wait("stopped", WORK[0])

    assert managed.node.exit_code() == 0


def test_callbacks_are_the_users(ros: Any, variant: Variant) -> None:
    package = variant("tests/ros2/models")
    (package / "lab_behavior" / "callbacks.py").write_text(
        "def next_goal(data, goal):\n"
        "    goal.name = f'{data.name} again'\n"
        "    data.left = 7\n"
        "\n"
        "\n"
        "def read_result(data, result):\n"
        "    raise SystemExit(f'no use for {result.count}')\n"
    )
    ros.prefer(package)
    fakes = ros.fakes()
    fakes.action(*WORK, "succeeded", {"outcome": "succeeded", "result": {"count": 5}})
    fakes.action("/lab/other_work", "lab_msgs/action/Work", "never")
    fakes.service(*ASK)
    fakes.publisher("/go", "lab_msgs/msg/Order")
    node = ros.node("lab_behavior.lab", "/lab")
    fakes.listeners("/go")
    fakes.publish("/go", name="box", speed=1.0)

    assert fakes.wait("goal", WORK[0], 2)["data"]["name"] == "box again"
    # What goes wrong in a callback is told, and the machine goes on.
    node.wait_in("Rest")
    assert "SystemExit: no use for 5" in node.log
    assert node.terminate() == 0


def test_a_callback_that_is_missing(ros: Any, variant: Variant) -> None:
    package = variant("tests/ros2/models")
    (package / "lab_behavior" / "callbacks.py").write_text("")
    ros.prefer(package)
    node = ros.node("lab_behavior.lab", "/lab")

    assert node.exit_code() == 1
    assert "the module `callbacks` has no next_goal, read_result" in node.log


@pytest.mark.thorough
def test_twenty_robots_on_one_machine(ros: Any) -> None:
    """All hear an event, and each calls a server of its own."""
    count = 20
    fakes = ros.fakes()
    fakes.publisher("/fleet/stop", "std_msgs/msg/Empty")
    robots = [f"/fleet/blinker_{number}" for number in range(count)]
    for robot in robots:
        fakes.action(f"{robot}/cmd/blink", "blinker_msgs/action/Blink", "never")
    # Twenty processes that start at once take their time.
    nodes = [ros.node("blinker_behavior.blinking", each, timeouts__server=60.0) for each in robots]
    for robot in robots:
        fakes.wait("goal", f"{robot}/cmd/blink")
    fakes.listeners("/fleet/stop", count=count)
    fakes.publish("/fleet/stop")

    for node in nodes:
        assert node.exit_code() == 0
        assert node.trace[-1]["configuration"] == ["Off"]
