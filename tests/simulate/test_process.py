"""`swarmc simulate` as a process: standard input, signals, pipes, terminals, real time."""

from __future__ import annotations

import json
import os
import signal
import subprocess
import sys
import time
from pathlib import Path

import pytest

from .conftest import PRELUDE

posix = pytest.mark.skipif(os.name != "posix", reason="signals and terminals of POSIX")

MODEL = (
    PRELUDE
    + """
endless statemachine M {
  initial A
  state A { on Start -> B }
  state B { on Start -> A; after 1 s -> A }
}
"""
)
ENDLESS = MODEL.replace("state A { on Start -> B }", "state A { on Start -> B; after 1 us -> A }")


@pytest.fixture
def model(tmp_path: Path) -> Path:
    path = tmp_path / "model.swarm"
    path.write_text(MODEL, encoding="utf-8")
    return path


def start(*arguments: object, **options: object) -> subprocess.Popen[bytes]:
    command = [sys.executable, "-m", "swarmdsl", "simulate", *map(str, arguments)]
    pipes = {"stdin": subprocess.PIPE, "stdout": subprocess.PIPE, "stderr": subprocess.PIPE}
    return subprocess.Popen(command, **{**pipes, **options})  # type: ignore[call-overload,no-any-return]


def test_lines_are_answered_one_by_one(model: Path) -> None:
    process = start(model, "--events", "-", "--trace", "json")
    assert process.stdin is not None
    assert process.stdout is not None
    assert json.loads(process.stdout.readline())["configuration"] == ["A"]
    for expected in (["B"], ["A"], ["B"]):
        process.stdin.write(b'{"event": "Start"}\n')
        process.stdin.flush()
        assert json.loads(process.stdout.readline())["configuration"] == expected
    out, _ = process.communicate()
    assert [json.loads(line)["t"] for line in out.splitlines()] == [1000]
    assert process.returncode == 0


def test_a_wrong_line_is_told_and_passed_over(model: Path) -> None:
    process = start(model, "--events", "-", "--trace", "json")
    out, err = process.communicate(
        b'{"event": "Start"}\n\n{"event": Start}\n\xff\n{"event": "Start"}'
    )

    assert [json.loads(line)["configuration"] for line in out.splitlines()] == [["A"], ["B"], ["A"]]
    assert b"--> <stdin>:3:11" in err
    assert b"--> <stdin>:4:1" in err
    assert err.count(b"error[SW1003]") == 2
    assert process.returncode == 1


def test_a_closed_standard_input(model: Path) -> None:
    command = f'"{sys.executable}" -m swarmdsl simulate "{model}" --events - <&-'
    ran = subprocess.run(["sh", "-c", command], capture_output=True, text=True)

    assert ran.returncode == 1
    assert "error[SW0003]: cannot read `<stdin>`" in ran.stderr


@posix
def test_an_interrupt_shows_what_there_is(model: Path) -> None:
    model.write_text(ENDLESS, encoding="utf-8")
    process = start(model, "--trace", "json", "--until", "10h", stdin=subprocess.DEVNULL)
    assert process.stdout is not None
    process.stdout.readline()
    process.send_signal(signal.SIGINT)
    _, err = process.communicate()

    assert process.returncode == 130
    assert b"virtual time, until it was interrupted" in err
    assert b"Traceback" not in err


@posix
def test_a_closed_pipe_ends_it_quietly(model: Path) -> None:
    model.write_text(ENDLESS, encoding="utf-8")
    process = start(model, "--until", "1h", stdin=subprocess.DEVNULL)
    assert process.stdout is not None
    process.stdout.close()
    assert process.stderr is not None
    assert process.stderr.read() == b""
    assert process.wait() == -signal.SIGPIPE
    process.stderr.close()


def test_real_time(model: Path) -> None:
    events = model.with_name("events.jsonl")
    events.write_text('{"event": "Start", "after": 300}\n', encoding="utf-8")
    process = start(model, "--events", events, "--real-time", "--trace", "json")
    assert process.stdout is not None
    process.stdout.readline()
    begun = time.monotonic()
    process.stdout.readline()
    process.stdout.readline()

    assert time.monotonic() - begun >= 1.0
    process.communicate()
    assert process.returncode == 0


def test_real_time_with_events_that_come_at_any_time(model: Path) -> None:
    process = start(model, "--events", "-", "--real-time", "--trace", "json")
    assert process.stdin is not None
    assert process.stdout is not None
    process.stdout.readline()
    time.sleep(0.3)
    process.stdin.write(b'{"event": "Start"}\n')
    process.stdin.flush()
    heard = json.loads(process.stdout.readline())
    later = json.loads(process.stdout.readline())
    process.communicate()

    assert heard["configuration"] == ["B"]
    assert heard["t"] >= 200
    assert (later["configuration"], later["t"] - heard["t"]) == (["A"], 1000)
    assert process.returncode == 0


@posix
def test_a_terminal_shows_a_table_and_no_trace(model: Path) -> None:
    import pty

    ours, theirs = pty.openpty()
    process = start(
        model, "--until", "300ms", "--real-time", stdin=theirs, stdout=theirs, stderr=theirs
    )
    os.close(theirs)
    said = b""
    try:
        while chunk := os.read(ours, 4096):
            said += chunk
    except OSError:
        # The other end is closed.
        pass
    process.wait()
    os.close(ours)

    assert process.returncode == 0
    assert b"is in" in said
    assert b"(start)" not in said
    assert b"coverage: " in said
