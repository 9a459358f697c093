"""Documents with event scripts that nobody here wrote decide what is right."""

from __future__ import annotations

import json
import os
from pathlib import Path

import pytest

from swarmdsl.base.diagnostics.collector import Diagnostics
from swarmdsl.base.source import Source
from swarmdsl.execution.engine import Event, Instance
from swarmdsl.execution.scxml import read

from ..engine.world import StillWorld

ROOT = Path(__file__).resolve().parents[2]
CORPUS = Path(os.environ.get("SWARMDSL_CORPUS", ROOT.parent / "shared" / "corpus"))
FOLDER = CORPUS / "statecharts"
DOCUMENTS = sorted(FOLDER.glob("*/*.scxml"))


@pytest.mark.skipif(not DOCUMENTS, reason=f"no state charts in {FOLDER} (set SWARMDSL_CORPUS)")
def test_there_are_scripts() -> None:
    assert len(DOCUMENTS) == 29


@pytest.mark.parametrize("path", DOCUMENTS, ids=lambda path: f"{path.parent.name}/{path.stem}")
def test_script(path: Path) -> None:
    script = json.loads(path.with_suffix(".json").read_text(encoding="utf-8"))
    report = Diagnostics()
    machine = read(Source(path.name, path.read_text(encoding="utf-8"), path), report)
    assert machine is not None, [found.message for found in report]
    assert not list(report)
    world = StillWorld()
    instance = Instance(machine, world)
    instance.start()

    assert set(instance.configuration.innermost) == set(script["initialConfiguration"])
    for step in script["events"]:
        world.clock.advance(step.get("after", 0) * 1_000_000)
        instance.receive(Event(step["event"]["name"], step["event"].get("data")))
        assert set(instance.configuration.innermost) == set(step["nextConfiguration"])
    assert not world.errors
