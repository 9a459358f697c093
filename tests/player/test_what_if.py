"""A branch of a run in a browser: other events, another outcome, and a test that is saved."""

from __future__ import annotations

import shutil
from pathlib import Path
from typing import Any

import pytest

from swarmdsl.cli import run

from .conftest import SAR, Visit

TAB = '[role="tab"]:text-is("What if")'


def test_a_mission_goes_on_in_another_way(browser: Any, sar: Path, tmp_path: Path) -> None:
    visit = Visit(browser, sar, "#t=1min&m=uav[1]")
    page = visit.page
    page.click(TAB)
    page.click('button:has-text("Fork at")')
    panel = page.locator(".of-what-if")
    said = panel.locator("[role=status]").inner_text()
    assert "it is 1 min 0 s" in said
    assert "did not do as" not in said
    assert panel.locator("li").count() == 0
    panel.get_by_role("button", name="aborted").first.click()
    assert "uav[1]: do." in panel.locator("li").last.inner_text()
    panel.get_by_role("button", name="10 s", exact=True).click()
    assert "it is 1 min 10 s" in panel.locator("[role=status]").inner_text()
    with page.expect_download() as download:
        panel.get_by_role("button", name="Save as test").click()
    folder = tmp_path / "model"
    shutil.copytree(SAR, folder, ignore=shutil.ignore_patterns("*.toml"))
    download.value.save_as(folder / "branch.swarmtest.toml")
    assert run(["test", str(folder)]) == 0
    panel.get_by_role("button", name="Drop").click()
    assert panel.get_by_role("button", name="Fork at").count() == 1
    visit.close()


@pytest.mark.parametrize("message", ["{", '{"nothing": 1}'])
def test_wrong_messages_are_told(browser: Any, sar: Path, message: str) -> None:
    visit = Visit(browser, sar, "#t=0s&m=uav[1]")
    visit.page.click(TAB)
    visit.page.click('button:has-text("Fork at")')
    panel = visit.page.locator(".of-what-if")
    field = panel.locator("input:visible").first
    field.fill(message)
    field.locator("xpath=preceding-sibling::button").click()
    assert "Stopped: the message" in panel.locator("[role=status]").inner_text()
    visit.close()
