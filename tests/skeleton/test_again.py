"""A model changes beside code by hand: none of that is lost, and what it affects is told."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import pytest

from swarmdsl.codegen.emit import Request
from swarmdsl.driver import pipeline

from .test_output import VARIANTS

MODEL = (Path(__file__).parent / "model.swarm").read_text(encoding="utf-8")
OF_SWARMC = {".swarmc-changes", ".swarmc-new"}
CHANGES = [
    ("    height : float64\n", "    height : float64\n    speed  : float64\n"),
    ("height : float64", "height : float32"),
    ('in  "state"              : Sample', 'in  "condition" : Sample'),
    ("steps     : int32    = 3", "steps     : float64  = 3"),
]
NO_CHANGES = [
    ("/// How high, in metres", "/// The height"),
    ("/// How near is near", "/// How far is far"),
    ("tolerance : float64  = 0.1", "tolerance : float64  = 0.2"),
    ("in    exposure : float64", "in    exposure : float32"),
]


@pytest.fixture(params=VARIANTS, ids="-".join)
def build(request: pytest.FixtureRequest, tmp_path: Path) -> Any:
    """Build a model, and return the result and the files of the user of node climb."""
    ros, language = request.param

    def build(model: str) -> tuple[pipeline.Result, list[Path]]:
        path = tmp_path / "model.swarm"
        path.write_text(model, encoding="utf-8")
        options = {"ros": ros, "language": language}
        result = pipeline.build([path], [Request("skeleton", options)], tmp_path / "out")
        folder = tmp_path / "out" / "skeleton" / "climb"
        files = (path for path in folder.rglob("*") if path.suffix not in OF_SWARMC)
        of_user = [path for path in files if path.is_file()]
        return result, [path for path in of_user if b"swarmc:fits" in path.read_bytes()]

    return build


def outdated(result: pipeline.Result) -> list[str]:
    assert not result.report.has_errors, [found.message for found in result.report]
    return [
        f"{found.message}: {found.help}" for found in result.report if found.name == "outdated-code"
    ]


def test_twice_is_once(build: Any) -> None:
    build(MODEL)
    result, _ = build(MODEL)

    assert outdated(result) == []
    assert result.written.written == ()


@pytest.mark.parametrize(("old", "new"), CHANGES)
def test_code_that_a_change_affects_is_told_until_it_is_adapted(
    build: Any, old: str, new: str
) -> None:
    _, files = build(MODEL)
    for path in files:
        path.write_text(path.read_text(encoding="utf-8") + "\nmine\n", encoding="utf-8")
    before = [path.read_bytes() for path in files]
    assert MODEL.count(old) == 1
    changed = MODEL.replace(old, new)

    for _ in range(2):
        result, again = build(changed)
        assert len(outdated(result)) == len(files) == len(again)
        assert [path.read_bytes() for path in files] == before
    told = outdated(result)[0].partition(": adapt it")[2].split("`")
    for path in files:
        text = path.read_text(encoding="utf-8")
        path.write_text(text.replace(f"swarmc:fits {told[3]}", told[1]), encoding="utf-8")
    result, _ = build(changed)
    assert outdated(result) == []
    assert not [path for path in files if path.with_name(f"{path.name}.swarmc-changes").exists()]


@pytest.mark.parametrize(("old", "new"), NO_CHANGES)
def test_what_does_not_affect_code_is_not_told(build: Any, old: str, new: str) -> None:
    build(MODEL)
    assert MODEL.count(old) == 1
    result, _ = build(MODEL.replace(old, new))

    assert [each for each in outdated(result) if "skeleton/climb/" in each] == []
