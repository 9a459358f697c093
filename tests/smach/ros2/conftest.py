"""Packages for ROS 2: their text, and their machines in this process, on SMACH alone."""

from __future__ import annotations

import importlib
import warnings
from collections.abc import Iterator
from pathlib import Path

import pytest

from swarmdsl.base.diagnostics.collector import Diagnostics
from swarmdsl.codegen.api import OutputFile
from swarmdsl.ir import System

from ...ros2_outcomes.fixtures import Emit, generate, reported
from ...ros2_outcomes.generated import Builder, forget
from ..conftest import emit as emit_for

__all__ = ["generate", "reported"]  # fixtures

ROS = {"ros": "2"}


@pytest.fixture
def emit() -> Emit:
    """Generate for ROS 2; return the files and the diagnostics."""

    def emit(system: System, **options: str) -> tuple[list[OutputFile], Diagnostics]:
        return emit_for(system, **ROS, **options)

    return emit


@pytest.fixture
def build(
    smach_path: tuple[str, ...], emit: Emit, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> Iterator[Builder]:
    """Generate a system and import the module of a machine; `chart` stands for the table."""
    for place in smach_path:
        monkeypatch.syspath_prepend(place)
    forget({"smach"})
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", SyntaxWarning)  # of which 3.0.3 causes one
        importlib.import_module("smach")

    def files(system: System) -> list[OutputFile]:
        found, report = emit(system)
        assert not list(report), [each.message for each in report]
        return found

    made = Builder(files, "_smach", tmp_path, monkeypatch)
    yield made
    made.close()
    forget({"smach"})
