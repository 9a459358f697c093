"""`swarmc simulate --animation`: the picture has at each time what the run had then."""

from __future__ import annotations

import json
import math
import re
import xml.etree.ElementTree as ET
from base64 import b64encode
from bisect import bisect_right
from collections.abc import Iterator
from hashlib import sha256
from html.parser import HTMLParser
from pathlib import Path

import pytest

from swarmdsl.cli import run
from swarmdsl.execution.simulate.pictures.map_animation import Film, map_animation, timing_of
from swarmdsl.execution.simulate.pictures.map_svg import Ground, Sighting, Track
from swarmdsl.execution.simulate.pictures.player import player
from swarmdsl.execution.simulate.scenario.durations import SECOND
from swarmdsl.ir import Point

from .worlds import TEXT

SVG = "{http://www.w3.org/2000/svg}"
GROUND = Ground(Point(0, 0), Point(100, 50))
HOSTILE = '</svg><script>alert("1")</script>&\x00'
WALK = '[functions.walk]\nmodel = "random_walk"\narguments = { leg = 4 }\n'


def film() -> Film:
    """A run of 200 s: one goes round a corner, another one is lost for a while."""
    places = [(t * SECOND, (float(min(t, 60)), float(max(t - 60, 0)) / 4, 0.0)) for t in range(201)]
    still = [(0, (80.0, 20.0, 0.0)), (200 * SECOND, (80.0, 20.0, 0.0))]
    return Film(
        200 * SECOND,
        [Track("uav[0]", "uav", places), Track(HOSTILE, HOSTILE, still)],
        [[], [(50 * SECOND, 120 * SECOND)]],
        [(Track("person[0]", "", [(0, (70.0, 10.0, 0.0))]), 100 * SECOND)],
        [(0, 1, 40 * SECOND, 50 * SECOND)],
        [Sighting(100 * SECOND, "uav[0]", HOSTILE, (60.0, 10.0, 0.0))],
    )


def at(element: ET.Element, attribute: str, seconds: float, end: float) -> str:
    """Value of an animated attribute of an element at a time, as a browser shows it."""
    for each in element:
        if each.get("attributeName") != attribute:
            continue
        values, times = (each.get(name, "").split(";") for name in ("values", "keyTimes"))
        keys = [float(time) * end for time in times]
        assert keys[0] == 0
        assert keys == sorted(keys)
        place = bisect_right(keys, seconds) - 1
        if each.get("calcMode") == "discrete":
            return values[place]
        assert keys[-1] == end
        place = min(place, len(keys) - 2)
        share = (seconds - keys[place]) / (keys[place + 1] - keys[place])
        ends = (map(float, values[number].split(",")) for number in (place, place + 1))
        return ",".join(f"{a + share * (b - a):.2f}" for a, b in zip(*ends, strict=True))
    raise AssertionError(f"{element.tag} has no animated {attribute}")


def robots(root: ET.Element) -> Iterator[tuple[str, ET.Element]]:
    for group in root.iter(f"{SVG}g"):
        if any(each.get("class") == "robot" for each in group):
            yield group.findtext(f"{SVG}title") or "", group


def of_class(root: ET.Element, style: str) -> ET.Element:
    (found,) = (each for each in root.iter() if each.get("class") == style)
    return found


def test_at_each_time_all_is_where_it_was() -> None:
    root = ET.fromstring(map_animation("Rescue", GROUND, film()))
    (name, uav), (_, other) = robots(root)
    assert name == "uav[0]"

    def x(metres: float) -> float:
        return 44 + 8.8 * metres

    def y(metres: float) -> float:
        return 62 + 440 - 8.8 * metres

    for seconds in (0, 7.5, 59, 61, 100, 199.5, 200):
        left, top = map(float, at(uav, "transform", seconds, 200).split(","))
        assert left == pytest.approx(x(min(seconds, 60)), abs=0.5)
        assert top == pytest.approx(y(max(seconds - 60, 0) / 4), abs=0.5)
        gone = float(at(of_class(root, "trail"), "stroke-dashoffset", seconds, 200))
        assert 1 - gone == pytest.approx(
            (min(seconds, 60) + max(seconds - 60, 0) / 4) / 95, abs=0.02
        )
    there, lost = (each for each in other if each.tag == f"{SVG}circle")
    for seconds, is_there in ((0, True), (49, True), (51, False), (119, False), (121, True)):
        words = ("visible", "hidden") if is_there else ("hidden", "visible")
        assert (
            at(there, "visibility", seconds, 200),
            at(lost, "visibility", seconds, 200),
        ) == words
    link, found, seen = (of_class(root, each) for each in ("link", "found", "seen"))
    shown = {
        seconds: [at(each, "visibility", seconds, 200) == "visible" for each in (link, found, seen)]
        for seconds in (39, 45, 51, 99, 101)
    }
    assert shown == {
        39: [False, False, False],
        45: [True, False, False],
        51: [False, False, False],
        99: [False, False, False],
        101: [False, True, True],
    }
    way = next(each.get("values", "") for each in link if each.get("attributeName") == "d")
    assert way.split(";")[0] == f"M{x(40):.4g},{y(0):.4g}L{x(80):.4g},{y(20):.4g}"


def test_everything_repeats_with_the_period_of_the_run() -> None:
    timing = timing_of(200 * SECOND)
    assert (timing.period, timing.pace) == (40, 5)
    periods = re.findall(
        r'dur="([^"]*)" repeatCount="indefinite"', map_animation("", GROUND, film())
    )
    assert len(periods) > 8
    assert set(periods) == {"40s"}
    assert [timing_of(round(each * SECOND)).pace for each in (0, 60, 61, 900, 86_400)] == [
        *(1, 1, 2, 20, 3600)
    ]


class Page(HTMLParser):
    """Elements of a page, with its policy and its scripts."""

    def __init__(self, text: str) -> None:
        super().__init__()
        self.tags: list[str] = []
        self.policy = self.script = ""
        self._within = ""
        self.feed(text)

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        self.tags.append(self._within)
        self._within = tag
        given = dict(attrs)
        assert not {"src", "href"} & set(given)
        assert not any(name.startswith("on") for name in given)
        if given.get("http-equiv") == "Content-Security-Policy":
            self.policy = given["content"] or ""

    def handle_data(self, data: str) -> None:
        if self._within == "script":
            self.script += data

    def handle_endtag(self, tag: str) -> None:
        self.tags.append(self._within)
        self._within = ""


def test_a_page_runs_its_own_script_alone() -> None:
    svg = map_animation(HOSTILE, GROUND, film())
    page = Page(player(HOSTILE, svg, timing_of(200 * SECOND)))
    assert page.tags.count("script") == 1
    digest = b64encode(sha256(page.script.encode()).digest()).decode()
    assert page.policy.split("; ")[:3] == [
        "default-src 'none'",
        "style-src 'unsafe-inline'",
        f"script-src 'sha256-{digest}'",
    ]
    assert "script" not in {each.tag.removeprefix(SVG) for each in ET.fromstring(svg).iter()}


@pytest.mark.parametrize("suffix", [".svg", ".html"])
def test_a_run_ends_where_its_trace_does(
    suffix: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.chdir(tmp_path)
    Path("demo.swarm").write_text(TEXT.replace("ROBOTS", "2"), encoding="utf-8")
    Path("s.toml").write_text(WALK, encoding="utf-8")
    command = ["simulate", "demo.swarm", "--scenario", "s.toml", "--until", "20s"]
    file = f"run{suffix}"
    assert run([*command, "--animation", file, "--trace-file", "t.jsonl"]) == 0
    assert f"written: t.jsonl, {file}" in capsys.readouterr().err
    text = Path(file).read_text(encoding="utf-8")
    assert re.findall(r"\w+://[^\"]*", text) == ["http://www.w3.org/2000/svg"]
    (picture,) = re.findall("<svg.*</svg>", text, re.DOTALL)
    ends = dict(robots(ET.fromstring(picture)))
    moved = [json.loads(line) for line in Path("t.jsonl").read_text(encoding="utf-8").splitlines()]
    (last,) = (each["moved"] for each in moved if each["t"] == 20_000)
    scale = min(880 / 100, 640 / 80)
    for name, (x, y, _) in last.items():
        place = tuple(map(float, at(ends[name], "transform", 20, 20).split(",")))
        assert math.dist(place, (44 + scale * x, 62 + 640 - scale * y)) < 0.5
    run([*command, "--animation", file])
    assert Path(file).read_text(encoding="utf-8") == text


@pytest.mark.parametrize(
    ("arguments", "said"),
    [
        (["--world", "abstract"], "`--animation` and `--world abstract` conflict"),
        (["--runs", "3"], "`--runs` and `--animation` conflict"),
        (["--animation", "a.png"], "name a file that ends with `.svg`"),
    ],
)
def test_an_animation_needs_places(
    arguments: list[str], said: str, capsys: pytest.CaptureFixture[str]
) -> None:
    assert run(["simulate", "demo.swarm", "--animation", "a.svg", *arguments]) != 0
    assert said in capsys.readouterr().err
