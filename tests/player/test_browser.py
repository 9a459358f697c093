"""A run as a person sees it, in a browser."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import pytest

from swarmdsl.base.diagnostics.collector import Diagnostics
from swarmdsl.base.source import Source
from swarmdsl.cli import run
from swarmdsl.tools.player.page import page
from swarmdsl.tools.player.record import record_traces
from swarmdsl.tools.player.recording import Recording

from .conftest import ROOT, Visit
from .lines import lines_of, moment

LONG = 40_000
MEMBERS = 50


def written(folder: Path, lines: list[dict[str, Any]]) -> Path:
    """Write the page of lines."""
    source = Source("run.jsonl", "".join(f"{json.dumps(line)}\n" for line in lines))
    report = Diagnostics()
    recording = record_traces([source], None, report)
    assert recording is not None
    assert not report.has_errors
    path = folder / "run.html"
    path.write_text(page(recording), encoding="utf-8")
    return path


def test_a_mission_opens_at_the_moment_of_its_address(browser: Any, sar: Path) -> None:
    assert sar.stat().st_size <= 250_000
    text = sar.read_text(encoding="utf-8")
    recording = text.partition('id="recording">')[2].partition("</script>")[0]
    assert len(text) - len(recording) <= 80_000
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


def test_keys_lead_to_every_kind_of_line_and_back(browser: Any, tmp_path: Path) -> None:
    lines = list(lines_of(3_000, 5))
    path = written(tmp_path, lines)
    visit = Visit(browser, path)
    kinds = {
        "e": lambda line: line["member"] == "talker[1]",
        "s": lambda line: line["sent"],
        "f": lambda line: line["event"] == "fault.lost",
    }
    visit.page.keyboard.press("m")
    visit.page.keyboard.press("m")
    assert visit.value("player.selected") == "talker[1]"
    for key, fits in kinds.items():
        visit.page.keyboard.press("Home")
        visit.page.keyboard.press(key)
        first, second = [number for number, line in enumerate(lines) if number and fits(line)][:2]
        assert visit.value("player.index") == first
        visit.page.keyboard.press(key)
        assert visit.value("player.index") == second
        visit.page.keyboard.press(key.upper())
        assert visit.value("player.index") == first
    visit.page.keyboard.press("b")
    visit.page.keyboard.press("End")
    assert visit.value("player.index") == len(lines) - 1
    visit.page.keyboard.press("[")
    assert visit.value("player.index") == first
    visit.page.keyboard.press("v")
    assert visit.value("player.index") == first
    visit.page.keyboard.press("?")
    assert visit.page.locator("dialog").is_visible()
    visit.page.keyboard.press("Escape")
    visit.page.keyboard.press("/")
    visit.page.keyboard.type("talker[3]")
    states = visit.value("player.moment.members[3].states")
    said = ", ".join(state.rpartition(".")[2] for state in states) or "lost"
    assert visit.page.locator(".heads button").all_inner_texts() == [f"talker[3] {said}"]
    visit.close()


def test_lanes_lead_to_a_time_zoom_and_fold(browser: Any, sar: Path) -> None:
    visit = Visit(browser, sar)
    heads = visit.page.locator(".heads")
    box = visit.page.locator(".bars").bounding_box()
    row = heads.get_by_text("uav[1]", exact=False).bounding_box()
    middle = box["x"] + box["width"] / 2
    visit.page.mouse.click(middle, row["y"] + row["height"] / 2)
    assert visit.value("player.selected") == "uav[1]"
    time, end = visit.value("[player.time, player.recording.end]")
    assert abs(time - end / 2) < end / box["width"]
    # Zoomed by two, the moment stays in its place.
    visit.page.keyboard.press("+")
    visit.page.mouse.click(middle + box["width"] / 4, row["y"] + row["height"] / 2)
    assert abs(visit.value("player.time") - end * 5 / 8) < 2 * end / box["width"]
    visit.page.get_by_role("button", name="uav (3)").click()
    assert heads.get_by_text("uav[1]", exact=False).count() == 0
    assert (
        visit.page.get_by_role("button", name="uav (3)").get_attribute("aria-expanded") == "false"
    )
    visit.page.get_by_role("button", name="uav (3)").click()
    assert heads.get_by_text("uav[1]", exact=False).count() == 1
    visit.close()


def test_a_long_run_is_small_and_every_moment_is_that_of_its_lines(
    browser: Any, tmp_path: Path
) -> None:
    lines = list(lines_of(LONG, MEMBERS))
    path = written(tmp_path, lines)
    assert path.stat().st_size <= 800_000
    visit = Visit(browser, path)
    names = visit.value("player.recording.members.map((each) => each.name)")
    for index in (0, 49, 511, 512, 513, 20_000, LONG - 1):
        found = visit.value(f"(player.go({index}), player.moment.members)")
        expected = moment(lines, index)
        for name, each in zip(names, found, strict=True):
            if name in expected:
                assert {key: each[key] for key in expected[name]} == expected[name]
            else:
                assert each["line"] == -1
        line = visit.value(f"player.recording.line({index})")
        given = {key: value for key, value in line.items() if key not in ("time", "index")}
        assert given == lines[index]
    messages = visit.value(
        "player.recording.messages.map((each) => [each.line, each.sent, each.fate])"
    )
    assert messages == [
        [number, line["envelope"]["sent"], "ignored" if line.get("ignored") else "taken"]
        for number, line in enumerate(lines)
        if "envelope" in line
    ]
    visit.close()


HOSTILE = '<script>document.title = "bad"</script><img src=x onerror=alert(1)>\u202egnp[0]'


@pytest.mark.parametrize("key", ["member", "event", "state"])
def test_names_of_a_trace_are_text(browser: Any, tmp_path: Path, key: str) -> None:
    lines = list(lines_of(40, 2))
    for line in lines:
        if key == "state":
            line["configuration"] = [HOSTILE]
        else:
            line[key] = HOSTILE if line[key] else line[key]
    visit = Visit(browser, written(tmp_path, lines))
    visit.page.keyboard.press("End")
    visit.until("document.querySelector('.said').textContent.includes('<script>')")
    assert visit.value("document.querySelectorAll('img, #main script').length") == 0
    assert "\u202e" not in visit.value("document.body.innerText")
    assert visit.page.title() == "Run"
    visit.close()


def test_a_browser_that_cannot_unpack_says_so(browser: Any, sar: Path) -> None:
    tab = browser.new_page()
    tab.add_init_script("delete globalThis.DecompressionStream")
    tab.goto(sar.as_uri())
    tab.wait_for_selector("[role=alert] >> text=This browser cannot unpack the recording")
    tab.close()


def test_a_machine_alone_and_dark_colours(browser: Any, tmp_path: Path) -> None:
    """Everything that a click does is a button, a tab, a box or a slider with a name."""
    path = tmp_path / "run.html"
    model = ROOT / "examples" / "minimal"
    assert run(["play", str(model), "--machine", "Blinking", "--until", "5s", "-o", str(path)]) == 0
    visit = Visit(browser, path, color_scheme="dark")
    assert visit.value("getComputedStyle(document.body).backgroundColor") == "rgb(22, 25, 29)"
    unnamed = """[...document.querySelectorAll("button, input, select, canvas, [role=tab]")]
      .filter((each) => !(each.ariaLabel || each.textContent.trim() || each.labels?.length
        || each.getAttribute("aria-hidden"))).map((each) => each.outerHTML)"""
    assert visit.value(unnamed) == []
    visit.page.keyboard.press("End")
    visit.until("document.querySelector('[role=status]').textContent.includes('Blinking: ')")
    visit.close()


def test_values_that_no_simulator_writes_leave_every_view_whole(
    browser: Any, tmp_path: Path
) -> None:
    odd: list[dict[str, Any]] = [
        {"data": None, "envelope": {}, "taken": ["nope->9"]},
        {"envelope": {"sender": "zz"}, "sent": ["X"], "nobody": ["X", 3], "scheduled": 5},
        {"member": "__proto__", "event": "constructor", "configuration": ["toString"]},
        {"member": "", "event": "", "configuration": [], "at": [1e308, -1e308]},
        {"variables": {"__proto__": {"x": 1}, "v": [{"z": None}]}, "recalled": 1, "cause": 2},
        {"event": "\ud800", "data": float("nan"), "at": [float("inf"), 1]},
        {"event": "Go", "data": 2**70},
    ]
    lines = [*lines_of(20, 2)]
    lines += [{**lines[0], "t": lines[-1]["t"] + number, **each} for number, each in enumerate(odd)]
    beside: list[dict[str, Any]] = [
        {"property": "P", "verdict": 3},
        {"measures": [None, {"name": "m"}]},
        {"moved": {"talker[0]": [1, "x"]}},
        {"lost": {"event": "X", "sender": "talker[0]", "member": "nobody", "sent": 3}},
        {"lost": {}, "moved": {"q[0]": [1, 2, 3]}, "links": 3, "targets": [], "saw": 1},
    ]
    lines += [{"t": lines[-1]["t"], **each} for each in beside]
    visit = Visit(browser, written(tmp_path, lines))
    count = visit.value("player.recording.count")
    tabs = visit.page.locator(".panel").first.locator("[role=tab]")
    assert tabs.count() > 3
    for number in range(tabs.count()):
        tabs.nth(number).click()
        for index in range(20, count):
            visit.value(f"player.go({index})")
            visit.value("new Promise((done) => requestAnimationFrame(() => done(1)))")
        assert visit.page.locator(".view .error").count() == 0
    visit.close()


def test_names_that_all_objects_have_leave_every_view_whole(browser: Any, tmp_path: Path) -> None:
    """A trace of another version of the model, whose names mean something in JavaScript."""
    model, trace = tmp_path / "model.swarm", tmp_path / "run.jsonl"
    model.write_text(
        "package lab\nevent Go : std_msgs/Empty\nendless statemachine Blink {\n  initial Off\n"
        "  state Off { on Go -> On }\n  state On { on Go -> Off }\n}\n",
        encoding="utf-8",
    )
    (line, *_) = lines_of(1, 1)
    odd: list[dict[str, Any]] = [
        {"member": None, "configuration": ["Off"], "entered": ["Off"], "variables": {"a": 1}},
        {"taken": ["constructor"], "entered": ["toString"], "configuration": ["valueOf"]},
        {"event": "Go", "member": "constructor[0]", "variables": {"toString": 1}, "at": [1, 2]},
        {"event": "Go", "at": [1, 2, 3], "variables": {"valueOf": 1}},
        {"event": "Go", "member": "uav\u202e[0]", "configuration": ["A\u202eB"]},
    ]
    trace.write_text("".join(f"{json.dumps({**line, **each})}\n" for each in odd), encoding="utf-8")
    path = tmp_path / "run.html"
    assert run(["play", str(model), "--trace", str(trace), "-o", str(path)]) == 1
    visit = Visit(browser, path)
    tabs = visit.page.locator(".panel").first.locator("[role=tab]")
    assert tabs.get_by_text("Model", exact=True).count() == 1
    names = visit.value("player.recording.members.map((each) => each.name)")
    for number in range(tabs.count()):
        tabs.nth(number).click()
        for index, name in ((index, name) for index in range(5) for name in (None, *names)):
            visit.page.evaluate(
                "([at, name]) => (player.select(name), player.go(at))", [index, name]
            )
            visit.value("new Promise((done) => requestAnimationFrame(() => done(1)))")
        assert visit.page.locator(".view .error").count() == 0
    visit.close()
    # A state, and a machine, whose names cannot be shown as they are.
    visit = Visit(browser, written(tmp_path, [{**line, **odd[-1]}, line]))
    visit.page.get_by_label("State machine").select_option(index=0)
    visit.page.wait_for_selector(".states .lit")
    visit.close()


def test_lanes_are_as_high_as_their_rows_up_to_half_of_the_page(
    browser: Any, tmp_path: Path
) -> None:
    small = {"width": 1280, "height": 720}
    visit = Visit(browser, written(tmp_path, list(lines_of(20, 2))), viewport=small)
    few = visit.page.locator(".lanes").bounding_box()
    assert few["height"] < 140
    assert visit.page.locator("#panels").bounding_box()["height"] > 350
    visit.close()
    visit = Visit(browser, written(tmp_path, list(lines_of(200, 50))), viewport=small)
    many = visit.page.locator("#main").bounding_box()
    assert 300 < many["height"] <= 0.56 * small["height"]
    assert visit.value("document.documentElement.scrollHeight") == small["height"]
    # A moment that is not in the window comes into it.
    visit.page.keyboard.press("End")
    for _ in range(4):
        visit.page.keyboard.press("+")
    visit.page.keyboard.press("Home")
    visit.page.wait_for_function(
        "() => document.querySelector('.cursor').getBoundingClientRect().width > 0"
    )
    visit.close()


def test_an_address_names_one_of_several_lines_of_a_time(browser: Any, tmp_path: Path) -> None:
    lines = [{**line, "t": 50 * (number // 5)} for number, line in enumerate(lines_of(20, 2))]
    path = written(tmp_path, lines)
    for fragment, index in (
        ("#t=50ms", 9),
        ("#t=50ms&line=7", 6),
        ("#t=50ms&line=3", 9),
        ("#t=50ms&line=1e9", 9),
        ("#t=1.2.3&line=x&m=nobody", 0),
    ):
        visit = Visit(browser, path, fragment)
        assert visit.value("player.index") == index
        visit.close()
    visit = Visit(browser, path, "#t=50ms&line=7")
    visit.page.keyboard.press("ArrowRight")
    visit.page.wait_for_function("() => location.hash.startsWith('#t=0.05s&line=8&')")
    visit.close()


def test_a_run_without_a_line_is_an_empty_page(browser: Any, tmp_path: Path) -> None:
    path = tmp_path / "run.html"
    path.write_text(page(Recording("Nothing", [], [], [])), encoding="utf-8")
    visit = Visit(browser, path)
    for key in ("End", "Home", "ArrowRight", "v", " ", "b", "+", "m"):
        visit.page.keyboard.press(key)
    assert visit.page.locator(".said").first.inner_text() == "nothing has happened yet"
    assert visit.page.locator("[role=alert]").count() == 0
    visit.close()
