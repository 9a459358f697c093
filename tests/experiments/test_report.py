"""Reports: what is drawn where, and that no name of a model gets out of the text."""

from __future__ import annotations

import re
from base64 import b64encode
from hashlib import sha256
from html.parser import HTMLParser
from xml.etree import ElementTree

import pytest

from swarmdsl.execution.estimation.intervals import Interval
from swarmdsl.execution.experiments.report.canvas import ticks
from swarmdsl.execution.experiments.report.charts import Mean, convergence, main_effect
from swarmdsl.execution.experiments.report.coordinates import Scored, caption_of, draw_candidates
from swarmdsl.execution.experiments.report.page import Page, Section, Table, html
from swarmdsl.execution.experiments.report.search import Search, Worst, search_sections

HOSTILE = "</title><script>alert(1)</script>\"'&\x00"
SVG = "{http://www.w3.org/2000/svg}"


class _Reader(HTMLParser):
    def __init__(self) -> None:
        super().__init__()
        self.tags: list[str] = []
        self.attributes: set[str] = set()
        self.policy = ""

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        self.tags.append(tag)
        given = dict(attrs)
        self.attributes |= given.keys()
        if given.get("http-equiv") == "Content-Security-Policy":
            self.policy = given["content"] or ""


def _search() -> Search:
    candidates = [
        Scored({f"uav.{HOSTILE}": number, "count of uav": 2 + number % 3}, value, kind)
        for number, (value, kind) in enumerate(
            [(3.0, "today"), (None, ""), (5.0, ""), (4.0, ""), (9.0, "best")]
        )
    ]
    worst = [Worst(f"violates {HOSTILE}", 7, 1.5, f"swarmc simulate '{HOSTILE}' --seed 7")]
    today = [3.0, 3.5, 2.5, 3.1]
    return Search(HOSTILE, "maximize", candidates, [8.0, 9.0, 9.5, 8.8], today, 0.95, worst)


def test_a_page_loads_nothing_and_runs_nothing_whatever_names_say() -> None:
    rows = [(HOSTILE, "1")]
    sections = [
        *search_sections(_search()),
        Section(HOSTILE, [HOSTILE, Table((HOSTILE, "n"), rows)]),
    ]
    page = html(Page(HOSTILE, [(HOSTILE, HOSTILE)], [HOSTILE], sections))
    reader = _Reader()
    reader.feed(page)
    assert not {"script", "link", "img", "iframe", "object", "base"} & set(reader.tags)
    assert not {each for each in reader.attributes if each.startswith("on")}
    assert not {"style", "src", "href"} & reader.attributes
    (styles,) = re.findall(r"<style>(.*?)</style>", page, re.DOTALL)
    digest = b64encode(sha256(styles.encode()).digest()).decode()
    assert reader.policy.startswith(f"default-src 'none'; style-src 'sha256-{digest}';")
    assert "url(" not in styles
    assert "\x00" not in page
    # As text, the name is there, in full.
    assert page.count("&lt;/title&gt;&lt;script&gt;alert(1)&lt;/script&gt;") >= 8
    assert "color-scheme: light dark" in styles


def test_a_search_has_its_sections() -> None:
    titles = [each.title for each in search_sections(_search())]
    assert titles == [
        "Convergence",
        "Candidates",
        "The winner on fresh seeds",
        "Runs worth a look",
    ]
    page = html(Page("t", [], [], list(search_sections(_search()))))
    for svg in re.findall(r"<svg.*?</svg>", page, re.DOTALL):
        ElementTree.fromstring(svg)


def test_convergence_keeps_the_best() -> None:
    """The line goes up by the goal only; a candidate without a value is a gap."""
    drawn = ElementTree.fromstring(convergence([3.0, None, 5.0, 4.0], "maximize", "f"))
    dots = [float(each.attrib["cy"]) for each in drawn.iter(f"{SVG}circle")]
    assert dots[1] < dots[2] < dots[0]  # y goes down
    (line,) = drawn.iter(f"{SVG}polyline")
    ends = [float(point.split(",")[1]) for point in line.attrib["points"].split()]
    assert ends == sorted(ends, reverse=True)
    assert ends[0] == dots[0]
    assert ends[-1] == min(dots)
    least = ElementTree.fromstring(convergence([3.0, 5.0], "minimize", "f"))
    (line,) = least.iter(f"{SVG}polyline")
    assert len({point.split(",")[1] for point in line.attrib["points"].split()}) == 1


def test_parallel_coordinates_mark_the_best_and_leave_out_what_does_not_vary() -> None:
    candidates = [
        Scored({"a": 1, "b": "x", "c": 5}, 1.0, "today"),
        Scored({"a": 2, "b": "y", "c": 5}, 2.0, "best"),
        Scored({"a": 3, "b": "x", "c": 5}, None),
    ]
    text = draw_candidates(candidates, "maximize", "f")
    assert text is not None
    drawn = ElementTree.fromstring(text)
    names = [each.text for each in drawn.iter(f"{SVG}text") if each.get("class") == "middle"]
    assert names == ["a", "b", "f"]
    kinds = [each.attrib["class"] for each in drawn.iter(f"{SVG}polyline")]
    assert kinds == ["path today", "path best"]
    assert draw_candidates(candidates[:1], "maximize", "f") is None
    many = [Scored({"x": x}, float(x)) for x in range(500)]
    assert str(draw_candidates(many, "maximize", "f")).count("<polyline") == 400
    assert "The best 400 of 500 are drawn." in caption_of(many, "candidate")
    assert "400" not in caption_of(many[:400], "candidate")


def test_main_effects_share_one_scale() -> None:
    span = Interval(0, 10)
    first = main_effect("a", [Mean("low", 2, Interval(1, 3)), Mean("high", 8, None)], span)
    second = main_effect("b", [Mean("x", 2, None), Mean("y", 2, None)], span)
    heights = [
        [each.attrib["cy"] for each in ElementTree.fromstring(text).iter(f"{SVG}circle")]
        for text in (first, second)
    ]
    assert heights[0][0] == heights[1][0] == heights[1][1] != heights[0][1]


@pytest.mark.parametrize(
    ("low", "high", "expected"),
    [(0, 10, [0, 2, 4, 6, 8, 10]), (0.13, 0.41, [0.15, 0.2, 0.25, 0.3, 0.35, 0.4]), (3, 3, [3])],
)
def test_ticks_are_round(low: float, high: float, expected: list[float]) -> None:
    assert ticks(low, high) == pytest.approx(expected)
