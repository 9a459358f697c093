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

def for_ever(*_, **more):
    {hang}

node._LATE = 3.0
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


@pytest.mark.parametrize("what", ["rclpy.init", "Node.__init__", "Node.create_publisher"])
def test_a_node_ends_although_it_never_begins(ros: Any, what: str) -> None:
    program = ros.scratch / "program.py"
    hang = f"print('hangs', flush=True); {FREE}"
    program.write_text(PROGRAM.format(module="lab", what=what, hang=hang), encoding="utf-8")
    process = ros.start(program, stdout=subprocess.PIPE)
    assert process.stdout.readline() == "hangs\n"
    process.send_signal(signal.SIGTERM)

    assert process.wait(60) == 1


HEARD = """
import rclpy
from rclpy.impl.implementation_singleton import rclpy_implementation
from rclpy.publisher import Publisher
from lab_behavior.lab import main

def is_heard(self, timeout):
    print(timeout.nanoseconds, flush=True)
    {answer}

Publisher.wait_for_all_acked = is_heard
main()
"""


@pytest.mark.parametrize(
    ("answer", "least"),
    [("return False", 2), ("raise rclpy_implementation.RCLError('not known')", 1)],
    ids=["far", "unknown"],
)
def test_a_node_ends_although_nobody_hears_it(ros: Any, answer: str, least: int) -> None:
    """It asks the middleware without waiting there, where Python stands still."""
    fakes = ros.fakes()
    fakes.publisher("/go", "lab_msgs/msg/Order")
    words = ["-c", HEARD.format(answer=answer), "--ros-args", "-r", "__ns:=/lab"]
    process = ros.start(*words, stdout=subprocess.PIPE, stderr=subprocess.PIPE)
    fakes.listeners("/go")
    process.send_signal(signal.SIGTERM)

    said, wrong = process.communicate(timeout=60)
    assert process.returncode == 0, wrong
    asked = said.split()
    assert set(asked) == {"0"}
    assert len(asked) >= least
    assert "Traceback" not in wrong


ORDER = """
import threading
import rclpy
from rclpy.executors import Executor
from lab_behavior.lab import main

waits = threading.Lock()
wait_in_ros, shut_down, end_ros = (
    Executor.wait_for_ready_callbacks, Executor.shutdown, rclpy.try_shutdown
)

def wait(self, *words, **more):
    with waits:
        return wait_in_ros(self, *words, **more)

def shut_down_executor(self, timeout_sec=None):
    print('executor spins' if waits.locked() else 'executor', flush=True)
    return shut_down(self, timeout_sec)

def shut_down_ros(**more):
    print('ROS', flush=True)
    end_ros(**more)

Executor.wait_for_ready_callbacks = wait
Executor.shutdown = shut_down_executor
rclpy.try_shutdown = shut_down_ros
main()
"""


@pytest.mark.parametrize("target", ["ros2", "yasmin"])
def test_an_executor_is_shut_down_when_it_spins_no_more(
    ros: Any, variant: Callable[..., Path], target: str
) -> None:
    text = ORDER
    if target == "yasmin":
        text = ORDER.replace("lab_behavior.lab", "lab_behavior.lab_fsm")
        ros.prefer(HERE.parent / "yasmin" / "stand_in")
        ros.prefer(variant("tests/ros2/models", target=target))
    fakes = ros.fakes()
    fakes.publisher("/go", "lab_msgs/msg/Order")
    words = ["--ros-args", "-r", "__ns:=/lab"]
    process = ros.start("-c", text, *words, stdout=subprocess.PIPE, stderr=subprocess.STDOUT)
    fakes.listeners("/go")
    process.send_signal(signal.SIGTERM)

    said, _ = process.communicate(timeout=60)
    assert process.returncode == 0, said
    assert [line for line in said.splitlines() if line[:1] not in ("", "[")] == ["executor", "ROS"]
