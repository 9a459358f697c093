"""`swarmc fleet` on a computer with ROS, and its page in a browser there."""

from __future__ import annotations

import os
import re
import shlex
import shutil
import signal
import subprocess
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

import click
import pytest

ROOT = Path(__file__).resolve().parents[2]
PATIENCE = 60.0
_SHOWN = """() => Object.fromEntries([...document.querySelectorAll("tr[data-robot]")].map(
  (row) => [row.dataset.robot, [row.className, row.cells[3].innerText]]))"""


@contextmanager
def watched(ros: Any, model: Path, *options: str) -> Iterator[subprocess.Popen[str]]:
    """Watch a fleet with the Python of ROS, and packages of these tests; it must end well."""
    site = str(Path(click.__file__).parents[1])
    paths = [ros.environment["PYTHONPATH"], str(ROOT / "src"), site]
    process = subprocess.Popen(
        [*ros.prefix, ros.python, "-m", "swarmdsl", "fleet", model, *options],
        env={**ros.environment, "PYTHONPATH": os.pathsep.join(paths)},
        stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT,
        stdin=subprocess.DEVNULL,
        text=True,
    )
    assert process.stdout is not None
    try:
        yield process
        process.send_signal(signal.SIGINT)
        assert process.wait(PATIENCE) == 0
        assert "Traceback" not in process.stdout.read()
    finally:
        process.kill()
        process.wait()
        process.stdout.close()


def address_of(process: subprocess.Popen[str]) -> str:
    """Return the address that is printed."""
    assert process.stdout is not None
    said = next((line for line in process.stdout if "http://" in line), "")
    found = re.search(r"http://\S+", said)
    assert found, said
    return found[0]


@contextmanager
def browser_beside(prefix: list[str], scratch: Path) -> Iterator[Any]:
    """A Chromium on the computer whose commands begin so."""
    playwright = pytest.importorskip("playwright.sync_api", reason="no playwright: `make vscode`")
    chromium = shutil.which("chromium")
    if chromium is None:
        pytest.skip("no chromium: apt-get install chromium")
    script = scratch / "chromium.sh"
    script.write_text(f'#!/bin/sh\nexec {shlex.join([*prefix, chromium])} "$@"\n', "utf-8")
    script.chmod(0o755)
    with playwright.sync_playwright() as driver:
        browser = driver.chromium.launch(executable_path=script, args=["--no-sandbox"])
        yield browser
        browser.close()


class FleetPage:
    """Page of a fleet, in which nothing may go wrong."""

    def __init__(self, browser: Any, address: str) -> None:
        self.wrong: list[str] = []
        self.page = browser.new_page(viewport={"width": 1280, "height": 640})
        self.page.set_default_timeout(PATIENCE * 1000)
        self.page.on("pageerror", lambda error: self.wrong.append(str(error)))
        self.page.on("console", lambda message: self.wrong.append(message.text))
        self.page.goto(address)

    def wait_for(self, robot: str, status: str, state: str) -> None:
        """Wait until a robot is shown so."""
        row = self.page.locator(f"tr.{status}[data-robot='{robot}']")
        row.get_by_text(state, exact=True).wait_for()

    def shown(self) -> dict[str, tuple[str, str]]:
        """Return the status and the states of each robot that was seen."""
        rows = self.page.evaluate(_SHOWN)
        return {robot: tuple(each) for robot, each in rows.items() if each[0] != "expected"}

    def alarms(self) -> list[str]:
        """Return the alarms."""
        found: list[str] = self.page.locator(".alarms li").all_text_contents()
        return found

    def press(self, event: str, answer: str) -> None:
        """Press the button of an event, until this is said of it."""
        said = self.page.locator("#operate [role=status]")
        while answer not in said.inner_text():
            self.page.get_by_role("button", name=event, exact=True).click()
            said.get_by_text(re.compile(": ")).wait_for()

    def draw(self, folder: Path, name: str) -> None:
        """Write pictures of the page for the handbook."""
        for scheme in ("light", "dark"):
            self.page.emulate_media(color_scheme=scheme)
            self.page.screenshot(path=folder / f"{name}-{scheme}.png")
