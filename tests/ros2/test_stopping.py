"""Nodes that are told to stop while the middleware hangs: they end, and cancel their goals."""

from __future__ import annotations

import signal
import subprocess
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

HERE = Path(__file__).resolve().parent
WORK = ("/lab/work", "lab_msgs/action/Work")
# Calls that never return: one lets other threads of Python run, the other does not.
FREE = "time.sleep(10**6)"
HELD = "ctypes.PyDLL(None).sleep(10**6)"
PROGRAM = """
import ctypes, time
import rclpy
from rclpy.node import Node
from lab_behavior import node
from lab_behavior.{module} import main

def for_ever(*_):
    {hang}

node._LATE = 0.5
{what} = for_ever
main()
"""


@pytest.mark.parametrize(
    ("target", "what", "hang", "code"),
    [
        ("ros2", "Node.destroy_node", FREE, 0),
        ("ros2", "Node.destroy_node", HELD, 1),
        ("ros2", "rclpy.try_shutdown", HELD, 1),
        ("yasmin", "Node.destroy_node", HELD, 1),
    ],
    ids=["free", "held", "shutdown", "yasmin"],
)
def test_a_node_ends_although_the_middleware_hangs(
    ros: Any, variant: Callable[..., Path], target: str, what: str, hang: str, code: int
) -> None:
    module = "lab"
    if target == "yasmin":
        module = "lab_fsm"
        ros.prefer(HERE.parent / "yasmin" / "stand_in")
        ros.prefer(variant("tests/ros2/models", target=target))
    fakes = ros.fakes()
    fakes.action(*WORK, "never")
    fakes.publisher("/go", "lab_msgs/msg/Order")
    program = ros.scratch / "program.py"
    program.write_text(PROGRAM.format(module=module, what=what, hang=hang), encoding="utf-8")
    words = ["--ros-args", "-r", "__ns:=/lab", "-p", "timeouts.cancel:=1.0"]
    process = ros.start(program, *words, stderr=subprocess.PIPE)
    fakes.listeners("/go")
    fakes.publish("/go", name="box", speed=1.0)
    fakes.wait("goal", WORK[0])
    process.send_signal(signal.SIGTERM)

    fakes.wait("stopped", WORK[0])
    _, said = process.communicate(timeout=60)
    assert process.returncode == code, said
    # A node that is killed by force tells where it hangs.
    assert ("in for_ever" in said) == (hang == HELD)
