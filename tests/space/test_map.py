"""`swarmc simulate --map`: the picture has what happened in the run."""

from __future__ import annotations

import json
import xml.etree.ElementTree as ET
from collections.abc import Callable
from pathlib import Path

import pytest

from swarmdsl.cli import run
from swarmdsl.execution.simulate.pictures.run_map import RunMap
from swarmdsl.ir import Targets, Wall
from swarmdsl.ir.space import Point

from .worlds import TEXT, Played, changed, numbers, system_of

SVG = "{http://www.w3.org/2000/svg}"
WALK = '[functions.walk]\nmodel = "random_walk"\n'
Map = Callable[..., tuple[int, str]]


@pytest.fixture
def draw(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> Map:
    monkeypatch.chdir(tmp_path)
    Path("demo.swarm").write_text(TEXT.replace("ROBOTS", "2"), encoding="utf-8")

    def draw(*arguments: str, scenario: str = WALK) -> tuple[int, str]:
        Path("s.toml").write_text(scenario, encoding="utf-8")
        code = run(["simulate", "demo.swarm", "--scenario", "s.toml", "--map", "m.svg", *arguments])
        return code, capsys.readouterr().err

    return draw


def test_the_trails_end_where_the_trace_does(draw: Map) -> None:
    code, err = draw("--until", "20s", "--trace-file", "t.jsonl")
    assert code == 0
    assert "written: t.jsonl, m.svg" in err
    root = ET.fromstring(Path("m.svg").read_text(encoding="utf-8"))
    titles = [each.text or "" for each in root.iter(f"{SVG}title")]
    assert sum(title.startswith("rover[") for title in titles) == 2
    assert len([each for each in root.iter(f"{SVG}polyline") if each.get("class") == "trail"]) == 2
    assert "after 20 s" in "".join(root.itertext())
    assert json.loads(Path("t.jsonl").read_text(encoding="utf-8").splitlines()[0])["at"]


def test_the_same_seed_draws_the_same_map(draw: Map) -> None:
    draw("--until", "5s")
    once = Path("m.svg").read_bytes()
    draw("--until", "5s")
    assert Path("m.svg").read_bytes() == once
    draw("--until", "5s", "--seed", "7")
    assert Path("m.svg").read_bytes() != once


@pytest.mark.parametrize(
    ("arguments", "scenario", "said"),
    [
        ((), "", "there is no map: `S` has no places here"),
        ((), '[world]\nkind = "abstract"\n', "error[SW1018]"),
        (("--world", "abstract"), WALK, "`--map` and `--world abstract` conflict"),
        (("--runs", "3"), WALK, "`--runs` and `--map` conflict"),
        (("--replay", "t.jsonl"), WALK, "`--map` and `--replay` conflict"),
        (("--map", "m.png"), WALK, "name a file that ends with `.svg`"),
    ],
)
def test_a_map_needs_places(
    arguments: tuple[str, ...], scenario: str, said: str, draw: Map
) -> None:
    code, err = draw(*arguments, scenario=scenario)
    assert code != 0
    assert said in err
    assert not Path("m.svg").exists()


def test_what_robots_see_and_who_reaches_whom_is_on_the_map(tmp_path: Path) -> None:
    system = changed(
        system_of(tmp_path, robots=3),
        environment={
            "walls": (Wall((Point(0, 1), Point(4, 1))),),
            "targets": (Targets("person", 2, (Point(2, 3), Point(9, 9))),),
        },
        member={"radio": numbers(range=100.0), "body": numbers(speed=1.0)},
        role={"start": Point(3, 3)},
    )
    played = Played(system, until=0)
    recorded = RunMap(played.subject, played.world)
    recorded.saw(played.robot(1), "person[0]")
    recorded.saw(played.robot(1), "person[0]")
    root = ET.fromstring(recorded.svg())

    def count(tag: str, style: str) -> int:
        return sum(each.get("class") == style for each in root.iter(f"{SVG}{tag}"))

    assert count("line", "link") == 3
    assert count("polyline", "wall") == 1
    assert count("path", "seen") == 1
    assert count("polygon", "target") == 2
    assert any(each.text == "rover[1] sees person[0] at 0 ms" for each in root.iter(f"{SVG}title"))
