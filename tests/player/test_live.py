"""Pages that grow while a trace is written."""

from __future__ import annotations

import json
import os
import re
import signal
import subprocess
import sys
from collections.abc import Iterator
from contextlib import contextmanager
from http.client import HTTPConnection
from pathlib import Path
from typing import Any

import pytest

from swarmdsl.base.diagnostics.collector import Diagnostics
from swarmdsl.cli import run
from swarmdsl.execution.simulate.run.prepare import Request, prepare
from swarmdsl.ide.preview.live_player import playing
from swarmdsl.tools.player.live_lines import LiveLines

MODEL = """
event Go : std_msgs/Empty
endless statemachine Work {
  initial Off
  state Off { on Go -> On }
  state On { on Go -> Off }
}
member Robot { behavior Work }
swarm Crew { robot : Robot[2] }
property Stays of Crew : never some robot in On
"""
BEGUN = {"event": None, "configuration": ["Off"], "entered": ["Off"]}
ON = {"event": "Go", "configuration": ["On"], "entered": ["On"], "exited": ["Off"]}


def line(time: int, member: str, done: dict[str, Any]) -> str:
    lists: dict[str, list[str]] = {
        name: [] for name in ("entered", "exited", "started", "cancelled", "sent")
    }
    return f"{json.dumps({'t': time, 'member': member, **lists, **done})}\n"


def add(path: Path, *lines: str) -> None:
    with path.open("a", encoding="utf-8") as file:
        file.writelines(lines)


class Live:
    """A page of a trace, and what it has told."""

    def __init__(self, browser: Any, folder: Path) -> None:
        model = folder / "model.swarm"
        model.write_text(MODEL, encoding="utf-8")
        self.trace = folder / "run.jsonl"
        self.told: list[str] = []
        prepared = prepare(Request((model,)), Diagnostics())
        self._serving = playing(prepared, str(self.trace), 0, self._tell)
        self.address = self._serving.__enter__()
        self.page = browser.new_page()
        self.wrong: list[str] = []
        self.page.on("pageerror", lambda error: self.wrong.append(str(error)))
        self.open()

    def _tell(self, report: Diagnostics) -> None:
        self.told += [each.code for each in report]

    def open(self) -> None:
        self.page.goto(self.address)
        self.page.wait_for_selector("html[data-ready]", state="attached")

    def wait(self, condition: str) -> None:
        # Not `wait_for_function`, which the policy of the page forbids.
        look = f"while (!({condition})) await new Promise(requestAnimationFrame);"
        self.page.evaluate(f"(async () => {{ {look} }})()")

    def says(self, words: str) -> None:
        self.page.locator("#live").get_by_text(words).wait_for()

    def end(self) -> None:
        self._serving.__exit__(None, None, None)


@pytest.fixture
def live(browser: Any, tmp_path: Path) -> Iterator[Live]:
    found = Live(browser, tmp_path)
    yield found
    found.page.close()
    assert found.wrong == []


def test_lines_come_while_the_trace_is_written(live: Live) -> None:
    assert live.page.evaluate("[player.recording.count, player.index]") == [0, -1]
    add(live.trace, line(0, "robot[0]", BEGUN), line(0, "robot[1]", BEGUN))
    live.wait("player.recording.count === 2")
    assert live.page.evaluate("player.recording.members.map((each) => each.machine)") == [
        "Work",
        "Work",
    ]
    live.page.get_by_role("button", name="robot[1] Off").wait_for()
    # Half a line is none yet.
    whole = line(4000, "robot[1]", ON)
    add(live.trace, whole[:20])
    add(live.trace, whole[20:], line(5000, "robot[0]", ON))
    live.wait("player.recording.count === 4")
    assert live.page.evaluate("[player.index, player.time]") == [3, 5e9]
    live.page.get_by_role("button", name="robot[1] On").wait_for()
    live.page.locator("#about").get_by_text("2 members, 4 lines").wait_for()

    # Who has gone back stays there, and the lanes go on.
    live.page.evaluate("player.go(0)")
    add(live.trace, line(10_000, "robot[2]", BEGUN))
    live.page.get_by_role("button", name="robot[2]").wait_for()
    assert live.page.evaluate("[player.index, player.recording.end]") == [0, 10e9]
    live.page.keyboard.press("End")
    add(live.trace, line(11_000, "robot[2]", ON))
    live.wait("player.index === 5")
    assert live.told == []
    # A page that is opened later has all of it.
    live.open()
    live.wait("player.recording.count === 6 && player.index === 5")
    live.end()


def test_what_has_come_stays_whatever_becomes_of_the_trace(live: Live) -> None:
    add(live.trace, line(0, "robot[0]", BEGUN), line(3000, "robot[0]", ON))
    live.wait("player.recording.count === 2")
    live.trace.unlink()
    live.says("The trace is gone.")
    add(live.trace, line(0, "robot[1]", BEGUN))
    live.says("The trace has begun again.")
    assert live.page.evaluate("player.recording.members.map((each) => each.name)") == ["robot[0]"]
    live.open()
    live.wait("player.recording.members[0]?.name === 'robot[1]'")

    live.trace.write_text("", encoding="utf-8")
    live.says("The trace has begun again.")
    live.open()
    add(live.trace, "no line\n", line(2000, "robot[0]", BEGUN), line(500, "robot[0]", ON))
    live.wait("player.recording.count === 2")
    assert live.page.evaluate("player.recording.time(1)") == 2e9
    notes = live.page.locator(".notes").inner_text()
    assert all(each in notes for each in ("line 1 of", "SW1010", "goes back by 1.5 s", "SW1023"))
    assert live.told == ["SW1010", "SW1023"]

    live.end()
    live.says("The server of this page has ended.")
    live.page.get_by_text("Save").click()
    with live.page.expect_download() as saved:
        live.page.get_by_role("button", name="Events file").click()
    assert '"Go"' in saved.value.path().read_text(encoding="utf-8")


def test_only_pages_of_this_computer_are_answered(tmp_path: Path) -> None:
    with playing(None, str(tmp_path / "none.jsonl"), 0, lambda report: None) as address:
        port = int(address.rpartition(":")[2].strip("/"))
        for path, host, status in (
            ("/", "127.0.0.1", 200),
            ("/", "swarm.example", 403),
            ("/events", "swarm.example", 403),
            ("/../page.py", "127.0.0.1", 404),
        ):
            connection = HTTPConnection("127.0.0.1", port)
            connection.request("GET", path, headers={"Host": host})
            answer = connection.getresponse()
            assert answer.status == status
            if status == 200:
                text = answer.read().decode()
                (policy,) = re.findall(r'Security-Policy" content="([^"]*)"', text)
                assert "default-src 'none'" in policy
                assert "connect-src 'self'" in policy
            connection.close()


def test_lines_without_a_model_get_colours_and_times_of_the_node() -> None:
    lines, report = LiveLines("run.jsonl", None, ()), Diagnostics()
    first = lines.read([line(0, "robot[0]", {**BEGUN, "began": 10**12})], report)
    assert first["members"] == [
        {"name": "robot[0]", "role": "robot", "machine": "robot", "index": 0}
    ]
    assert set(first["machines"]["robot"]["colours"]) == {"Off"}
    second = lines.read([line(1000, "robot[0]", ON), "\n"], report)
    assert second.keys() == {"machines", "lines"}
    colours = second["machines"]["robot"]["colours"]
    assert colours["Off"] == first["machines"]["robot"]["colours"]["Off"] != colours["On"]
    assert lines.read([line(2000, "robot[0]", ON)], report).keys() == {"lines"}
    assert len(report) == 0
    many = lines.read(["{}"] * 100, report)
    assert len(many["notes"]) == len(report) == 20


def test_standard_input_is_followed_until_ctrl_c(tmp_path: Path) -> None:
    with started(tmp_path, "--follow", "-") as process:
        assert process.stdin is not None
        assert process.stdout is not None
        found = re.search(r"http://127\.0\.0\.1:(\d+)/", process.stdout.readline())
        assert found is not None
        connection = HTTPConnection("127.0.0.1", int(found[1]), timeout=60)
        connection.request("GET", "/events")
        answer = connection.getresponse()
        process.stdin.write(line(0, "robot[0]", BEGUN))
        process.stdin.close()
        assert "robot[0]" in answer.readline().decode()
        assert answer.readline() == b"\n"
        assert json.loads(answer.readline().decode().removeprefix("data: ")) == {"turn": "ended"}
        connection.close()
        process.send_signal(signal.SIGINT)
        assert process.wait(60) == 0


@contextmanager
def started(folder: Path, *words: str) -> Iterator[subprocess.Popen[str]]:
    command = [sys.executable, "-m", "swarmdsl", "play", *words]
    process = subprocess.Popen(
        command,
        cwd=folder,
        env=os.environ,
        stdin=subprocess.PIPE,
        stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT,
        text=True,
    )
    with process:
        yield process
        process.kill()


@pytest.mark.parametrize(
    ("words", "said"),
    [
        (["--follow", "run.jsonl", "-o", "run.html"], "`--follow` and `-o` conflict"),
        (["--follow", "run.jsonl", "--seed", "1"], "`--follow` and `--seed` conflict"),
        (["--port", "5008"], "`--port` needs `--follow`"),
        (["--open"], "`--open` needs `--follow`"),
    ],
)
def test_options_that_do_not_fit(
    capsys: pytest.CaptureFixture[str], words: list[str], said: str
) -> None:
    assert run(["play", *words]) == 2
    assert said in capsys.readouterr().err
