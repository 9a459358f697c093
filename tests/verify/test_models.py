"""Output of `swarmc verify` about small models: verdicts, findings and runs."""

from __future__ import annotations

import re
from pathlib import Path

import pytest

from swarmdsl.cli import run

from .conftest import MODELS

FOUND = {
    "SW1701": "waits",
    "SW1702": "stuck",
    "SW1703": "waits_for_ever",
    "SW1704": "absent",
    "SW1705": "computes",
    "SW1706": "unhandled",
    "SW1707": "loops",
    "SW1708": "computes",
    "SW1710": "answers",
}


@pytest.mark.parametrize("model", sorted(path.stem for path in MODELS.glob("*.swarm")))
def test_output_is_as_before(
    model: str, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch, bless: bool
) -> None:
    monkeypatch.chdir(MODELS)
    first = (MODELS / f"{model}.swarm").read_text(encoding="utf-8").partition("\n")[0]
    options = first.removeprefix("//").split() if first.startswith("//") else []
    expected = MODELS / f"{model}.txt"

    code = run(["verify", f"{model}.swarm", *options])
    printed = capsys.readouterr()
    text = f"{printed.out}exit code {code}\n"

    if bless:
        expected.write_text(text, encoding="utf-8")
    assert printed.err == ""
    assert text == expected.read_text(encoding="utf-8")


def test_there_is_a_model_for_each_diagnostic() -> None:
    for code, model in FOUND.items():
        assert f"[{code}]" in (MODELS / f"{model}.txt").read_text(encoding="utf-8")


@pytest.mark.parametrize(
    "model",
    sorted(p.stem for p in MODELS.glob("*.swarm") if "SW17" in p.with_suffix(".txt").read_text()),
)
def test_runs_play_on_the_model(
    model: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    path = MODELS / f"{model}.swarm"
    options = ["--lossy"] if model == "stuck" else ["--limit", "3k"]
    run(["verify", str(path), *options, "-o", str(tmp_path)])
    written = re.findall(r"^written: (.*)$", capsys.readouterr().out, re.MULTILINE)

    for trace in written:
        run(["simulate", str(path), "--replay", trace, "--no-properties"])
        assert "as in the model" in (told := capsys.readouterr()).err
        # A replay ends a machine in an endless loop as the engine does, but as a departure.
        assert ("SW1011" in told.err) == ("loops-" in trace)
    assert bool(written) == (model != "absent")
