"""The document generated from a model behaves the same in every engine."""

from __future__ import annotations

from collections.abc import Callable
from functools import cache
from pathlib import Path

import pytest

from swarmdsl.base.diagnostics.collector import Diagnostics
from swarmdsl.codegen.exchange import scxml
from swarmdsl.driver import pipeline

from ..exchange.scxml_machines import with_documents
from .engines import ENGINES, with_values
from .known import MODELS
from .replay import difference, engines
from .scripts import NEVER, Script, Subject, params, titled

ROOT = Path(__file__).resolve().parents[2]
MEMBERS = ROOT / "tests" / "golden" / "members" / "model.swarm"
FILES = [
    ROOT / "tests" / "agreement" / "machines.swarm",
    *sorted(path.parent for path in (ROOT / "examples").glob("*/README.md")),
    # Machines are alone here, without members to count.
    *sorted(set((ROOT / "tests" / "golden").glob("*/model.swarm")) - {MEMBERS}),
]


@cache
def subjects(path: Path) -> dict[str, tuple[Subject, str]]:
    """The machines of a model, and their documents."""
    system = pipeline.check([path]).system
    assert system is not None
    system = with_documents(system)
    files = {f.path: f.text for f in scxml.emit(system, scxml.Options("portable"), Diagnostics())}
    return {m.name: (Subject(m, system), files[f"{m.name}.scxml"]) for m in system.machines}


@cache
def scripts(path: Path, name: str) -> tuple[list[Script], list[str]]:
    """The scripts of a machine, and the transitions that none of them takes."""
    never = NEVER.get((titled(path), name), [])
    found, missing = subjects(path)[name][0].scripts(len(never))
    return found, [each.origin.text for each in missing if each.origin is not None]


MACHINES = params(FILES)


@pytest.mark.parametrize("path", MACHINES)
def test_scripts_take_every_transition(path: Path) -> None:
    for name in subjects(path):
        _, missing = scripts(path, name)
        assert missing == NEVER.get((titled(path), name), [])


@pytest.mark.parametrize("engine", engines())
@pytest.mark.parametrize("path", MACHINES)
def test_engines_agree(path: Path, engine: str, agree: Callable[..., None]) -> None:
    differences = {}
    for name, (subject, text) in subjects(path).items():
        document = with_values(text, subject.given)
        found = [difference(ENGINES[engine], document, each) for each in scripts(path, name)[0]]
        agree(f"{titled(path)}: {name}", engine, len(found), found.count(None))
        cause = MODELS.get((name, engine))
        known = [each for each in found if each is not None]
        if cause is None and known:
            differences[name] = known[0]
        if cause is not None:
            assert known, f"{name} does not show any more: {cause.reason}"
    assert not differences
