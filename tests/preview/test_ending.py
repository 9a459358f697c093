"""A preview ends on SIGINT, whatever its threads, its clients or ROS do."""

from __future__ import annotations

import os
import signal
import socket
import subprocess
import sys
import threading
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

import pytest

from swarmdsl.ide.preview import local_server, serving
from swarmdsl.ide.preview.serving import Snapshot

pytestmark = pytest.mark.skipif(os.name != "posix", reason="signals of POSIX")

PATIENCE = 60
MODEL = "package work\nstatemachine Work { initial A; state A { after 1 s -> B } final B }\n"
# A mutex that is locked twice: a call of C that no signal interrupts. FREE lets other threads of
# Python run meanwhile, HELD does not.
HANG = """
import ctypes, sys
def hang(*_, **more):
    sys.stderr.write("hangs\\n")
    sys.stderr.flush()
    mutex = ctypes.create_string_buffer(64)
    library = ctypes.{library}(None)
    library.pthread_mutex_lock(mutex)
    library.pthread_mutex_lock(mutex)
"""
FREE, HELD = "CDLL", "PyDLL"
START = """
from swarmdsl.base import forced_end
from swarmdsl.ide.preview import local_server, ros2, serving
from swarmdsl.cli import main, watch
forced_end._LATE = 3.0
forced_end._MARGIN = 0.5
ros2._GRACE = local_server._GRACE = 0.5
"""
# What the preview uses of ROS 2.
ROS = {
    "rclpy/__init__.py": """
import time
from . import qos
class Entity:
    def __init__(self, **more): pass
    def create_timer(self, *_): pass
    def add_node(self, node): pass
    def spin_once(self): time.sleep(0.01)
    def shutdown(self): pass
    def destroy_node(self): pass
    def try_shutdown(self): pass
Context = Entity
class Executor(Entity): pass
class Node(Entity): pass
def init(**more): pass
def create_node(name, **more): return Node()
""",
    "rclpy/executors.py": "from . import Executor as SingleThreadedExecutor\n",
    "rclpy/qos.py": """
class QoSProfile:
    def __init__(self, **more): pass
class DurabilityPolicy: TRANSIENT_LOCAL = 1
""",
    "std_msgs/msg.py": "class String: pass\n",
}


@contextmanager
def previewing(tmp_path: Path, program: str, *options: str) -> Iterator[subprocess.Popen[str]]:
    """A preview in a process that runs a program before."""
    model = tmp_path / "work.swarm"
    model.write_text(MODEL, encoding="utf-8")
    for name, text in ROS.items():
        (tmp_path / name).parent.mkdir(exist_ok=True)
        (tmp_path / name).write_text(text, encoding="utf-8")
    words = ["swarmc", "preview", str(model), *options]
    paths = [str(tmp_path), *filter(None, [os.environ.get("PYTHONPATH")])]
    process = subprocess.Popen(
        [sys.executable, "-c", f"{program}\nimport sys\nsys.argv = {words!r}\nmain()"],
        env={**os.environ, "PYTHONPATH": os.pathsep.join(paths)},
        stdin=subprocess.PIPE,
        stdout=subprocess.DEVNULL,
        stderr=subprocess.PIPE,
        text=True,
    )
    try:
        yield process
    finally:
        process.kill()
        process.communicate()


def wait_for_line(process: subprocess.Popen[str], text: str) -> str:
    assert process.stderr is not None
    said = []
    for line in process.stderr:
        said.append(line)
        if text in line:
            return line
    pytest.fail(f"no {text}: {''.join(said)}")


def interrupted(process: subprocess.Popen[str]) -> int:
    process.send_signal(signal.SIGINT)
    return process.wait(PATIENCE)


@pytest.mark.parametrize("what", ["rclpy.init", "rclpy.create_node"])
def test_although_ros_never_begins(tmp_path: Path, what: str) -> None:
    program = f"{START}{HANG.format(library=FREE)}\nimport rclpy\n{what} = hang"
    with previewing(tmp_path, program, "--follow", "ros2:") as process:
        wait_for_line(process, "hangs")
        assert interrupted(process) == 128 + signal.SIGINT


@pytest.mark.parametrize(
    "what",
    ["Executor.spin_once", "Executor.shutdown", "Node.destroy_node", "Context.try_shutdown"],
)
def test_although_ros_hangs(tmp_path: Path, what: str) -> None:
    program = f"{START}{HANG.format(library=FREE)}\nimport rclpy\nrclpy.{what} = hang"
    with previewing(tmp_path, program, "--follow", "ros2:") as process:
        wait_for_line(process, "http://")
        assert interrupted(process) == 0


def test_although_ros_keeps_python_from_running(tmp_path: Path) -> None:
    program = f"{START}{HANG.format(library=HELD)}\nimport rclpy\nrclpy.Node.destroy_node = hang"
    with previewing(tmp_path, program, "--follow", "ros2:") as process:
        wait_for_line(process, "http://")
        assert interrupted(process) == 1


@pytest.mark.parametrize("what", ["watch._pause", "atexit._run_exitfuncs"])
def test_although_the_main_thread_hangs(tmp_path: Path, what: str) -> None:
    program = f"{START}{HANG.format(library=FREE)}\nimport atexit\n{what} = hang"
    with previewing(tmp_path, program) as process:
        wait_for_line(process, "http://")
        if what == "watch._pause":
            wait_for_line(process, "hangs")
        # 0: the signal came just before the call that hangs.
        assert interrupted(process) in (0, 128 + signal.SIGINT)


def test_although_the_server_hangs(tmp_path: Path) -> None:
    program = f"{START}{HANG.format(library=FREE)}\nserving._Server.service_actions = hang"
    with previewing(tmp_path, program) as process:
        wait_for_line(process, "http://")
        assert interrupted(process) == 0


def test_although_clients_and_traces_stay_open(tmp_path: Path) -> None:
    """One reads events, one has sent half a request, and one reads no answer; a FIFO is open."""
    fifo = tmp_path / "trace"
    os.mkfifo(fifo)
    with previewing(tmp_path, START, "--follow", str(fifo), "--follow", "-") as process:
        line = wait_for_line(process, "http://")
        port = int(line.partition("http://127.0.0.1:")[2].partition("/")[0])
        clients = [socket.create_connection(("127.0.0.1", port)) for _ in range(3)]
        clients[0].sendall(b"GET /events HTTP/1.1\r\nHost: localhost\r\n\r\n")
        assert clients[0].recv(15) == b"HTTP/1.0 200 OK"
        clients[1].sendall(b"POST /open HTTP/1.1\r\nHost: localhost\r\nContent-Le")
        clients[2].sendall(b"GET /preview.js HTTP/1.1\r\nHost: localhost\r\n\r\n" * 3)
        assert interrupted(process) == 0
        for each in clients:
            each.close()


def test_leaving_the_server_is_bounded(monkeypatch: pytest.MonkeyPatch) -> None:
    hangs, goes_on = threading.Event(), threading.Event()

    def hang(_: object) -> None:
        hangs.set()
        goes_on.wait()

    monkeypatch.setattr(serving._Server, "service_actions", hang)
    monkeypatch.setattr(local_server, "_GRACE", 0.1)
    left = threading.Event()

    def serve() -> None:
        with serving.serving(Snapshot(), 0):
            hangs.wait()
        left.set()

    thread = threading.Thread(target=serve, daemon=True)
    thread.start()
    try:
        assert left.wait(PATIENCE)
    finally:
        goes_on.set()
        thread.join()
