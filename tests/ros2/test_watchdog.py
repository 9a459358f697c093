"""Watchdogs of real nodes that are killed: goals are cancelled, and a safe function is called."""

from __future__ import annotations

import signal
import subprocess
import time
from pathlib import Path
from typing import Any

from .conftest import write_package

MODEL = """
package guarded

action lab_msgs/Work {
  goal {
    name  : string
    speed : float64
    limit : duration
  }
  result {
    count : int32
    took  : duration
  }
  feedback { share : float64 }
}

function work : abstraction { action "cmd/work" : lab_msgs/Work }
function land : abstraction { service "cmd/land" : std_srvs/Empty }

endless statemachine Fly {
  initial Work
  state Work {
    do work(name = "survey", speed = 1.0, limit = 5 s)
    on succeeded, aborted -> Work
  }
}

member Uav {
  behavior Fly
  contract Dies : when dead call land
}

swarm Field { uav : Uav[2] }
"""
WORK = ("/uav_0/cmd/work", "lab_msgs/action/Work")
LAND = ("/uav_0/cmd/land", "std_srvs/srv/Empty")
CHANGE, GET = "lifecycle_msgs/srv/ChangeState", "lifecycle_msgs/srv/GetState"
CONFIGURE, CLEAN_UP, ACTIVATE, DEACTIVATE, SHUT_DOWN = 1, 2, 3, 4, 7
WATCHED = {
    "function": "cmd/land",
    "paradigm": "service",
    "type": "std_srvs/srv/Empty",
    "cancels": "cmd/work",
}
PATIENCE = 60.0
HANGS = """
import ctypes
from rclpy.node import Node
from guarded_behavior.fly import main

def destroy_node(self):
    print('hangs', flush=True)
    ctypes.PyDLL(None).sleep(10**6)

Node.destroy_node = destroy_node
main()
"""
"""A node that has ended its machine, and hangs in the middleware."""


def test_a_node_that_is_killed(ros: Any, tmp_path: Path) -> None:
    """Its work is cancelled and it lands once; a node that is told to end does not."""
    model = tmp_path / "guarded.swarm"
    model.write_text(MODEL, encoding="utf-8")
    package = write_package(model, tmp_path)
    ros.prefer(package)
    launched = (package / "launch" / "field.launch.py").read_text(encoding="utf-8")
    for name, value in WATCHED.items():  # the launch file passes what is passed here
        assert f"'{name}': '{value}'" in launched
    lease = tmp_path / "leases" / "fly"
    fakes = ros.fakes()
    fakes.action(*WORK, "never")
    fakes.service(*LAND)
    log = tmp_path / "watchdog.txt"
    with log.open("w", encoding="utf-8") as written:
        start(ros, "watchdog", {**WATCHED, "lease.file": lease}, stderr=written)
        wait_in(log, f"{lease} is watched")

        node = start(ros, "fly", {"lease.file": lease, "member": "uav[0]"})
        fakes.wait("begun", WORK[0])
        node.kill()
        fakes.wait("request", LAND[0])
        fakes.wait("stopped", WORK[0])

        node = start(ros, HANGS, {"lease.file": lease, "member": "uav[0]"}, stdout=subprocess.PIPE)
        fakes.wait("begun", WORK[0], 2)
        node.send_signal(signal.SIGTERM)
        assert node.stdout is not None
        assert node.stdout.readline() == "hangs\n"
        node.kill()  # as launch does after a while

        node = start(ros, "fly", {"lease.file": lease, "member": "uav[0]"})
        fakes.wait("begun", WORK[0], 3)
        node.kill()
        fakes.wait("request", LAND[0], 2)  # the one that was told to end did not call it
        fakes.wait("stopped", WORK[0], 3)
    assert fakes.count("request", LAND[0]) == 2
    assert "the node has died: cmd/land is called" in log.read_text(encoding="utf-8")


def test_a_managed_node_that_is_killed(ros: Any, tmp_path: Path) -> None:
    """No transition is a death, not one that fails or is not possible; a kill is."""
    model = tmp_path / "guarded.swarm"
    model.write_text(MODEL, encoding="utf-8")
    ros.prefer(write_package(model, tmp_path, lifecycle="true"))
    lease = tmp_path / "leases" / "fly"
    fakes = ros.fakes()
    fakes.action(*WORK, "never")
    fakes.service(*LAND)

    def node(name: str, **more: str) -> subprocess.Popen[str]:
        """Start a node; a name of its own tells it from those that have ended."""
        names.append(name)
        given = {"lease.file": lease, "member": "uav[0]", **more}
        return start(ros, "fly", given, "-r", f"__node:={name}", stderr=written)

    def change(transition: int) -> bool:
        service = f"/uav_0/{names[-1]}/change_state"
        return bool(fakes.call(service, CHANGE, transition={"id": transition})["success"])

    def state() -> str:
        return str(fakes.call(f"/uav_0/{names[-1]}/get_state", GET)["current_state"]["label"])

    def ended(started: subprocess.Popen[str]) -> int:
        started.send_signal(signal.SIGTERM)
        return started.wait(PATIENCE)

    log = tmp_path / "log.txt"
    names: list[str] = []
    with log.open("w", encoding="utf-8") as written:
        start(ros, "watchdog", {**WATCHED, "lease.file": lease}, stderr=written)
        wait_in(log, f"{lease} is watched")

        first = node("first")
        assert not change(ACTIVATE)
        assert (change(CONFIGURE), change(ACTIVATE)) == (True, True)
        fakes.wait("begun", WORK[0])
        assert not change(CLEAN_UP)
        assert change(DEACTIVATE)
        fakes.wait("stopped", WORK[0])
        assert state() == "inactive"
        assert (change(CLEAN_UP), change(CONFIGURE), change(ACTIVATE)) == (True, True, True)
        fakes.wait("begun", WORK[0], 2)
        assert change(SHUT_DOWN)
        fakes.wait("stopped", WORK[0], 2)
        assert state() == "finalized"
        assert ended(first) == 0

        # An error in a transition is logged, and leaves the node as it was before.
        second = node("second", swarm="/1")
        assert [change(CONFIGURE), change(CONFIGURE)] == [False, False]
        assert state() == "unconfigured"
        wait_in(log, "InvalidTopicNameException")
        assert ended(second) == 0

        third = node("third")
        assert (change(CONFIGURE), change(ACTIVATE)) == (True, True)
        fakes.wait("begun", WORK[0], 3)
        assert fakes.count("request", LAND[0]) == 0
        third.kill()
        fakes.wait("request", LAND[0])
        fakes.wait("stopped", WORK[0], 3)


def start(
    ros: Any, module: str, parameters: dict[str, Any], *words: str, **options: Any
) -> subprocess.Popen[str]:
    """Start a node of the package with parameters."""
    given = [each for name, value in parameters.items() for each in ("-p", f"{name}:={value!s}")]
    namespace = ("-r", "__ns:=/uav_0")
    program = ("-c", module) if module == HANGS else ("-m", f"guarded_behavior.{module}")
    made: subprocess.Popen[str] = ros.start(
        *program, "--ros-args", *namespace, *words, *given, **options
    )
    return made


def wait_in(log: Path, text: str) -> None:
    """Wait until a log has a text."""
    end = time.monotonic() + PATIENCE
    while text not in log.read_text(encoding="utf-8"):
        assert time.monotonic() < end, log.read_text(encoding="utf-8")
        time.sleep(0.02)
