"""Worlds of models in the language: what they say of space is what happens."""

from __future__ import annotations

import json
import math
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

from swarmdsl.cli import run

FIELD = """
action demo_msgs/Search {
  goal   { altitude : float64 in m }
  result { target_id : string, target_pose : geometry_msgs/PoseStamped }
}
function survey : swarm {
  action "survey" : demo_msgs/Search
  param width : float64 in m = 8 m
  model coverage(height = altitude, width = width, area = "meadow")
}
swarm event Found : cpswarm_msgs/TargetPositionEvent on "target_found"
event Battery : sensor_msgs/BatteryState on "battery/state"
message cpswarm_msgs/TargetPositionEvent {
  header : std_msgs/Header
  id     : string
  pose   : geometry_msgs/PoseStamped
}
environment Field {
  size 100 m x 80 m x 30 m
  area meadow  : (0 m, 0 m) .. (60 m, 80 m)
  zone village : (70 m, 40 m) .. (90 m, 60 m)
  wall         : (62 m, 0 m) -> (62 m, 30 m) height 3 m
  obstacle silo : (80 m, 20 m) radius 3 m height 10 m
  target person [2] at random in meadow
  wind 1 m/s to 90 deg from 10 s until 20 s
  rain from 20 s until 30 s
}
sensor Camera {
  out target : cpswarm_msgs/TargetPositionEvent on "target_found"
  senses person { range = 12 m, view = 90 deg, miss = 0.1, rate = 2 Hz }
}
endless statemachine Searching {
  param altitude : float64 in m = 6 m
  initial Search
  state Search {
    do survey(altitude = altitude)
    on succeeded -> Stay
    on aborted   -> Search
    on Found     -> Stay
  }
  state Stay { on Battery [event.percentage < 0.5] -> Low }
  state Low  { }
}
member Uav {
  behavior Searching
  camera : Camera
  body    { radius = 0.3 m, mass = 1.5 kg, speed = 5 m/s, climb = 2 m/s }
  battery { capacity = 2 Wh, moving = 180 W, hovering = 150 W, sensing = 5 W, idling = 4 W }
  radio   { range = 300 m, loss = 0.05, through = 0.5 }
}
swarm S {
  uav : Uav[3] in meadow
  environment Field
  heartbeat 1 s lost after 5 s
}
"""
Run = Callable[..., tuple[int, str, str]]


@pytest.fixture
def swarmc(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> Run:
    monkeypatch.chdir(tmp_path)

    def swarmc(*arguments: str, text: str = FIELD) -> tuple[int, str, str]:
        Path("field.swarm").write_text(text, encoding="utf-8")
        code = run([arguments[0], "field.swarm", *arguments[1:]])
        said = capsys.readouterr()
        return code, said.out, said.err

    return swarmc


def lines(out: str) -> list[dict[str, Any]]:
    return [json.loads(line) for line in out.splitlines()]


def test_a_model_with_geometry_runs_in_the_flat_world(swarmc: Run) -> None:
    code, out, err = swarmc("simulate", "--trace", "json", "--until", "2min")
    assert code == 0, err
    assert all(0 <= line["at"][0] <= 60 for line in lines(out))
    found = [line for line in lines(out) if line["event"] == "do.Search.succeeded"]
    assert found
    for line in found:
        position = line["data"]["target_pose"]["pose"]["position"]
        assert math.dist(line["at"], [position[axis] for axis in "xyz"]) <= 12.5
        assert line["data"]["target_id"] in ("person[0]", "person[1]")
    assert "energy used" in err


def test_batteries_get_low_and_then_empty(swarmc: Run) -> None:
    code, out, err = swarmc("simulate", "--trace", "text", "--until", "5min")
    assert code == 0, err
    assert "fault.lost (battery empty)" in out
    assert "Low" in out


def test_verify_says_that_it_leaves_places_out(swarmc: Run) -> None:
    one = FIELD.replace("Uav[3]", "Uav")
    _, out, err = swarmc("verify", text=one)
    assert "places are left out" in out + err
    plain = one[: one.index("environment Field")] + one[one.index("sensor Camera") :]
    plain = plain.replace(" in meadow", "").replace("  environment Field\n", "")
    places = ("model", "body", "battery", "radio", "senses")
    kept = [line for line in plain.splitlines() if not line.strip().startswith(places)]
    _, out, err = swarmc("verify", text="\n".join(kept))
    assert "states" in out + err
    assert "places are left out" not in out + err


def test_a_model_of_the_project_is_known_to_checks(swarmc: Run, tmp_path: Path) -> None:
    text = FIELD.replace(
        'model coverage(height = altitude, width = width, area = "meadow")',
        "model treat(seconds = width / 1 m)",
    )
    code, out, _ = swarmc("check", text=text)
    assert code == 1
    assert "SW0622" in out
    (tmp_path / "swarm.toml").write_text('[models]\ntreat = "spray.py:Spray"\n', encoding="utf-8")
    code, out, _ = swarmc("check", text=text)
    assert code == 0, out
    (tmp_path / "spray.py").write_text(
        """
import numpy as np
from swarmdsl.execution.space.functions.base import Model, statuses
from swarmdsl.ir.function_models import Argument

class Spray(Model):
    arguments = (Argument("seconds", "number", 3.0, "how long"),)

    def start(self, who, arguments):
        self.left = np.full(self.stage.rows, arguments["seconds"])

    def step(self, who, dt):
        self.left[who] -= dt
        return statuses(self.left[who] < dt / 2)
""",
        encoding="utf-8",
    )
    code, out, err = swarmc("simulate", "--trace", "json", "--until", "9s", text=text)
    assert code == 0, err
    assert {line["t"] for line in lines(out) if line["event"] == "do.Search.succeeded"} == {8000}
    code, _, err = swarmc("simulate", text=text.replace("seconds =", "secnods ="))
    assert code == 1
    assert "SW0623" in err
    assert "field.swarm:9" in err


MEASURED = FIELD.replace(
    "  heartbeat 1 s lost after 5 s\n}",
    """  fitness Worth
}
fitness Worth {
  in way   : float64 in m = distance(uav)
  in spent : float64 in J = energy(uav)
  in share : float64 = covered(uav)
  in seen  : uint32  = found(person)
  maximize share * 1000 + seen * 100 - spent / 1000 J - way / 100 m
}
""",
)


def measures(path: str) -> dict[str, Any]:
    found = json.loads(Path(path).read_text(encoding="utf-8"))
    return {each["name"]: each for each in found["measures"]}


def test_a_fitness_measures_what_happens_in_the_world(swarmc: Run) -> None:
    code, out, err = swarmc(
        "simulate", "--trace", "json", "--until", "40s", "--results", "r.json", text=MEASURED
    )
    assert code == 0, err
    found = {name: each["value"] for name, each in measures("r.json").items()}
    ends = {line["data"]["target_id"] for line in lines(out) if "succeeded" in str(line["event"])}
    assert found["seen"] >= len(ends) > 0
    assert 0 < found["way"] <= 3 * 40 * 5.4
    assert found["spent"] > 3 * 20 * 5
    assert 0 < found["share"] < 0.7
    code, _, err = swarmc(
        "simulate", "--runs", "3", "--seed", "0", "--until", "40s", "--results", "m.json",
        "--jobs", "1", text=MEASURED,
    )  # fmt: skip
    assert code == 0, err
    several = measures("m.json")
    alone = []
    for seed in "012":
        swarmc("simulate", "--seed", seed, "--until", "40s", "--results", "r.json", text=MEASURED)
        alone.append({name: each["value"] for name, each in measures("r.json").items()})
    assert several.keys() == {*alone[0], "Worth"}
    for name in alone[0]:
        assert several[name]["mean"] == pytest.approx(math.fsum(one[name] for one in alone) / 3)
    code, _, err = swarmc("simulate", "--world", "abstract", "--until", "5s", text=MEASURED)
    assert code == 0
    assert "`way` has no value, because robots have no places here" in err
