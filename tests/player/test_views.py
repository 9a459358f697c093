"""Views of the player show what the simulator says, at some moments, in a browser."""

from __future__ import annotations

import json
import math
import re
from collections import Counter
from collections.abc import Iterator, Mapping
from itertools import pairwise
from pathlib import Path
from typing import Any, NamedTuple

import pytest

from swarmdsl.base.diagnostics.collector import Diagnostics
from swarmdsl.base.source import Source
from swarmdsl.cli import run
from swarmdsl.execution.simulate.command import simulate
from swarmdsl.execution.simulate.run.prepare import Request, prepare
from swarmdsl.execution.simulate.scenario.durations import SECOND
from swarmdsl.tools.player.page import page
from swarmdsl.tools.player.record import RunRecorder, record_traces
from swarmdsl.tools.player.recording import Recording

from .conftest import SAR, Visit

UNTIL = 100
VIEWS = (
    ("machine", "State machine"),
    ("sequence", "Messages"),
    ("map", "Map"),
    ("properties", "Properties"),
    ("variables", "Variables"),
    ("measures", "Measures"),
    ("coverage", "Coverage"),
    ("log", "Log"),
    ("text", "Model"),
    ("what-if", "What if"),
)


class Run(NamedTuple):
    """A run of search and rescue in the flat world, and what the simulator says of it."""

    recording: Recording
    results: Mapping[str, Any]
    visit: Visit

    @property
    def steps(self) -> list[tuple[int, Mapping[str, Any]]]:
        """Return the lines with a step, and their numbers."""
        return [(at, each) for at, each in enumerate(self.lines) if "configuration" in each]

    @property
    def lines(self) -> list[Mapping[str, Any]]:
        return list(self.recording.lines)

    def show(self, view: str, index: int, selected: str | None = None) -> None:
        """Show a view at the moment after a line."""
        self.visit.value(f"location.hash = '#t=0s&v={view},log'")
        self.visit.page.wait_for_selector(f".of-{view}")
        script = (
            "([at, name]) => { player.select(name); player.go(at === 0 ? 1 : 0); player.go(at) }"
        )
        self.visit.page.evaluate(script, [index, selected])
        # The frame after the next one comes after all views are shown.
        frames = (
            "() => new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(done)))"
        )
        self.visit.page.evaluate(frames)

    def texts(self, selector: str) -> list[str]:
        script = "(of) => [...document.querySelectorAll(of)].map((each) => each.textContent)"
        return list(self.visit.page.evaluate(script, selector))

    def attributes(self, selector: str, name: str) -> list[str]:
        get = "map((one) => one.getAttribute(name))"
        script = f"([of, name]) => [...document.querySelectorAll(of)].{get}"
        return list(self.visit.page.evaluate(script, [selector, name]))


def _recorded(browser: Any, scenario: Path, until: int, folder: Path) -> Run:
    """Run the model beside a scenario, and open its page."""
    recorder = RunRecorder()
    request = Request(
        (scenario.parent,),
        scenario=scenario,
        until=until * SECOND,
        trace="none",
        results=folder / "results.json",
        recorder=recorder,
    )
    report: list[Diagnostics] = []
    assert simulate(request, report.append)
    recording = recorder.recording()
    assert recording is not None
    path = folder / "run.html"
    path.write_text(page(recording), encoding="utf-8")
    visit = Visit(browser, path, viewport={"width": 1600, "height": 1100})
    results = json.loads((folder / "results.json").read_text())
    return Run(recording, results, visit)


@pytest.fixture(scope="module")
def flat(browser: Any, tmp_path_factory: pytest.TempPathFactory) -> Iterator[Run]:
    run = _recorded(browser, SAR / "flat.toml", UNTIL, tmp_path_factory.mktemp("views"))
    yield run
    run.visit.close()


def test_all_views_have_a_tab(flat: Run) -> None:
    tabs = flat.visit.page.get_by_role("tablist").first.get_by_role("tab")
    assert tabs.all_text_contents() == [title for _, title in VIEWS]


def _states(run: Run, index: int) -> dict[str, list[str]]:
    found = {}
    for at, line in run.steps:
        if at <= index:
            found[line["member"]] = line["configuration"]
    return found


@pytest.mark.parametrize("share", [0.0, 0.4, 1.0])
def test_the_machine_has_the_states_of_its_members(flat: Run, share: float) -> None:
    index = round(share * (len(flat.lines) - 1))
    flat.show("machine", index, "uav")
    there = _states(flat, index)
    counts = Counter(state for who in there if who.startswith("uav") for state in there[who])
    lit = flat.attributes(".of-machine .node.lit", "data-id")
    assert set(lit) == counts.keys()
    assert sorted(flat.texts(".of-machine .count > text")) == sorted(map(str, counts.values()))
    around = {state.rpartition(".")[0] for state in counts} - {""}
    assert set(flat.attributes(".of-machine .node.around", "data-id")) == around
    last = max(at for at, line in flat.steps if at <= index and line["member"].startswith("uav"))
    taken = flat.attributes(".of-machine .edge.taken", "data-id")
    assert [each for each in taken if "#initial" not in each] == flat.lines[last]["taken"]


def test_a_parallel_state_of_one_member_has_no_counts(flat: Run) -> None:
    index = len(flat.lines) - 1
    flat.show("machine", index, "rover[1]")
    lit = flat.attributes(".of-machine .node.lit", "data-id")
    assert sorted(lit) == sorted(_states(flat, index)["rover[1]"])
    assert flat.texts(".of-machine .count") == []
    # Where it began: the arrows from the initial states that were entered.
    start = next(at for at, line in flat.steps if line["member"] == "rover[1]")
    flat.show("machine", start, "rover[1]")
    assert flat.attributes(".of-machine .edge.taken", "data-id") == ["#initial->"]


def test_messages_have_their_fates(flat: Run) -> None:
    lost = next(at for at, line in enumerate(flat.lines) if "lost" in line)
    flat.show("sequence", lost)
    about = flat.lines[lost]["lost"]
    (row,) = flat.attributes(".of-sequence .row.now", "aria-label")
    assert f"{about['event']} from {about['sender']}" in row
    assert f"lost on the way to {about['member']}" in row
    assert flat.texts(".of-sequence .row.now .tip.lost")
    for fate, words in (("ignored", "ignored by"), ("taken", "taken by")):
        at, line = next(
            (at, line)
            for at, line in flat.steps
            if at > lost
            and "envelope" in line
            and line.get("ignored", False) is (fate == "ignored")
        )
        flat.show("sequence", at)
        rows = flat.attributes(".of-sequence .row:not(.later)", "aria-label")
        said = [row for row in rows if line["envelope"]["sender"] in row and words in row]
        assert any(line["member"] in row.partition(words)[2].split(";")[0] for row in said), rows
        assert flat.texts(f".of-sequence .row:not(.later) .tip.{fate}")


def test_messages_that_repeat_are_one_row(flat: Run) -> None:
    flat.show("sequence", len(flat.lines) - 1)
    rows = flat.attributes(".of-sequence .row", "aria-label")
    assert 6 <= len(rows) <= 40
    assert any(re.search(r", \d+ times: ignored by", row) for row in rows), rows
    # Only what a member sends and hears.
    flat.show("sequence", len(flat.lines) - 1, "rover[0]")
    rows = flat.attributes(".of-sequence .row", "aria-label")
    assert rows
    assert all("rover[0]" in row for row in rows)


def test_the_map_has_the_places_of_robots(flat: Run) -> None:
    index = len(flat.lines) // 2
    flat.show("map", index)
    ground = flat.recording.views["map"]
    places: dict[str, list[list[float]]] = {}
    found: dict[str, list[Any]] = {}
    for line in flat.lines[: index + 1]:
        moved = {line["member"]: line["at"]} if "at" in line else line.get("moved", {})
        for name, place in moved.items():
            places.setdefault(name, []).append(place)
        found = line.get("targets", found)
    for name, way in places.items():
        x, y = way[-1][:2]
        at = ground["left"] + x * ground["scale"], ground["bottom"] - y * ground["scale"]
        script = """(name) => {
            const robots = [...document.querySelectorAll(".of-map .robot")];
            const number = robots.findIndex((one) => one.lastChild.textContent === name);
            const trail = document.querySelectorAll(".of-map .trail")[number];
            const { e, f } = robots[number].transform.baseVal[0].matrix;
            return [e, f, Number(trail.getAttribute("stroke-dasharray").split(" ")[0])];
        }"""
        e, f, dash = flat.visit.page.evaluate(script, name)
        assert (e, f) == pytest.approx(at, abs=0.06)
        length = sum(math.dist(one[:2], other[:2]) for one, other in pairwise(way))
        assert dash / ground["scale"] == pytest.approx(length, rel=0.02, abs=0.2)
    number = sum(each[3] for each in found.values())
    assert found
    assert f"{number} of {len(found)} targets found" in flat.texts(".of-map .said")[0]
    assert len(flat.texts(".of-map .found")) == number
    seen = [line["saw"] for line in flat.lines[: index + 1] if "saw" in line]
    titles = flat.texts(".of-map .seen")
    assert len(titles) == len(seen) > 0
    assert all(
        f"{saw['member']} sees {saw['target']}" in title
        for saw, title in zip(seen, titles, strict=True)
    )
    assert flat.attributes(".of-map .link", "d")[0].count("M") == len(_links(flat, index))


def _links(run: Run, index: int) -> list[Any]:
    return next((line["links"] for line in reversed(run.lines[: index + 1]) if "links" in line), [])


WORDS = {"true": "holds", "open": "pending", "false": "violated"}


def _check_last_verdicts(run: Run) -> None:
    """Hold the verdicts at the end of a run against those in its results."""
    run.show("properties", len(run.lines) - 1)
    shown = run.texts(".of-properties .verdict")
    expected = {each["name"]: each for each in run.results["properties"]}
    assert run.texts(".of-properties tbody th") == list(expected)
    for each, verdict in zip(expected.values(), shown, strict=True):
        assert WORDS[each["verdict"]] in verdict
        assert each.get("remark", "") in verdict


def test_verdicts_are_those_of_the_simulator(flat: Run) -> None:
    _check_last_verdicts(flat)
    names = flat.texts(".of-properties tbody th")
    # In the midst, as the monitors have told.
    index = next(
        at for at, line in enumerate(flat.lines) if line.get("property") == "Returns" and at > 9
    )
    for at in (index - 1, index):
        flat.show("properties", at)
        told = {
            line["property"]: line["verdict"] for line in flat.lines[: at + 1] if "property" in line
        }
        shown = flat.texts(".of-properties .verdict")
        assert [each.split()[1] for each in shown] == [
            WORDS[told.get(name, "open")] for name in names
        ]
    assert len(set(flat.attributes(".of-properties .lane rect", "height"))) > 1


def test_measures_are_those_of_the_simulator(flat: Run) -> None:
    flat.show("measures", len(flat.lines) - 1)
    values = dict(zip(flat.texts(".of-measures b"), flat.texts(".of-measures .value"), strict=True))
    expected = {each["name"]: each["value"] for each in flat.results["measures"]}
    fitness = flat.results["fitness"]
    expected[fitness["name"]] = fitness["value"]
    assert values.keys() == expected.keys()
    for name, value in expected.items():
        assert float(values[name].split()[0]) == pytest.approx(value, rel=1e-5), name
    assert all("H" in path for path in flat.attributes(".of-measures .curve", "d"))
    middle = next(at for at, line in enumerate(flat.lines) if "measures" in line and at > 300)
    flat.show("measures", middle)
    now = {each["name"]: each["value"] for each in flat.lines[middle]["measures"]}
    shown = dict(zip(flat.texts(".of-measures b"), flat.texts(".of-measures .value"), strict=True))
    assert float(shown["searched"].split()[0]) == pytest.approx(now["searched"], rel=1e-5)
    assert shown != values


def test_coverage_is_that_of_a_run_until_then(
    flat: Run, capsys: pytest.CaptureFixture[str]
) -> None:
    index = max(at for at, line in flat.steps if line["t"] <= 30_000)
    flat.show("coverage", index)
    arguments = ["--scenario", str(SAR / "flat.toml"), "--until", "30s", "--trace", "none"]
    run(["simulate", str(SAR), *arguments])
    summary = capsys.readouterr().err
    percent = re.search(r"coverage: (\d+) %", summary)
    assert percent is not None
    (said,) = flat.texts(".of-coverage .said")
    assert said.startswith(f"{percent[1]} % ")
    missed = re.findall(r"never (?:entered|taken): (.*)", summary)
    shown = flat.texts(".of-coverage button:not([data-state=reached])")
    assert {" ".join(each.split()) for each in missed} <= set(shown)
    assert len(missed) > 5


def test_variables_are_those_of_the_run(flat: Run) -> None:
    index = next(
        at for at, line in flat.steps if line["t"] > 0 and "target_id" in line.get("variables", {})
    )
    line = flat.lines[index]
    flat.show("variables", index, line["member"])
    shown = dict(
        zip(flat.texts(".of-variables tbody th"), flat.texts(".of-variables tbody td"), strict=True)
    )
    assert shown["target_id"] == f'\u25cf "{line["variables"]["target_id"]}"'
    changed = flat.attributes(".of-variables .changed", "title")
    assert len(changed) == len(line["variables"])
    assert all(each.endswith("(changed in this step)") for each in changed)
    flat.show("variables", index - 1, line["member"])
    assert flat.texts(".of-variables .changed") == []


def test_the_log_finds_lines_and_has_few_rows(flat: Run) -> None:
    index = next(at for at, line in flat.steps if line["t"] > 60_000 and line["started"])
    line = flat.lines[index]
    flat.show("machine", index)  # the log is beside it
    (now,) = flat.texts(".of-log [aria-selected=true]")
    assert f"{line['member']}: {line['event']}" in now
    assert f"start {line['started'][0]}" in now
    assert 5 < len(flat.texts(".of-log .rows > div")) < 60
    field = flat.visit.page.get_by_label("Filter the log")
    field.fill("LOST on")
    number = sum("lost" in each for each in flat.lines)
    told = flat.visit.page.locator(".of-log [role=status]")
    flat.visit.page.wait_for_function(
        "(start) => document.querySelector('.of-log [role=status]').textContent.startsWith(start)",
        arg=f"{number} of ",
    )
    assert number > 0
    assert "lines" in str(told.text_content())
    assert all("lost" in each for each in flat.texts(".of-log .rows > div"))
    field.fill("")


def test_the_text_has_the_line_that_was_taken(flat: Run) -> None:
    for member in ("uav[0]", "rover[0]"):
        index, line = next(
            (at, line) for at, line in flat.steps if line["member"] == member and line["taken"]
        )
        flat.show("text", index, member)
        marked = flat.texts(".of-text .marked")
        assert len(marked) == len(line["taken"]) == 1
        number, _, text = marked[0].strip().partition(" ")
        source = (SAR / "behaviours.swarm").read_text().splitlines()
        assert text.strip() == source[int(number) - 1].strip()
        assert text.strip().startswith("on MissionStart ->")
        assert "on" in flat.texts(".of-text .marked .keyword")


def test_each_view_is_fast(flat: Run) -> None:
    script = """(id) => {
        const view = player.views.find((each) => each.id === id);
        const times = [];
        for (let each = 0; each < 60; each++) {
            const moment = player.recording.moment((each * 7919) % player.recording.count);
            const before = performance.now();
            view.show(moment);
            times.push(performance.now() - before);
        }
        // Other programs may take the processor meanwhile: not the median.
        return times.sort((one, other) => one - other)[9];
    }"""
    for view, _ in VIEWS:
        flat.show(view, 5)
        assert flat.visit.page.evaluate(script, view) < 5, view


def test_a_trace_is_judged_as_its_run(flat: Run, tmp_path: Path) -> None:
    trace, results = tmp_path / "run.jsonl", tmp_path / "results.json"
    steps = [line for line in flat.lines if "configuration" in line]
    plain = [{key: line[key] for key in line.keys() - {"variables"}} for line in steps]
    trace.write_text("".join(f"{json.dumps(line)}\n" for line in plain), encoding="utf-8")
    scenario = ["--scenario", str(SAR / "flat.toml")]
    run(["simulate", str(SAR), *scenario, "--replay", str(trace), "--results", str(results)])
    expected = json.loads(results.read_text())
    prepared = prepare(Request((SAR,), scenario=SAR / "flat.toml"), Diagnostics())
    source = Source(str(trace), trace.read_text(encoding="utf-8"))
    recording = record_traces([source], prepared, Diagnostics())
    assert recording is not None
    lines = list(recording.lines)
    assert [line for line in lines if "configuration" in line] == steps
    last = {line["property"]: line for line in lines if "property" in line}
    for each in expected["properties"]:
        assert last[each["name"]]["verdict"] == each["verdict"]
        assert last[each["name"]].get("remark") == each.get("remark")
    measured = [line for line in lines if "measures" in line]
    assert len(measured) > 20
    assert measured[-1]["measures"] == expected["measures"]
    times = [line["t"] for line in lines]
    assert times == sorted(times)


def test_what_has_nothing_to_show_has_no_tab(browser: Any, tmp_path: Path) -> None:
    path = tmp_path / "minimal.html"
    minimal = str(SAR.parent / "minimal")
    command = ["play", minimal, "--machine", "Blinking", "--until", "3s", "-o", str(path)]
    assert run(command) == 0
    visit = Visit(browser, path)
    tabs = visit.page.get_by_role("tablist").first.get_by_role("tab").all_text_contents()
    assert set(tabs) <= {title for _, title in VIEWS}
    assert not {"Map", "Measures", "Properties"} & set(tabs)
    visit.close()


def test_a_run_without_places_has_everything_but_a_map(browser: Any, tmp_path: Path) -> None:
    season = _recorded(browser, SAR.parent / "agriculture" / "season.toml", 240, tmp_path)
    tabs = season.visit.page.get_by_role("tablist").first.get_by_role("tab").all_text_contents()
    assert "Properties" in tabs
    assert "Map" not in tabs
    _check_last_verdicts(season)
    index = len(season.lines) - 1
    there = _states(season, index)
    for role in dict.fromkeys(each.role for each in season.recording.members):
        season.show("machine", index, role)
        counts = {s for m in season.recording.members if m.role == role for s in there[m.name]}
        assert set(season.attributes(".of-machine .node.lit", "data-id")) == counts
    season.visit.close()
