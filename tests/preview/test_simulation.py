"""Simulation that the page of `swarmc preview` drives, in Chromium on the server and the engine."""

from __future__ import annotations

import json
import shutil
from pathlib import Path
from typing import Any

import pytest

from .served import PATIENCE, Browser, served

MODEL = """package work
message Order { load : int32 }
event Go : Order
message Nothing {}
event Halt : Nothing
property Light of Team : never count(digger in Out) > 2
endless statemachine Job {
  var carried : int32
  initial Home
  state Home { on Go [event.load > 1] / carried = event.load -> Out }
  state Out { after 5 s / carried = carried - 1 -> Home; on Halt -> Home }
}
member Digger { behavior Job }
swarm Team { digger : Digger[1..3] }
"""
JSON = {"Content-Type": "application/json"}


@pytest.fixture
def model(tmp_path: Path) -> Path:
    path = tmp_path / "work.swarm"
    path.write_text(MODEL, encoding="utf-8")
    (tmp_path / "three.toml").write_text("count.digger = 3\n", encoding="utf-8")
    (tmp_path / "bad.toml").write_text("count.diger = 3\n", encoding="utf-8")
    (tmp_path / "swarm.toml").write_text("", encoding="utf-8")
    (tmp_path / "study.toml").write_text('scenario = "three.toml"\nseed = 3\n', encoding="utf-8")
    return path


def asked(browser: Browser, wish: object, **headers: str) -> Any:
    answer = browser.post("/simulate", json.dumps(wish), {**JSON, **headers})
    return json.loads(answer.read()) if answer.status == 200 else answer.status


def test_wishes_of_pages(model: Path) -> None:
    with served(model) as browser:
        offers = browser.told()
        assert list(offers["subjects"]) == ["swarm Team", "state machine Job"]
        assert offers["scenarios"] == ["bad.toml", "three.toml"]
        for wish, why in (
            (3, "not an object"),
            ({"run": 1}, "expected one of start, request, event, look, speed, breakpoint"),
            ({"start": 3}, "the model has no None that runs"),
            ({"start": {"subject": "swarm Team", "scenario": "/etc/passwd"}}, "no scenario"),
            ({"request": "continue"}, "nothing is simulated"),
            ({"request": ["continue"]}, "there is no request"),
            ({"event": "Go"}, "nothing is simulated"),
            ({"breakpoint": "Out"}, "a breakpoint is on a `breakpoint` of a `diagram`"),
            ({"breakpoint": "Oat", "diagram": "Job.statechart"}, "no state or transition `Oat`"),
        ):
            assert why in asked(browser, wish)["failed"], wish
        # Pages of others cannot drive it.
        start = {"start": {"subject": "swarm Team"}}
        assert asked(browser, start, Origin="https://example.org") == 403
        assert asked(browser, start, Host=f"example.org:{browser.port}") == 403
        assert browser.get("/simulate").status == 404
        own = f"http://127.0.0.1:{browser.port}"
        assert asked(browser, {"request": "terminate"}, Origin=own) == {}


@pytest.mark.skipif(shutil.which("chromium") is None, reason="no browser: apt-get install chromium")
def test_a_page_simulates(model: Path) -> None:
    playwright = pytest.importorskip("playwright.sync_api", reason="no playwright: `make vscode`")
    with served(model) as browser, playwright.sync_playwright() as driver:
        chromium = driver.chromium.launch(
            executable_path=shutil.which("chromium"), args=["--no-sandbox"]
        )
        page = chromium.new_page()
        wrong: list[object] = []
        page.on("pageerror", lambda error: wrong.append(error))
        expect = playwright.expect
        expect.set_options(timeout=PATIENCE * 1000)
        page.goto(f"http://127.0.0.1:{browser.port}/#Job.statechart")
        bar, press = page.locator("#debug"), page.keyboard.press
        lit, said = page.locator("#picture .node.lit"), bar.locator(".said")
        where, values = bar.locator(".where"), bar.locator(".values")

        def button(name: str) -> Any:
            return bar.get_by_role("button", name=name, exact=True)

        def choose(label: str, option: str) -> None:
            bar.get_by_label(label).select_option(option)

        # What is wrong is said, and it can be started again.
        choose("Scenario", "bad.toml")
        button("Simulate").click()
        expect(said).to_contain_text("bad.toml:1:7: error[SW0202]")
        expect(said).to_have_class("said wrong")
        choose("Scenario", "three.toml")
        expect(bar.get_by_label("Speed of Continue")).to_have_value("1")
        choose("Speed of Continue", "at once")
        button("Simulate").focus()
        press("Enter")
        expect(where).to_have_text("swarm Team, at 0.000 s")
        expect(button("Continue")).to_be_focused()
        expect(lit).to_have_attribute("data-id", "Home")
        expect(page.locator("#picture .count")).to_have_count(0)

        # The keys step on from wherever the focus is; the second robot has started.
        page.locator("#view").focus()
        press("n")
        expect(page.locator("#picture .count text")).to_have_text("2")
        expect(bar.get_by_label("Robot to look at").locator("option")).to_have_count(3)
        button("Continue").click()
        expect(said).to_have_text(
            "nothing is left to happen: send an event, or continue to the end"
        )

        # An event with data, by the keyboard.
        button("Go").focus()
        press("Enter")
        entry = bar.get_by_label("Data of Go")
        expect(entry).to_be_focused()
        expect(entry).to_have_value('{"load":0}')
        entry.fill("[1]")
        press("Enter")
        expect(bar.locator("form")).to_contain_text("not a JSON object")
        entry.fill('{"load": 7}')
        press("Enter")
        expect(lit).to_have_count(2)
        expect(button("Halt")).to_be_visible()
        expect(values).to_have_text("carried = 7")
        page.reload()
        expect(values).to_have_text("carried = 7")
        expect(bar.get_by_label("Speed of Continue")).to_have_value("")
        button("Continue").click()
        expect(said).to_have_text("property `Light` is violated")
        expect(lit).to_have_attribute("data-id", "Out")

        # Another robot is looked at, and the next step into one is that of it.
        who = bar.get_by_label("Robot to look at")
        expect(who).to_have_value("3")
        choose("Robot to look at", "digger[1]")
        expect(values).to_have_text("carried = 7")
        press("i")
        expect(where).to_have_text("swarm Team, at 5.000 s")
        expect(who).to_have_value("2")
        button("Step").click()
        expect(values.locator(".changed")).to_have_text("carried = 6")
        button("Back").click()
        expect(who).to_have_value("1")
        expect(values).to_have_text("carried = 6")

        # A mistake in the model does not end it; what is mended runs from the start.
        model.write_text(MODEL.replace("-> Out }", "-> Aut }"), encoding="utf-8")
        expect(said).to_have_text("the model has changed: Restart runs it as it is now")
        button("Restart").click()
        expect(said).to_contain_text("error[SW0202]: no state called `Aut`")
        model.write_text(MODEL.replace("Home", "Base"), encoding="utf-8")
        expect(page.locator("#picture")).to_contain_text("Base")
        button("Restart").click()
        expect(lit).to_have_attribute("data-id", "Base")
        expect(said).to_be_empty()

        # At the speed of reality it can be paused.
        choose("Speed of Continue", "real time")
        button("Go").click()
        entry.fill('{"load": 2}')
        press("Enter")
        expect(lit).to_have_count(2)
        press("c")
        expect(said).to_have_text("property `Light` is violated")
        press("c")
        expect(button("Pause")).to_be_visible()
        expect(button("Step")).to_be_disabled()
        press("c")
        expect(button("Continue")).to_be_visible()
        expect(button("Halt")).to_be_visible()

        # A breakpoint is set with the pointer or the keyboard, and stays when the text moves.
        dots, menu = page.locator("#picture .stop"), page.get_by_role("menu")
        base = page.locator("#picture .node[data-id='Base']")
        going = menu.get_by_role("menuitemcheckbox", name="Breakpoint on Go")
        base.click(button="right")
        going.click()
        expect(dots).to_have_count(1)
        base.focus()
        press("F9")
        expect(dots).to_have_count(2)
        press("F9")
        expect(dots).to_have_count(1)
        model.write_text(f"// Work.\n{MODEL.replace('Home', 'Base')}", encoding="utf-8")
        expect(said).to_have_text("the model has changed: Restart runs it as it is now")
        button("Restart").click()
        expect(said).to_be_empty()
        expect(where).to_have_text("swarm Team, at 0.000 s")
        button("Go").click()
        entry.fill('{"load": 2}')
        press("Enter")
        expect(said).to_have_text("at a breakpoint: digger[0], at 0 ms")
        expect(lit).to_have_attribute("data-id", "Base")
        base.click(button="right")
        expect(going).to_have_attribute("aria-checked", "true")
        press("Escape")
        expect(menu).to_be_hidden()
        button("End").click()
        page.reload()
        expect(dots).to_have_count(1)
        base.click(button="right")
        menu.get_by_role("menuitem", name="Remove all breakpoints").click()
        expect(dots).to_have_count(0)
        expect(button("Simulate")).to_be_visible()
        expect(lit).to_have_count(0)
        chromium.close()
    assert wrong == []
