"""Verdicts for programs: JSON and JUnit XML."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import pytest
from lxml import etree

from swarmdsl.cli import run

from .conftest import MODELS, ROOT

WAITS = str(MODELS / "waits.swarm")


def junit(path: Path) -> etree._Element:
    tree = etree.parse(path)
    etree.XMLSchema(file=ROOT / "tests" / "testing" / "junit.xsd").assertValid(tree)
    return tree.getroot()


def results(path: Path, *arguments: str) -> dict[str, Any]:
    run(["verify", WAITS, "--results", str(path), *arguments])
    found: dict[str, Any] = json.loads(path.read_text(encoding="utf-8"))
    return found


def test_results_name_verdicts_and_their_runs(tmp_path: Path) -> None:
    runs = tmp_path / "runs"
    found = results(tmp_path / "out.json", "-o", str(runs))

    assert found["subject"] == "Pair"
    assert found["sizes"] == [{"worker": 2}]
    assert "functions, delays and messages take any time" in found["conditions"]
    properties = {each["name"]: each for each in found["properties"]}
    assert properties["BothEnd"]["verdict"] == "fails"
    assert Path(properties["BothEnd"]["run"]) == runs / "BothEnd.jsonl"
    (stuck,) = found["findings"]
    assert stuck["code"] == "SW1702"
    assert Path(stuck["run"]).read_text(encoding="utf-8").count("\n") > 1


def test_results_tell_how_far_a_search_got(tmp_path: Path) -> None:
    found = results(tmp_path / "out.json", "--limit", "2")
    limited = [each for each in found["properties"] if each["verdict"] == "holds up to"]

    assert limited
    assert all(each["states"] >= 2 and "limit" in each["reason"] for each in limited)


def test_junit_has_a_case_for_each_property(tmp_path: Path) -> None:
    out = tmp_path / "out.xml"
    assert run(["verify", WAITS, "--junit", str(out)]) == 1
    root = junit(out)

    cases = {case.get("name"): case for case in root.iter("testcase")}
    (failure,) = cases["BothEnd"]
    assert failure.get("type") == "refuted-property"
    assert "a shortest run, of" in str(failure.text)
    assert "warning[SW1702]" in str(root.findtext(".//system-out"))


def test_junit_skips_what_is_open_and_tells_errors_of_the_model(tmp_path: Path) -> None:
    out = tmp_path / "out.xml"
    assert run(["verify", WAITS, "--junit", str(out), "--limit", "2"]) == 1
    messages = [str(each.get("message")) for each in junit(out).iter("skipped")]
    assert messages
    assert all(each.startswith("holds up to ") for each in messages)

    model = tmp_path / "model.swarm"
    model.write_text("const A : int32 = B\n", encoding="utf-8")
    assert run(["verify", str(model), "--junit", str(out)]) == 1
    (error,) = junit(out).iter("error")
    assert error.get("message") == "no value called `B`"


@pytest.mark.parametrize("option", ["--results", "--junit"])
def test_a_file_that_cannot_be_written_is_told(
    option: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    assert run(["verify", WAITS, option, str(tmp_path / "no" / "out")]) == 1
    assert "error[SW0909]: cannot write" in capsys.readouterr().out
