"""Pages of runs, in browsers."""

from __future__ import annotations

import shutil
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest

from swarmdsl.cli import run

ROOT = Path(__file__).resolve().parents[2]
SAR = ROOT / "examples" / "search_and_rescue"


@pytest.fixture(scope="session")
def sar(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The page of the mission of search and rescue, 20 minutes."""
    path = tmp_path_factory.mktemp("player") / "mission run.html"
    assert run(["play", str(SAR), "--scenario", str(SAR / "mission.toml"), "-o", str(path)]) == 0
    return path


# Not for longer: while a browser is driven, no test with asyncio runs.
@pytest.fixture(scope="module")
def browser() -> Iterator[Any]:
    """A Chromium."""
    playwright = pytest.importorskip("playwright.sync_api", reason="no playwright: `make vscode`")
    if shutil.which("chromium") is None:
        pytest.skip("no chromium: apt-get install chromium")
    with playwright.sync_playwright() as driver:
        options = {"executable_path": shutil.which("chromium"), "args": ["--no-sandbox"]}
        browser = driver.chromium.launch(**options)
        yield browser
        browser.close()


class Visit:
    """A page that is open, and what went on while it was."""

    def __init__(self, browser: Any, path: Path, fragment: str = "", **options: object) -> None:
        self.page = browser.new_page(**options)
        self.wrong: list[str] = []
        self.asked: list[str] = []
        self.page.on("console", lambda message: self.wrong.append(message.text))
        self.page.on("pageerror", lambda error: self.wrong.append(str(error)))
        self.page.on("request", lambda request: self.asked.append(request.url))
        self.address = path.as_uri()
        self.page.goto(self.address + fragment)
        self.page.wait_for_selector("html[data-ready]", state="attached")

    def value(self, script: str) -> Any:
        """Return the value of an expression in the page."""
        return self.page.evaluate(script)

    def until(self, condition: str) -> None:
        """Wait for a condition; the policy of the page forbids `wait_for_function`."""
        look = f"while (!({condition})) await new Promise(requestAnimationFrame);"
        self.page.evaluate(f"(async () => {{ {look} }})()")

    def close(self) -> None:
        """Close it; nothing was asked for but the page itself, and nothing went wrong."""
        asked = {each.partition("#")[0] for each in self.asked}
        self.page.close()
        assert asked == {self.address}
        assert self.wrong == []
