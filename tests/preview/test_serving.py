"""`swarmc preview`, as a browser asks it."""

from __future__ import annotations

import http.client
import json
import os
import re
import shutil
import signal
import socket
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest

pytestmark = pytest.mark.skipif(os.name != "posix", reason="signals of POSIX")

MACHINE = """package work
statemachine Work {
  initial Busy
  state Busy { after 1 s -> Ready }
  final Ready
}
statemachine Rest { initial Nap state Nap { after 1 s -> Awake } final Awake }
"""
PATIENCE = 60


class Browser:
    """Asks the page of a preview, and hears what it is told."""

    def __init__(self, port: int) -> None:
        self.port = port
        self._events: http.client.HTTPResponse | None = None

    def get(self, path: str, host: str | None = None) -> http.client.HTTPResponse:
        connection = http.client.HTTPConnection("127.0.0.1", self.port, timeout=PATIENCE)
        connection.request("GET", path, headers={"Host": host or f"127.0.0.1:{self.port}"})
        return connection.getresponse()

    def picture(self, id_: str) -> Any:
        return json.loads(self.get(f"/picture?{id_}").read())

    def told(self) -> Any:
        """The next news."""
        if self._events is None:
            self._events = self.get("/events")
        while True:
            line = self._events.readline().decode()
            assert line, "nothing more is told"
            if line.startswith("data: "):
                return json.loads(line.removeprefix("data: "))


@pytest.fixture
def model(tmp_path: Path) -> Path:
    path = tmp_path / "work.swarm"
    path.write_text(MACHINE, encoding="utf-8")
    return path


@pytest.fixture
def browser(model: Path) -> Iterator[Browser]:
    command = [sys.executable, "-m", "swarmdsl", "preview", model.name]
    process = subprocess.Popen(
        command, cwd=model.parent, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True
    )
    assert process.stdout is not None
    address = None
    while address is None:
        line = process.stdout.readline()
        assert line, "it ended"
        address = re.search(r"http://127\.0\.0\.1:(\d+)/", line)
    yield Browser(int(address[1]))
    process.send_signal(signal.SIGINT)
    process.communicate(timeout=PATIENCE)
    assert process.returncode == 0


def test_it_follows_the_text(browser: Browser, model: Path) -> None:
    assert browser.told() == {
        "titles": {
            "Work.statechart": "Work (state machine)",
            "Rest.statechart": "Rest (state machine)",
        }
    }
    drawn = browser.picture("Work.statechart")
    assert drawn["id"] == "Work.statechart"
    assert ">Ready</text>" in drawn["svg"]
    assert f'data-place="{model}:4:9"' in drawn["svg"]

    model.write_text(MACHINE.replace("-> Ready", "-> Raedy"), encoding="utf-8")
    assert browser.told() == {"broken": 1}
    assert browser.picture("Work.statechart") == drawn, "it is as it was before the mistake"

    model.write_text(MACHINE.replace("Ready", "Done"), encoding="utf-8")
    assert "titles" in browser.told()
    assert ">Done</text>" in browser.picture("Work.statechart")["svg"]
    model.write_text(MACHINE.replace("Work", "Job"), encoding="utf-8")
    assert "Job.statechart" in browser.told()["titles"]
    assert browser.picture("Work.statechart")["id"] == "Job.statechart", "the first of those there"


def test_a_page_that_comes_while_the_text_is_broken_gets_both(
    browser: Browser, model: Path
) -> None:
    browser.told()
    model.write_text(MACHINE.replace("-> Ready", "-> Raedy"), encoding="utf-8")
    browser.told()
    late = Browser(browser.port)
    assert "titles" in late.told()
    assert late.told() == {"broken": 1}


def test_the_page(browser: Browser) -> None:
    answer = browser.get("/")
    assert answer.status == 200
    policy = answer.getheader("Content-Security-Policy") or ""
    assert "default-src 'none'" in policy
    for path in re.findall(r'(?:href|src)="([\w.]+)"', answer.read().decode()):
        assert browser.get(f"/{path}").status == 200
    for path in ("/nothing", "/../pictures.py", "/%2e%2e/pictures.py", "//etc/passwd"):
        assert browser.get(path).status == 404, path


def test_pages_of_others_are_not_answered(browser: Browser) -> None:
    for path in ("/", "/events", "/picture?Work.statechart"):
        assert browser.get(path, host=f"example.org:{browser.port}").status == 403


@pytest.mark.skipif(shutil.which("chromium") is None, reason="chromium is not installed")
def test_what_a_person_sees(browser: Browser, model: Path, tmp_path: Path) -> None:
    playwright = pytest.importorskip("playwright.sync_api", reason="playwright is not installed")
    with playwright.sync_playwright() as driver:
        options = {"executable_path": shutil.which("chromium"), "args": ["--no-sandbox"]}
        chromium = driver.chromium.launch(**options)
        page = chromium.new_page()
        wrong: list[object] = []
        page.on("pageerror", lambda error: wrong.append(error))
        page.goto(f"http://127.0.0.1:{browser.port}/#Rest.statechart")
        expect = playwright.expect
        picture = page.locator("#picture")
        expect(picture).to_contain_text("Nap")
        page.locator("#which").select_option("Work.statechart")
        expect(picture).to_contain_text("Busy")

        model.write_text(MACHINE.replace("-> Ready", "-> Raedy"), encoding="utf-8")
        expect(page.locator("#state")).to_have_text("1 mistake: this is how it was before")
        expect(picture).to_contain_text("Ready")
        model.write_text(MACHINE.replace("Ready", "Done"), encoding="utf-8")
        expect(picture).to_contain_text("Done")
        expect(page.locator("#state")).to_be_empty()

        page.locator("#fit").click()
        fitted = picture.get_attribute("style") or ""
        page.mouse.move(400, 300)
        page.mouse.wheel(0, -400)
        expect(picture).not_to_have_attribute("style", fitted)
        page.locator("#fit").click()
        expect(picture).to_have_attribute("style", fitted)

        for button, begins in (("#svg", b"<svg "), ("#png", b"\x89PNG")):
            with page.expect_download() as download:
                page.locator(button).click()
            assert download.value.suggested_filename == f"Work.statechart.{button[1:]}"
            assert Path(download.value.path()).read_bytes().startswith(begins)
        chromium.close()
    assert wrong == []


def test_a_port_that_is_taken(model: Path) -> None:
    with socket.socket() as taken:
        taken.bind(("127.0.0.1", 0))
        taken.listen()
        port = str(taken.getsockname()[1])
        command = [sys.executable, "-m", "swarmdsl", "preview", str(model), "--port", port]
        ran = subprocess.run(command, capture_output=True, text=True, timeout=PATIENCE)
    assert (ran.returncode, "already in use" in ran.stderr) == (1, True)
