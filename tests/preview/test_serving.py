"""Tests of `swarmc preview` through HTTP and a browser."""

from __future__ import annotations

import json
import os
import re
import shutil
import socket
import subprocess
import sys
import time
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest

from .served import PATIENCE, Browser, served

pytestmark = pytest.mark.skipif(os.name != "posix", reason="signals of POSIX")

MACHINE = """package work
statemachine Work {
  initial Busy
  state Busy { after 1 s -> Ready }
  final Ready
}
statemachine Rest { initial Nap; state Nap { after 1 s -> Awake } final Awake }
"""
NESTED = """package work
statemachine Rest { initial Nap; state Nap { after 1 s -> Awake } final Awake }
endless statemachine Job {
  var naps : int32; initial Out
  state Out {
    initial Dig
    state Dig { after 1 s -> Rest }
    state Rest { after 1 s -> Home }
  }
  state Home { after 1 s / naps = naps + 1; after 2 s -> Out; after 3 s -> Out.Rest }
}
member Digger { behavior Job }
swarm Team { digger : Digger[2] }
"""

# Records highlighted transitions, which are highlighted only briefly.
WATCH = """
  window.flashed = [];
  const note = (all) => all.forEach(({ target }) =>
    target.classList.contains("taken") && flashed.push(target.dataset.id));
  new MutationObserver(note).observe(document.getElementById("picture"),
    { attributeFilter: ["class"], subtree: true });
"""


def step(member: str, *states: str, **more: Any) -> str:
    names = ("entered", "exited", "taken", "started", "cancelled", "sent")
    line = {"t": 0, "member": member, "event": None, "configuration": states}
    return json.dumps({**line, **{name: [] for name in names}, **more}) + "\n"


@pytest.fixture
def model(tmp_path: Path) -> Path:
    path = tmp_path / "work.swarm"
    path.write_text(MACHINE, encoding="utf-8")
    return path


@pytest.fixture
def browser(model: Path) -> Iterator[Browser]:
    with served(model) as browser:
        yield browser


def test_preview_follows_the_text(browser: Browser, model: Path) -> None:
    assert browser.told() == {
        "titles": {
            "Work.statechart": "Work (state machine)",
            "Rest.statechart": "Rest (state machine)",
        },
        "runs": {"Work.statechart": [["Work", ""]], "Rest.statechart": [["Rest", ""]]},
        "subjects": {
            "state machine Work": "Work.statechart",
            "state machine Rest": "Rest.statechart",
        },
        "scenarios": [],
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


def test_closed_page_leaves_others_open(browser: Browser, model: Path) -> None:
    browser.told()
    gone = Browser(browser.port)
    gone.told()
    gone.leave()
    # The first write to a closed page succeeds, the next ones fail.
    for name in ("Done", "Ended", "Over"):
        model.write_text(MACHINE.replace("Ready", name), encoding="utf-8")
        assert "titles" in browser.told()


def test_new_page_gets_diagrams_and_errors(browser: Browser, model: Path) -> None:
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


def test_foreign_pages_are_rejected(browser: Browser) -> None:
    for path in ("/", "/events", "/picture?Work.statechart"):
        assert browser.get(path, host=f"example.org:{browser.port}").status == 403


@pytest.mark.skipif(shutil.which("chromium") is None, reason="no browser: apt-get install chromium")
def test_page_in_a_browser(browser: Browser, model: Path, tmp_path: Path) -> None:
    playwright = pytest.importorskip("playwright.sync_api", reason="no playwright: `make vscode`")
    with playwright.sync_playwright() as driver:
        options = {"executable_path": shutil.which("chromium"), "args": ["--no-sandbox"]}
        chromium = driver.chromium.launch(**options)
        page = chromium.new_page()
        wrong: list[object] = []
        page.on("pageerror", lambda error: wrong.append(error))
        page.goto(f"http://127.0.0.1:{browser.port}/#Rest.statechart")
        expect = playwright.expect
        expect.set_options(timeout=PATIENCE * 1000)
        picture = page.locator("#picture")
        expect(picture).to_contain_text("Nap")
        page.locator("#which").select_option("Work.statechart")
        expect(picture).to_contain_text("Busy")

        model.write_text(MACHINE.replace("-> Ready", "-> Raedy"), encoding="utf-8")
        expect(page.locator("#state")).to_have_text("1 error: showing the last valid version")
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


@pytest.mark.skipif(shutil.which("chromium") is None, reason="no browser: apt-get install chromium")
def test_states_fold_and_are_highlighted(tmp_path: Path) -> None:
    playwright = pytest.importorskip("playwright.sync_api", reason="no playwright: `make vscode`")
    model, trace = tmp_path / "work.swarm", tmp_path / "trace.jsonl"
    model.write_text(NESTED, encoding="utf-8")
    places = tmp_path / "places.txt"
    editor = tmp_path / "editor"
    editor.write_text(f'#!/bin/sh\necho "$@" >> "{places}"\n', encoding="utf-8")
    editor.chmod(0o755)
    options = ["--follow", str(trace), "--editor", f"{editor} at {{line}}:{{column}} {{file}}"]
    with served(model, *options) as browser, playwright.sync_playwright() as driver:
        chromium = driver.chromium.launch(
            executable_path=shutil.which("chromium"), args=["--no-sandbox"]
        )
        page = chromium.new_page()
        wrong: list[object] = []
        page.on("pageerror", lambda error: wrong.append(error))
        page.goto(f"http://127.0.0.1:{browser.port}/#Job.statechart")
        expect = playwright.expect
        expect.set_options(timeout=PATIENCE * 1000)
        picture, fold = page.locator("#picture"), page.locator(".fold")
        expect(picture).to_contain_text("Dig")
        fold.click()
        expect(picture).not_to_contain_text("Dig")
        expect(picture).to_contain_text("Home")
        # It stays folded after edits and reloads.
        model.write_text(NESTED.replace("Home", "House"), encoding="utf-8")
        expect(picture).to_contain_text("House")
        expect(picture).not_to_contain_text("Dig")
        page.reload()
        expect(picture).to_contain_text("House")
        expect(picture).not_to_contain_text("Dig")

        active = picture.locator(".node.lit")
        expect(active).to_have_count(0)
        trace.write_text(
            step("digger[0]", "Out.Dig") + step("digger[1]", "Out.Rest"), encoding="utf-8"
        )
        expect(active).to_have_count(1)
        expect(active).to_have_attribute("data-id", "Out")
        expect(picture.locator(".count")).to_contain_text("2")
        fold.click()
        expect(active).to_have_count(2)
        expect(picture.locator(".around")).to_have_attribute("data-id", "Out")
        who = page.locator("#who")
        who.select_option("digger[1]")
        expect(active).to_have_count(1)
        expect(active).to_have_attribute("data-id", "Out.Rest")
        page.evaluate(WATCH)
        with trace.open("a", encoding="utf-8") as file:
            file.write(step("digger[0]", "Out.Rest", taken=("Out.Dig->0",)))
            file.write(step("digger[1]", "House", taken=("Out.Rest->0",)))
        expect(picture.locator(".node.lit[data-id=House]")).to_have_count(1)
        expect(active).to_have_count(1)
        page.wait_for_function("flashed.length")
        assert page.evaluate("flashed") == ["Out.Rest->0"], "that of whom is chosen"
        expect(picture.locator(".taken")).to_have_count(0)

        def flashed(last: str, *states: str, **more: Any) -> set[str]:
            """Return the ids highlighted when a robot takes `last` and then ends."""
            page.evaluate("flashed.length = 0")
            with trace.open("a", encoding="utf-8") as file:
                file.write(step("digger[1]", *states, **more))
            page.wait_for_function("last => flashed.includes(last)", arg=last)
            expect(picture.locator(".taken")).to_have_count(0)
            return set(page.evaluate("flashed"))

        dig = ["Out", "Out.Dig"]
        begun = flashed("#initial->", "Out.Dig", entered=dig)
        assert begun == {"#initial->", "Out#initial->"}
        assert flashed("House->0", "House", event="after", taken=["House->0"]) == {"House->0"}
        out = flashed("House->1", "Out.Dig", event="after", taken=["House->1"], entered=dig)
        assert out == {"House->1", "Out#initial->"}
        rest = ["Out", "Out.Rest", "Out.Dig"]  # on the way, it was there too
        aside = flashed("House->2", "Out.Dig", event="after", taken=["House->2"], entered=rest)
        assert aside == {"House->2"}, "it came to Out by another way"
        who.select_option("no highlighting")
        expect(active).to_have_count(0)
        who.select_option("all 2")
        expect(active).to_have_count(2)

        picture.get_by_text("Rest", exact=True).click()
        deadline = time.monotonic() + PATIENCE
        while not places.exists() or not places.read_text(encoding="utf-8"):
            assert time.monotonic() < deadline
            time.sleep(0.05)
        assert places.read_text(encoding="utf-8") == f"at 8:11 {model}\n"

        # A machine outside of a swarm is highlighted only in its own diagram.
        trace.write_text(step("Job (a.jsonl)", "Out.Rest"), encoding="utf-8")
        expect(active).to_have_count(1)
        expect(active).to_have_attribute("data-id", "Out.Rest")
        expect(who).to_have_text(re.compile(r"^Job \(a\.jsonl\)"))
        page.locator("#which").select_option("Rest.statechart")
        expect(picture).to_contain_text("Nap")
        expect(who).to_be_hidden()
        chromium.close()
    assert wrong == []


@pytest.mark.skipif(shutil.which("chromium") is None, reason="no browser: apt-get install chromium")
def test_active_states_before_the_diagrams(tmp_path: Path) -> None:
    playwright = pytest.importorskip("playwright.sync_api", reason="no playwright: `make vscode`")
    model, trace = tmp_path / "work.swarm", tmp_path / "trace.jsonl"
    model.write_text(NESTED.replace("-> Home", "-> Hmoe"), encoding="utf-8")
    trace.write_text(step("digger[0]", "Out.Dig"), encoding="utf-8")
    options = ["--follow", str(trace)]
    with served(model, *options) as browser, playwright.sync_playwright() as driver:
        chromium = driver.chromium.launch(
            executable_path=shutil.which("chromium"), args=["--no-sandbox"]
        )
        page = chromium.new_page()
        page.goto(f"http://127.0.0.1:{browser.port}/")
        expect = playwright.expect
        expect.set_options(timeout=PATIENCE * 1000)
        expect(page.locator("#state")).to_contain_text("error")
        model.write_text(NESTED, encoding="utf-8")
        expect(page.locator("#which")).to_have_value("Job.statechart")
        expect(page.locator("#picture .node.lit")).to_have_attribute("data-id", "Out.Dig")
        chromium.close()


def test_only_the_page_opens_only_places_of_the_model(model: Path) -> None:
    address = "cool-editor://{file}?{line}"
    with served(model, "--editor", address) as browser:
        browser.told()
        assert browser.opened(f"{model}:4:9") == {"address": f"cool-editor://{model}?4"}
        for place in ("/etc/passwd:1:1", f"{model}", "", 3, {"place": 1}):
            assert "failed" in browser.opened(place)
        form = {"Content-Type": "text/plain"}
        assert browser.post("/open", f'"{model}:4:9"', form).status == 403
        others = {"Content-Type": "application/json", "Host": f"example.org:{browser.port}"}
        assert browser.post("/open", f'"{model}:4:9"', others).status == 403
        assert browser.post("/picture", '""', {"Content-Type": "application/json"}).status == 403


def test_places_in_a_project_are_absolute(model: Path) -> None:
    """An editor must not read a file name as an option."""
    with served(model, "--editor", "cool-editor://{file}?{line}", named=False) as browser:
        browser.told()
        assert browser.opened(f"{model}:4:9") == {"address": f"cool-editor://{model}?4"}


def test_port_of_a_component_in_another_file_is_a_place(tmp_path: Path) -> None:
    (tmp_path / "parts.swarm").write_text(
        "package parts\nmessage Image {}\nsensor Eye { out image : Image }", encoding="utf-8"
    )
    rover = tmp_path / "rover.swarm"
    rover.write_text(
        'package rovers\nimport "parts.swarm"\nmember Rover { eye : Eye }', encoding="utf-8"
    )
    with served(rover, "--editor", "cool-editor://{file}?{line}") as browser:
        browser.told()
        place = tmp_path / "parts.swarm"
        assert browser.opened(f"{place}:3:14") == {"address": f"cool-editor://{place}?3"}


def test_invalid_places(model: Path) -> None:
    with served(model, "--editor", "cool-editor://{file}?{line}") as browser:
        browser.told()
        form = {"Content-Type": "application/json"}
        assert b"failed" in browser.post("/open", "[" * 60_000, form).read()


def test_a_port_that_is_taken(model: Path) -> None:
    with socket.socket() as taken:
        taken.bind(("127.0.0.1", 0))
        taken.listen()
        port = str(taken.getsockname()[1])
        command = [sys.executable, "-m", "swarmdsl", "preview", str(model), "--port", port]
        ran = subprocess.run(command, capture_output=True, text=True, timeout=PATIENCE)
    assert (ran.returncode, "already in use" in ran.stderr) == (1, True)
