"""Physics by `swarmc simulate`: the choice of it, and the verdicts of a model in all worlds."""

from __future__ import annotations

import json
import struct
import zlib
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from swarmdsl.cli import run
from swarmdsl.execution.physics import picture
from swarmdsl.execution.simulate.inputs import choose_space

from ..worlds import TEXT

MEADOW = Path(__file__).resolve().parents[3] / "examples" / "meadow"
PROPERTIES = """
property Arrives  of S : each rover : eventually in Done
property Unharmed of S : each rover : never in Stuck
property Alone    of S : never count(rover in Done) > 1
"""
BODY = "body { radius = 0.3 m, mass = 8 kg, speed = 2 m/s }"
PLACES = "rover[0] at (10 m, 10 m)\n  rover[1] at (10 m, 30 m)"
SCENARIO = """
until = "20 s"
[functions.walk]
{choice}
"""
GO = 'model = "random_walk"\narguments = {{ leg = 3, time = "{time} s" }}'


@pytest.fixture
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.chdir(tmp_path)
    text = TEXT.replace("ROBOTS", "2").replace(
        "  behavior Walking", f"  behavior Walking\n  {BODY}"
    )
    text = text.replace("rover : Rover[2]", f"rover : Rover[2]\n  {PLACES}")
    Path("demo.swarm").write_text(text + PROPERTIES, encoding="utf-8")
    return tmp_path


def verdicts(kind: str, scenario: str) -> dict[str, str]:
    Path("s.toml").write_text(scenario, encoding="utf-8")
    command = ["simulate", "demo.swarm", "--scenario", "s.toml", "--trace", "none"]
    run([*command, "--world", kind, "--results", "r.json"])
    found = json.loads(Path("r.json").read_text(encoding="utf-8"))
    return {each["name"]: each["verdict"] for each in found["properties"]}


@pytest.mark.parametrize(
    ("time", "expected"),
    [
        (4, {"Arrives": "true", "Unharmed": "true", "Alone": "false"}),
        (60, {"Arrives": "open", "Unharmed": "true", "Alone": "true"}),
    ],
    ids=["arrive", "go on"],
)
def test_a_model_has_the_same_verdicts_in_all_worlds(
    folder: Path, time: int, expected: dict[str, str]
) -> None:
    walk = SCENARIO.format(choice=GO.format(time=time))
    assert verdicts("flat", walk) == expected
    assert verdicts("physics", walk) == expected
    assert verdicts("abstract", SCENARIO.format(choice=f'duration = "{time} s"')) == expected


def test_without_mujoco_it_is_said(
    folder: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.setattr(choose_space, "has_mujoco", lambda: False)
    assert run(["simulate", "demo.swarm", "--world", "physics"]) == 1
    said = capsys.readouterr().err
    assert "error[SW1014]: there is no physics world here: it needs MuJoCo" in said
    assert "pip install 'swarmdsl[physics]'" in said


def test_a_scenario_chooses_physics(folder: Path, capsys: pytest.CaptureFixture[str]) -> None:
    scenario = '[world]\nkind = "physics"\n' + SCENARIO.replace('until = "20 s"\n', "").format(
        choice='model = "go_to"\narguments = { to = [14, 10] }'
    )
    Path("s.toml").write_text(scenario, encoding="utf-8")
    command = ["simulate", "demo.swarm", "--scenario", "s.toml", "--trace", "json"]
    assert run([*command, "--until", "6s"]) == 0
    lines = [json.loads(line) for line in capsys.readouterr().out.splitlines()]
    (end,) = (line for line in lines if line["event"] == "do.Walk.succeeded")
    assert end["member"] == "rover[0]"
    assert end["at"] == pytest.approx([14, 10, 0], abs=0.1)
    # At 2 m/s it takes 2 s; with an acceleration and a way to brake it takes longer.
    assert 2500 < end["t"] < 5500


def pixels(file: Path) -> tuple[tuple[int, int], bytes]:
    """Size and rows of a PNG, each row after the number of its filter."""
    data = file.read_bytes()
    assert data.startswith(b"\x89PNG\r\n\x1a\n")
    place, found = 8, {}
    while place < len(data):
        (length,) = struct.unpack_from(">I", data, place)
        kind, chunk = data[place + 4 : place + 8], data[place + 8 : place + 8 + length]
        (check,) = struct.unpack_from(">I", data, place + 8 + length)
        assert check == zlib.crc32(kind + chunk)
        found[kind] = chunk
        place += 12 + length
    width, height = struct.unpack_from(">II", found[b"IHDR"])
    return (width, height), zlib.decompress(found[b"IDAT"])


def test_a_picture_shows_the_robots(folder: Path, capsys: pytest.CaptureFixture[str]) -> None:
    command = ["simulate", "demo.swarm", "--until", "200ms", "--trace", "none"]
    command += ["--world", "physics", "--picture", "end.png"]
    if run(command) != 0:
        said = capsys.readouterr().err
        assert "error[SW1022]: there is no picture of the robots: " in said
        pytest.skip(f"MuJoCo cannot draw here: {said.splitlines()[0]}")
    assert "written: end.png" in capsys.readouterr().err
    (width, height), rows = pixels(Path("end.png"))
    assert len(rows) == height * (1 + 3 * width)
    whole = np.frombuffer(rows, dtype=np.uint8).reshape(height, 1 + 3 * width)[:, 1:]
    red, _, blue = whole.reshape(height, width, 3).astype(int).transpose(2, 0, 1)
    # Two orange robots, 20 m apart from south to north, in the middle.
    lines, columns = np.nonzero(red > blue + 30)
    assert lines.min() < height / 2 < lines.max()
    assert abs(columns.mean() - width / 2) < width / 20


def test_a_renderer_that_fails_is_said(
    folder: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    def fail(name: str) -> None:
        raise ImportError("no library EGL")

    monkeypatch.setattr(picture, "import_module", fail)
    command = ["simulate", "demo.swarm", "--until", "200ms", "--picture", "end.png"]
    assert run([*command, "--world", "physics"]) == 1
    assert "SW1022]: there is no picture of the robots: no library EGL" in capsys.readouterr().err
    assert run([*command, "--world", "flat"]) == 1
    assert "only the world `physics` has bodies to draw" in capsys.readouterr().err
    assert not Path("end.png").exists()


def test_search_and_rescue_goes_in_physics_as_in_the_plane(tmp_path: Path) -> None:
    """A UAV finds a person and a rover drives there, in both worlds; in physics a bit later."""
    text = (MEADOW / "mission.toml").read_text(encoding="utf-8")
    scenario = tmp_path / "mission.toml"
    scenario.write_text(text.replace("uav   = 3", "uav   = 2").replace("rover = 2", "rover = 1"))
    found: dict[str, tuple[dict[str, Any], dict[str, list[str]]]] = {}
    for kind in ("flat", "physics"):
        results, trace = tmp_path / f"{kind}.json", tmp_path / f"{kind}.jsonl"
        command = ["simulate", str(MEADOW), "--scenario", str(scenario), "--seed", "8"]
        command += ["--until", "27s", "--results", str(results), "--trace-file", str(trace)]
        assert run([*command, "--world", kind]) == 0
        begun: dict[str, list[str]] = {}
        for line in map(json.loads, trace.read_text(encoding="utf-8").splitlines()):
            if line.get("started"):
                begun.setdefault(line["member"], []).extend(line["started"])
        found[kind] = json.loads(results.read_text(encoding="utf-8")), begun
    flat, physics = found["flat"], found["physics"]
    for member in ("uav[0]", "uav[1]", "rover[0]"):
        both = list(zip(flat[1][member], physics[1][member], strict=False))
        assert all(one == other for one, other in both)
        assert len(both) >= 2
    assert physics[1]["rover[0]"][:2] == ["bid_action", "ugv_move_to"]
    verdicts = [
        {each["name"]: each["verdict"] for each in results["properties"]}
        for results, _ in (flat, physics)
    ]
    assert verdicts[0] == verdicts[1]
    assert set(verdicts[0].values()) == {"true"}
    values = [results["fitness"]["value"] for results, _ in (flat, physics)]
    assert values[1] == pytest.approx(values[0], abs=0.05)
    assert values[0] > 0.9
