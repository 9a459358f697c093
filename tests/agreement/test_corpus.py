"""Documents with event scripts that nobody here wrote, in every engine."""

from __future__ import annotations

import json
import os
from collections.abc import Callable
from pathlib import Path

import pytest
from lxml import etree

from .engines import ENGINES, S, Step
from .replay import engines

ROOT = Path(__file__).resolve().parents[2]
CORPUS = Path(os.environ.get("SWARMDSL_CORPUS", ROOT.parent / "shared" / "corpus"))
DOCUMENTS = sorted((CORPUS / "statecharts").glob("*/*.scxml"))


@pytest.mark.skipif(not DOCUMENTS, reason=f"no state charts in {CORPUS} (set SWARMDSL_CORPUS)")
@pytest.mark.parametrize("engine", engines())
def test_scripts(engine: str, agree: Callable[..., None]) -> None:
    different = []
    for path in DOCUMENTS:
        document = path.read_bytes()
        script = json.loads(path.with_suffix(".json").read_text(encoding="utf-8"))
        outer = {
            state.getparent().get("id")
            for tag in ("state", "parallel", "final")
            for state in etree.fromstring(document).iter(f"{S}{tag}")
        }
        machine = ENGINES[engine](document)
        found = [machine.active - outer]
        for step in script["events"]:
            machine.take(Step(step["event"]["name"]))
            found.append(machine.active - outer)
        wanted = [script["initialConfiguration"]]
        wanted += [step["nextConfiguration"] for step in script["events"]]
        if found != list(map(set, wanted)):
            different.append(path.stem)
    agree("scripts of others", engine, len(DOCUMENTS), len(DOCUMENTS) - len(different))
    assert not different
