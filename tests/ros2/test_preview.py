"""`swarmc preview` shows where nodes are that run."""

from __future__ import annotations

import http.client
import json
import os
import re
import signal
import subprocess
import threading
import time
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from queue import SimpleQueue
from typing import Any

import click
import pytest

ROOT = Path(__file__).resolve().parents[2]
EXAMPLE = ROOT / "examples" / "search_and_rescue"
TAKE_OFF = ("/sar/uav_0/cmd/takeoff", "uav_mavros_takeoff/action/TakeOff")
PATIENCE = 60.0


def environment(ros: Any) -> dict[str, str]:
    """That of nodes, with the compiler; the packages that it imports are those of these tests."""
    paths = [ros.environment["PYTHONPATH"], str(ROOT / "src"), str(Path(click.__file__).parents[1])]
    return {**ros.environment, "PYTHONPATH": os.pathsep.join(paths)}


@contextmanager
def previewed(ros: Any, name: str) -> Iterator[SimpleQueue[Any]]:
    """A preview that follows nodes, with the Python of ROS; yields what its page is told."""
    process = subprocess.Popen(
        [ros.python, "-m", "swarmdsl", "preview", EXAMPLE, "--follow", f"ros2:{name}"],
        env=environment(ros),
        stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT,
        text=True,
    )
    assert process.stdout is not None
    try:
        said = next((line for line in process.stdout if "http://" in line), "")
        port = re.search(r"http://127.0.0.1:(\d+)/", said)
        assert port, said
        told: SimpleQueue[Any] = SimpleQueue()
        threading.Thread(target=_hear, args=(int(port[1]), told), daemon=True).start()
        yield told
        process.send_signal(signal.SIGINT)
        assert process.wait(PATIENCE) == 0
        assert "Traceback" not in process.stdout.read()
    finally:
        process.kill()
        process.wait()
        process.stdout.close()


def _hear(port: int, told: SimpleQueue[Any]) -> None:
    connection = http.client.HTTPConnection("127.0.0.1", port, timeout=PATIENCE)
    connection.request("GET", "/events")
    for line in connection.getresponse():
        if line.startswith(b"data: "):
            told.put(json.loads(line.removeprefix(b"data: ")))


def until(told: SimpleQueue[Any], **wanted: Any) -> None:
    """Wait until a page is told this, among other things; news in between are others'."""
    seen: list[Any] = []
    end = time.monotonic() + PATIENCE
    while not any(wanted.items() <= each.items() for each in seen):
        assert time.monotonic() < end, seen
        seen.append(told.get(timeout=PATIENCE))


def test_a_node_is_followed_while_it_runs(ros: Any) -> None:
    fakes = ros.fakes()
    fakes.action(*TAKE_OFF, "never")
    fakes.publisher("/sar/mission_start", "swarmros/msg/SimpleEvent")
    node = ros.node("sar_behavior.uav_search", "/sar/uav_0", member="uav[0]")
    node.wait_in("Mission.Idle")
    with previewed(ros, "sar") as told:
        until(told, active={"uav[0]": ["Mission.Idle"]})
        fakes.listeners("/sar/mission_start")
        fakes.publish("/sar/mission_start")
        until(told, active={"uav[0]": ["Mission.TakeOff"]})
        until(told, taken={"uav[0]": ["Mission.Idle->0"]})
    with previewed(ros, "/sar/uav_0/uav_search") as told:
        until(told, active={"uav[0]": ["Mission.TakeOff"]})
        # The middleware takes a node that was killed for alive when the next one is there.
        node.terminate(signal.SIGKILL)
        node = ros.node("sar_behavior.uav_search", "/sar/uav_0", member="uav[0]")
        until(told, active={"uav[0]": None})
        until(told, active={"uav[0]": ["Mission.Idle"]})
        node.terminate()
        until(told, active={"uav[0]": None})


# The thread of the executor stops in METHOD, as on a busy machine, until that of the preview waits
# for its end.
BUSY = """
import threading
from rclpy.executors import Executor
from swarmdsl.ide.preview import ros2
from swarmdsl.ide.preview.serving import Snapshot

ros2._GRACE = {grace}
stopped, leaving = threading.Event(), threading.Event()
owner, name = {method}
go_on, join = getattr(owner, name), threading.Thread.join

def slow(self):
    stopped.set()
    if not {forever}:
        leaving.wait()
    else:
        threading.Event().wait()
    return go_on(self)

def leave(thread, timeout=None):
    leaving.set()
    join(thread, timeout)

setattr(owner, name, slow)
threading.Thread.join = leave
with ros2.listening(["sar"], Snapshot(), print):
    stopped.wait()
print("left")
"""


@pytest.mark.parametrize(
    ("method", "forever"),
    [('(Executor, "get_nodes")', False), ('(ros2.NodeListener, "poll")', True)],
    ids=["executor", "callback"],
)
def test_preview_ends_whatever_the_executor_does(
    ros: Any, tmp_path: Path, method: str, forever: bool
) -> None:
    script = tmp_path / "busy.py"
    grace = 0.1 if forever else PATIENCE
    script.write_text(BUSY.format(method=method, forever=forever, grace=grace), encoding="utf-8")
    ended = subprocess.run(
        [ros.python, script], env=environment(ros), capture_output=True, text=True, timeout=PATIENCE
    )
    assert (ended.returncode, ended.stdout) == (0, "left\n")
    assert "Traceback" not in ended.stderr
