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
PATIENCE = 60.0


def test_a_node_that_is_killed(ros: Any, tmp_path: Path) -> None:
    """Its work is cancelled and it lands once; a node that is told to end does not."""
    model = tmp_path / "guarded.swarm"
    model.write_text(MODEL, encoding="utf-8")
    package = write_package(model, tmp_path)
    ros.prefer(package)
    launched = (package / "launch" / "field.launch.py").read_text(encoding="utf-8")
    parameters = {
        "function": "cmd/land",
        "paradigm": "service",
        "type": "std_srvs/srv/Empty",
        "cancels": "cmd/work",
    }
    for name, value in parameters.items():  # the launch file passes what is passed here
        assert f"'{name}': '{value}'" in launched
    lease = tmp_path / "leases" / "fly"
    fakes = ros.fakes()
    fakes.action(*WORK, "never")
    fakes.service(*LAND)
    log = tmp_path / "watchdog.txt"
    with log.open("w", encoding="utf-8") as written:
        start(ros, "watchdog", {**parameters, "lease.file": lease}, stderr=written)
        wait_in(log, f"{lease} is watched")

        node = start(ros, "fly", {"lease.file": lease, "member": "uav[0]"})
        fakes.wait("begun", WORK[0])
        node.kill()
        fakes.wait("request", LAND[0])
        fakes.wait("stopped", WORK[0])

        node = start(ros, "fly", {"lease.file": lease, "member": "uav[0]"})
        fakes.wait("begun", WORK[0], 2)
        node.send_signal(signal.SIGTERM)
        assert node.wait(PATIENCE) == 0

        node = start(ros, "fly", {"lease.file": lease, "member": "uav[0]"})
        fakes.wait("begun", WORK[0], 3)
        node.kill()
        fakes.wait("request", LAND[0], 2)  # the one that was told to end did not call it
        fakes.wait("stopped", WORK[0], 3)
    assert fakes.count("request", LAND[0]) == 2
    assert "the node has died: cmd/land is called" in log.read_text(encoding="utf-8")


def start(
    ros: Any, module: str, parameters: dict[str, object], **options: Any
) -> subprocess.Popen[str]:
    """Start a node of the package with parameters."""
    given = [each for name, value in parameters.items() for each in ("-p", f"{name}:={value!s}")]
    namespace = ("-r", "__ns:=/uav_0")
    made: subprocess.Popen[str] = ros.start(
        "-m", f"guarded_behavior.{module}", "--ros-args", *namespace, *given, **options
    )
    return made


def wait_in(log: Path, text: str) -> None:
    """Wait until a log has a text."""
    end = time.monotonic() + PATIENCE
    while text not in log.read_text(encoding="utf-8"):
        assert time.monotonic() < end, log.read_text(encoding="utf-8")
        time.sleep(0.02)
