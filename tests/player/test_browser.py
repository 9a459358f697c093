"""A run as a person sees it, in a browser."""

from __future__ import annotations

from pathlib import Path
from typing import Any

from .conftest import Visit


def test_a_mission_opens_at_the_moment_of_its_address(browser: Any, sar: Path) -> None:
    visit = Visit(browser, sar, "#t=10min&m=uav[1]")
    assert visit.value("[player.time, player.selected]") == [600e9, "uav[1]"]
    states = visit.value("player.moment.members.map((each) => each.states)")
    assert states[0] == ["Mission.Tracking"]
    assert states[3] == ["Mission.Rescue.Drive", "Mission.Watch.Watching"]
    visit.page.keyboard.press("ArrowRight")
    assert visit.value("player.time > 600e9")
    visit.page.keyboard.press("ArrowLeft")
    visit.page.wait_for_function("location.hash.includes('m=uav[1]')")
    visit.close()
