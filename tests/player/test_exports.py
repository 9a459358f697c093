"""Windows that a page saves: as a behaviour test, events from outside, and a picture."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any
from xml.etree import ElementTree

import pytest

from swarmdsl.cli import run

from .conftest import Visit

MODEL = """
event Go : std_msgs/Empty
endless statemachine Work {
  initial Off
  state Off { on Go -> On }
  parallel state On {
    region Do {
      initial Walk
      state Walk { do walk; on succeeded -> Rest; on aborted -> Rest }
      state Rest { after 3 s -> Walk }
    }
    region Hear {
      initial Quiet
      state Quiet { on Go -> Loud }
      state Loud {}
    }
  }
}
function walk : abstraction { action "cmd/walk" : lab_msgs/Walk }
member Robot { behavior Work }
swarm Crew { robot : Robot[2] }
"""


def test_a_window_is_saved(browser: Any, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    Path("model.swarm").write_text(MODEL, encoding="utf-8")
    events = [
        {"event": "Go", "after": 1000},
        {"event": "Go", "after": 1500, "member": "robot[1]"},
    ]
    text = "".join(f"{json.dumps(each)}\n" for each in events)
    Path("go.jsonl").write_text(text, encoding="utf-8")
    words = ["model.swarm", "--events", "go.jsonl", "--until", "10s"]
    assert run(["play", *words, "--seed", "7"]) == 0
    visit = Visit(browser, tmp_path / "run.html")
    visit.page.get_by_text("Save", exact=True).click()

    def save(title: str) -> Path:
        with visit.page.expect_download() as found:
            visit.page.get_by_role("button", name=title).click()
        path = tmp_path / str(found.value.suggested_filename)
        found.value.save_as(path)
        return path

    saved = save("Behaviour test")
    assert "scenario = { seed = 7 }" in saved.read_text(encoding="utf-8")
    assert run(["test", saved.name]) == 0
    # It is no empty test: it fails for another model.
    Path("model.swarm").write_text(MODEL.replace("after 3 s", "after 2 s"), encoding="utf-8")
    assert run(["test", saved.name]) == 1
    Path("model.swarm").write_text(MODEL, encoding="utf-8")

    inputs = [json.loads(line) for line in save("Events file").read_text().splitlines()]
    assert inputs == [
        {"event": "Go", "after": 1000, "member": "robot[0]"},
        {"event": "Go", "after": 0, "member": "robot[1]"},
        {"event": "Go", "after": 1500, "member": "robot[1]"},
    ]
    assert run(["simulate", "model.swarm", "--events", "events.jsonl", "--until", "10s"]) == 0

    root = ElementTree.parse(save("Picture")).getroot()
    titles = [each.text for each in root.iter("{http://www.w3.org/2000/svg}title")]
    assert titles[:2] == ["robot[0]: Off", "robot[0]: On.Do.Walk"]
    asked = [each for each in visit.asked if not each.startswith("blob:")]
    assert {each.partition("#")[0] for each in asked} == {visit.address}
    assert visit.wrong == []
    visit.page.close()


def test_two_runs_side_by_side(
    browser: Any, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    Path("model.swarm").write_text(MODEL, encoding="utf-8")
    Path("go.jsonl").write_text('{"event": "Go", "after": 1000}\n', encoding="utf-8")
    words = ["model.swarm", "--events", "go.jsonl", "--until", "10s"]
    assert run(["simulate", *words, "--trace-file", "other.jsonl"]) == 0
    second = '{"event": "Go", "after": 1500, "member": "robot[1]"}\n'
    with Path("go.jsonl").open("a", encoding="utf-8") as stream:
        stream.write(second)
    assert run(["play", *words, "--compare", "other.jsonl"]) == 0
    visit = Visit(browser, tmp_path / "run.html")
    panel = visit.page.locator(".of-compare")
    assert "differ from 0:02.500 on, first in robot[1]." in panel.inner_text()
    assert visit.value("player.time") == 2.5e9
    panel.get_by_role("button", name="next").click()
    panel.get_by_role("button", name="first difference").click()
    assert visit.value("player.time") == 2.5e9
    visit.page.wait_for_selector(".of-compare tr.differs")
    (row,) = panel.locator("tr.differs").all()
    assert row.locator("td").all_inner_texts()[:2] == [
        "On.Do.Rest, On.Hear.Loud",
        "\N{NOT EQUAL TO} On.Do.Rest, On.Hear.Quiet",
    ]

    # The lanes of both have one time, window and choice.
    bars = visit.page.locator(".bars")
    assert bars.count() == 2
    box = bars.nth(1).bounding_box()
    visit.page.mouse.click(box["x"] + 0.6 * box["width"], box["y"] + 50)
    assert abs(visit.value("player.time") - 6e9) < 2 * 10e9 / box["width"]
    assert visit.value("player.selected") is not None
    visit.page.keyboard.press("+")
    visit.value("player.goTime(5e9)")
    visit.value("new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(done)))")
    one, other = visit.value(
        "[...document.querySelectorAll('.cursor')].map((each) => each.style.transform)"
    )
    assert one == other
    visit.close()

    assert run(["play", *words, "--compare", "missing.jsonl"]) == 1
