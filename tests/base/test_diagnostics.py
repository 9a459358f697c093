"""Diagnostics of wrong models, as text.

A case is a file `SWnnnn_what.swarm`, or a folder of that name with several files; its diagnostics
are in the `.txt` file next to it. `pytest --bless` rewrites these: read them before you commit.
"""

from __future__ import annotations

from io import StringIO
from pathlib import Path

import pytest

from swarmdsl.base.diagnostics.catalog import CODES
from swarmdsl.base.diagnostics.collector import Level
from swarmdsl.base.diagnostics.render import render
from swarmdsl.driver import pipeline
from swarmdsl.driver.config.settings import Settings

FOLDER = Path(__file__).parents[1] / "diagnostics"
NAMES = {entry.code: name for name, entry in CODES.items()}
CASES = sorted(path.name for path in FOLDER.glob("SW*") if path.is_dir() or path.suffix != ".txt")


def expected(case: str) -> Path:
    return FOLDER / f"{Path(case).stem}.txt"


@pytest.mark.parametrize("case", CASES)
def test_diagnostics(case: str, bless: bool, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(FOLDER)
    # As without ROS, since packages that are installed have other advice.
    monkeypatch.delenv("AMENT_PREFIX_PATH", raising=False)
    # A warning that is silent by default is asked for where the case shows it.
    settings = Settings(levels={NAMES[case[:6]]: Level.WARN})
    report = pipeline.check([Path(case)], settings).report
    stream = StringIO()
    render(report, "text", stream)
    if bless:
        expected(case).write_text(stream.getvalue(), encoding="utf-8")

    assert stream.getvalue() == expected(case).read_text(encoding="utf-8")
    # One cause, one report: a case shows its own code and nothing that follows from it.
    assert {found.code for found in report} == {case[:6]}


def test_every_expected_text_has_its_case() -> None:
    assert sorted(map(expected, CASES)) == sorted(FOLDER.glob("*.txt"))


def test_the_folder_holds_cases_only() -> None:
    others = {path.name for path in FOLDER.iterdir() if path.suffix != ".txt"} - set(CASES)

    assert others == set()
