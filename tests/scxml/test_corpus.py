"""Documents with event scripts that nobody here wrote decide what is right."""

from __future__ import annotations

import json
import os
from collections import Counter
from pathlib import Path

import pytest

from swarmdsl.base.diagnostics.collector import Diagnostics
from swarmdsl.base.source import Source
from swarmdsl.execution.engine import Event, Instance
from swarmdsl.execution.scxml import read

from ..engine.world import StillWorld
from .suite import judge

ROOT = Path(__file__).resolve().parents[2]
CORPUS = Path(os.environ.get("SWARMDSL_CORPUS", ROOT.parent / "shared" / "corpus"))
FOLDER = CORPUS / "statecharts"
DOCUMENTS = sorted(FOLDER.glob("*/*.scxml"))
JUDGES = sorted((CORPUS / "w3c-ecma").glob("*.scxml"))


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


@pytest.mark.skipif(not JUDGES, reason=f"no tests of the W3C in {CORPUS} (set SWARMDSL_CORPUS)")
def test_documents_that_judge_themselves() -> None:
    """None is run and answered wrongly; `make w3c` runs all of them."""
    verdicts = {path.name: judge(path.name, path.read_text(encoding="utf-8")) for path in JUDGES}

    assert [name for name, verdict in verdicts.items() if verdict.word == "wrong"] == []
    counts = Counter(verdict.word for verdict in verdicts.values())
    assert counts == {"pass": 91, "refuse": 37, "unjudged": 4}
