"""The radio of tested fleets: who hears whom, what is lost, and what is left of it."""

from __future__ import annotations

import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path

import pytest

from .radio import Radio, missing, remove_leftovers

_LISTEN = """
import socket, sys
made = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
made.bind(("", 7400))
made.settimeout(float(sys.argv[1]))
print("ready", flush=True)
heard = 0
try:
    while made.recv(100) != b"end":
        heard += 1
except TimeoutError:
    pass
print(heard)
"""
_SAY = """
import socket, sys
made = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
for _ in range(int(sys.argv[2])):
    try:
        made.sendto(b"word", (sys.argv[1], 7400))
    except OSError:
        pass  # out of reach
for _ in range(20):
    try:
        made.sendto(b"end", (sys.argv[1], 7400))
    except OSError:
        pass
"""


@pytest.fixture(autouse=True)
def allowed() -> None:
    """Skip the tests where there can be no radio."""
    if reason := missing():
        pytest.skip(f"no radio: {reason}")


@pytest.fixture
def radio(tmp_path: Path) -> Iterator[Radio]:
    made = Radio(["one", "two"], tmp_path)
    yield made
    made.close()


def heard(radio: Radio, count: int, patience: float = 20) -> int:
    """Return how many of the packets of one computer another one hears."""
    python = [sys.executable, "-c"]
    listen = [*radio.command("two"), *python, _LISTEN, str(patience)]
    with subprocess.Popen(listen, stdout=subprocess.PIPE, text=True) as listening:
        assert listening.stdout is not None
        assert listening.stdout.readline() == "ready\n"
        say = [*radio.command("one"), *python, _SAY, radio.addresses["two"], str(count)]
        subprocess.run(say, check=True)
        return int(listening.stdout.readline())


def test_robots_are_out_of_reach_and_lose_packets(radio: Radio) -> None:
    assert heard(radio, 50) == 50
    radio.cut("two")
    assert heard(radio, 50, patience=0.5) == 0
    radio.heal("two")
    assert heard(radio, 50) == 50
    radio.lose(0.5)
    assert 50 < heard(radio, 200) < 150
    assert 50 < radio.lose_nothing() < 200
    assert heard(radio, 50) == 50


def test_what_is_left_of_a_killed_test_is_removed(tmp_path: Path) -> None:
    """With the processes that still run there."""
    code = (
        "import os, pathlib, subprocess, sys\n"
        "from tests.ros2.radio import Radio\n"
        "made = Radio(['one'], pathlib.Path(sys.argv[1]))\n"
        "command = [*made.command('one'), 'sleep', '600']\n"
        "started = subprocess.Popen(command, stdout=subprocess.DEVNULL)\n"
        "print(os.getpid(), started.pid, flush=True)\n"
        "os.kill(os.getpid(), 9)\n"
    )
    root = Path(__file__).parents[2]
    command = [sys.executable, "-c", code, str(tmp_path)]
    killed = subprocess.run(command, cwd=root, stdout=subprocess.PIPE, text=True)
    test, left = killed.stdout.split()
    assert f"fleet-{test}-one" in _namespaces()
    remove_leftovers()
    assert not any(name.startswith(f"fleet-{test}-") for name in _namespaces())
    state = Path("/proc", left, "status")
    assert not state.exists() or "\nState:\tZ" in state.read_text()


def _namespaces() -> list[str]:
    listed = subprocess.run(["ip", "netns", "list"], capture_output=True, text=True, check=True)
    return listed.stdout.split()
