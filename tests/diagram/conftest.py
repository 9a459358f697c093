"""Models to draw."""

from __future__ import annotations

from functools import cache
from pathlib import Path

import pytest

from swarmdsl.codegen.diagram.graph import Diagram
from swarmdsl.driver import pipeline
from swarmdsl.ir import System
from swarmdsl.tools.diagram.views import diagrams

ROOT = Path(__file__).resolve().parents[2]
MODEL = ROOT / "tests" / "diagram" / "rover.swarm"
MODELS = [
    MODEL,
    *sorted(path for path in (ROOT / "examples").iterdir() if path.is_dir()),
    *(ROOT / "tests" / "golden" / name for name in ("everything", "language", "submachine")),
]


@cache
def system_of(path: Path) -> System:
    result = pipeline.check([path])
    assert result.system is not None, [found.message for found in result.report]
    return result.system


@cache
def drawn_of(path: Path) -> tuple[Diagram, ...]:
    return tuple(diagrams(system_of(path)))


@pytest.fixture(params=MODELS, ids=lambda path: path.stem)
def drawn(request: pytest.FixtureRequest) -> tuple[Diagram, ...]:
    """The diagrams of a model, one model after the other."""
    return drawn_of(request.param)
