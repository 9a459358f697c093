"""A run as a person sees it, in Firefox."""

from __future__ import annotations

import shutil
from collections.abc import Iterator
from pathlib import Path

import pytest

from .firefox import Firefox

PROGRAM = shutil.which("firefox-esr") or shutil.which("firefox")
pytestmark = pytest.mark.skipif(PROGRAM is None, reason="no firefox: apt-get install firefox-esr")


@pytest.fixture(scope="module")
def firefox(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Firefox]:
    assert PROGRAM is not None
    started = Firefox(PROGRAM, tmp_path_factory.mktemp("profile"))
    yield started
    started.close()


def test_a_mission_is_played_without_a_request(firefox: Firefox, sar: Path) -> None:
    firefox.open(sar.as_uri() + "#t=10min&m=uav[1]")
    assert firefox.value("[player.time, player.selected]") == [600e9, "uav[1]"]
    states = firefox.value("player.moment.members.map((each) => each.states)")
    assert states[0] == ["Mission.Tracking"]
    assert states[3] == ["Mission.Rescue.Drive", "Mission.Watch.Watching"]
    assert firefox.value("performance.getEntriesByType('resource').length") == 0
    drawn = """(() => {
      const canvas = document.querySelector("canvas");
      const row = canvas.getContext("2d").getImageData(0, 60, canvas.width, 1).data;
      const colours = new Set();
      for (let at = 0; at < row.length; at += 4) colours.add(row.slice(at, at + 3).join());
      return colours.size;
    })()"""
    assert firefox.value(drawn) > 3
    assert "rover[0]" in firefox.value("document.querySelector('.said').textContent")
