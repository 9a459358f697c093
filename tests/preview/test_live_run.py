"""`swarmc simulate --live`: a page shows the map and the states while the run goes on."""

from __future__ import annotations

import json
import socket
import xml.etree.ElementTree as ET
from collections.abc import Iterator
from contextlib import contextmanager
from http.client import HTTPConnection
from pathlib import Path
from queue import SimpleQueue
from threading import Thread
from typing import Any
from urllib.parse import urlsplit

import pytest
from tests.space.worlds import TEXT

from swarmdsl.cli import run
from swarmdsl.ide.preview import live_run
from swarmdsl.ide.preview.live_run import LivePage

PATIENCE = 60
WALK = '[functions.walk]\nmodel = "random_walk"\n'
COMMAND = ["simulate", "demo.swarm", "--scenario", "s.toml", "--until", "6s", "--trace", "none"]


def text_of(svg: str) -> str:
    return "".join(ET.fromstring(svg).itertext())


class Browser:
    """Reads the events of a page, and the first picture that it asks for."""

    def __init__(self) -> None:
        self.told: SimpleQueue[dict[str, Any]] = SimpleQueue()
        self.first: dict[str, Any] = {}

    def look(self, address: str) -> None:
        place = urlsplit(address).netloc
        events = HTTPConnection(place, timeout=PATIENCE)
        events.request("GET", "/events")
        stream = events.getresponse()
        while line := stream.readline():
            if not line.startswith(b"data: "):
                continue
            message = json.loads(line.removeprefix(b"data: "))
            self.told.put(message)
            if "run" in message.get("titles", {}) and not self.first:
                pictures = HTTPConnection(place, timeout=PATIENCE)
                pictures.request("GET", "/picture?id=")
                self.first = json.loads(pictures.getresponse().read())


@pytest.fixture
def browser(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Browser:
    """Opens the page as soon as it is served."""
    monkeypatch.chdir(tmp_path)
    Path("demo.swarm").write_text(TEXT.replace("ROBOTS", "2"), encoding="utf-8")
    Path("s.toml").write_text(WALK, encoding="utf-8")
    opened = Browser()
    serving = live_run.serving

    @contextmanager
    def served(*given: Any) -> Iterator[str]:
        with serving(*given) as address:
            Thread(target=opened.look, args=(address,), daemon=True).start()
            yield address

    monkeypatch.setattr(live_run, "serving", served)
    return opened


def test_a_page_follows_the_run_to_its_end(
    browser: Browser, capsys: pytest.CaptureFixture[str]
) -> None:
    assert run([*COMMAND, "--live", "--real-time-factor", "20", "--map", "end.svg"]) == 0
    assert "in a browser: the run begins then" in capsys.readouterr().err
    titles: dict[str, str] = {}
    active: dict[str, Any] = {}
    drawn: list[str] = []
    while not drawn or "after 6 s" not in text_of(drawn[-1]):
        message = browser.told.get(timeout=PATIENCE)
        titles = message.get("titles", titles)
        active |= message.get("active", {})
        if "redrawn" in message:
            assert message["redrawn"]["id"] == "run"
            drawn.append(message["redrawn"]["svg"])
    assert next(iter(titles.items())) == ("run", "S (map of the run)")
    assert len(titles) > 1
    assert active == {"rover[0]": ["Walk"], "rover[1]": ["Walk"]}
    assert len(drawn) > 1
    assert browser.first["id"] == "run"
    end = ET.fromstring(Path("end.svg").read_text(encoding="utf-8"))
    places = [
        {each.get("cx") for each in root.iter() if each.get("class") == "there"}
        for root in (end, ET.fromstring(drawn[-1]))
    ]
    assert places[0] == places[1]
    assert len(places[0]) == 2


def test_a_run_without_places_shows_the_states(browser: Browser) -> None:
    assert run([*COMMAND, "--live", "--real-time-factor", "100", "--world", "abstract"]) == 0
    message = browser.told.get(timeout=PATIENCE)
    assert "run" not in message["titles"]
    active: dict[str, Any] = {}
    while len(active) < 2:
        active |= browser.told.get(timeout=PATIENCE).get("active", {})


def test_only_pages_that_show_the_map_get_it() -> None:
    assert LivePage(None, "S", None).snapshot.pictures.drawn("") == {}
    page = LivePage(None, "S", "<svg></svg>")
    assert page.snapshot.pictures.drawn("")["svg"] == "<svg></svg>"
    page.redraw("<svg/>")
    assert page.snapshot.pictures.drawn("run") == {"id": "run", "svg": "<svg/>"}
    messages = next(page.snapshot.follow())
    assert messages[1:] == [{"redrawn": {"id": "run", "svg": "<svg/>"}}]
    assert not page.snapshot.wait_for_page(0)


@pytest.mark.parametrize(
    ("arguments", "said"),
    [
        (["--port", "0"], "`--port` needs `--live`"),
        (["--live", "--replay", "t.jsonl"], "`--replay` and `--live` conflict"),
        (["--live", "--runs", "3"], "`--runs` and `--live` conflict"),
        (["--real-time-factor", "2"], "needs `--real-time`, `--live` or `--ros2`"),
    ],
)
def test_options_that_do_not_fit_are_said(
    arguments: list[str], said: str, browser: Browser, capsys: pytest.CaptureFixture[str]
) -> None:
    assert run([*COMMAND, *arguments]) == 2
    assert said in capsys.readouterr().err


def test_a_port_that_is_taken_is_said(browser: Browser, capsys: pytest.CaptureFixture[str]) -> None:
    with socket.create_server(("127.0.0.1", 0)) as taken:
        port = str(taken.getsockname()[1])
        assert run([*COMMAND, "--live", "--port", port]) == 1
    assert f"port {port}: " in capsys.readouterr().err
