"""Generated machines in this process, on YASMIN alone: what they follow is the engine of a test.

They run twice: on the stand-in beside this file, and on the real core of YASMIN where
SWARMDSL_YASMIN_PATH names the folder that it is in, or Python has it.
"""

from __future__ import annotations

import functools
import importlib.util
import os
import sys
from collections.abc import Iterator
from pathlib import Path
from types import ModuleType

import pytest

from swarmdsl.base.diagnostics.collector import Diagnostics
from swarmdsl.codegen.api import OutputFile
from swarmdsl.codegen.options import parse_options
from swarmdsl.codegen.registry import load
from swarmdsl.ir import System

from ..ros2_outcomes.fixtures import Emit, generate, reported
from ..ros2_outcomes.generated import Builder, forget

__all__ = ["generate", "reported"]  # fixtures

# The modules of YASMIN, of the stand-in and of the real one: that can be imported only once.
_LOADED: dict[bool, dict[str, ModuleType]] = {}
STAND_IN = Path(__file__).parent / "stand_in"


@pytest.fixture
def emit() -> Emit:
    """Generate from a system; return the files and the diagnostics."""

    def emit(system: System, **options: str) -> tuple[list[OutputFile], Diagnostics]:
        generator = load("yasmin")
        report = Diagnostics()
        chosen = parse_options(generator, options, report)
        files = [] if report.has_errors else list(generator.emit(system, chosen, report))
        return files, report

    return emit


@functools.cache
def _real_yasmin() -> tuple[str, ...] | None:
    """The folders that the real YASMIN is imported from, None where there is none."""
    if "SWARMDSL_YASMIN_PATH" in os.environ:
        return tuple(os.environ["SWARMDSL_YASMIN_PATH"].split(os.pathsep))
    return () if importlib.util.find_spec("yasmin") is not None else None


@pytest.fixture(params=["stand-in", "real"])
def yasmin_path(request: pytest.FixtureRequest) -> tuple[str, ...]:
    """The folders of the YASMIN to run on: the stand-in, then the real one where there is one."""
    if request.param == "stand-in":
        return (str(STAND_IN),)
    found = _real_yasmin()
    if found is None:
        pytest.skip("no real YASMIN: SWARMDSL_YASMIN_PATH names the folders of it")
    return found


@pytest.fixture
def build(
    yasmin_path: tuple[str, ...], emit: Emit, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> Iterator[Builder]:
    """Generate a system and import the module of a machine; `chart` stands for the table."""
    for place in yasmin_path:
        monkeypatch.syspath_prepend(place)
    kind = str(STAND_IN) in yasmin_path
    sys.modules.update(_LOADED.setdefault(kind, {}))

    def files(system: System) -> list[OutputFile]:
        found, report = emit(system)
        assert not list(report), [each.message for each in report]
        return found

    made = Builder(files, "_fsm", tmp_path, monkeypatch)
    yield made
    made.close()
    _LOADED[kind].update(forget({"yasmin"}))
