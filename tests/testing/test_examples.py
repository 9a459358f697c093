"""The examples have tests, which pass and reach nine tenths of them, and properties."""

from __future__ import annotations

import re
from io import StringIO
from pathlib import Path

import pytest

from swarmdsl.driver import pipeline
from swarmdsl.execution.testing.command import Request, run

EXAMPLES = Path(__file__).resolve().parents[2] / "examples"
FOLDERS = sorted(path.name for path in EXAMPLES.iterdir() if path.is_dir())


@pytest.mark.parametrize("folder", FOLDERS)
def test_an_example(folder: str) -> None:
    out = StringIO()
    passed = run(Request((EXAMPLES / folder,), fail_under=90), out, StringIO())

    assert passed, out.getvalue()


@pytest.mark.parametrize("folder", FOLDERS)
def test_properties_that_a_fault_breaks(folder: str) -> None:
    system = pipeline.check([EXAMPLES / folder]).system
    assert system is not None
    of_a_swarm = [each for each in system.properties if each.each is None]
    assert len(system.properties) >= 4
    assert len(of_a_swarm) >= 2
    if folder == "meadow":
        return  # its robots are those of search_and_rescue, whose tests break them

    tests = [path.read_text(encoding="utf-8") for path in (EXAMPLES / folder).glob("*test.toml")]
    assert any(
        re.search(rf'^violates += \["{each.name}"\]$', text, re.MULTILINE)
        for text in tests
        for each in system.properties
        if each.chance is None
    )
