"""Packages for ROS 2: their text, and their machines in this process, on SMACH alone."""

from __future__ import annotations

import importlib
import warnings
from collections.abc import Callable, Iterator
from pathlib import Path

import pytest

from swarmdsl.diagnostics import Diagnostics
from swarmdsl.generator import OutputFile
from swarmdsl.ir import System

from ...following.generated import Builder, forget
from ..conftest import emit as emit_for

ROS = {"ros": "2"}


def emit(system: System, **options: str) -> tuple[list[OutputFile], Diagnostics]:
    """What the generator makes of a system for ROS 2, and what it reports."""
    return emit_for(system, **ROS, **options)


@pytest.fixture
def generate(compiled: Callable[[str], System]) -> Callable[..., dict[str, str]]:
    """Generate from the text of a model; the texts by path in the package of the behaviour."""

    def generate(text: str, **options: str) -> dict[str, str]:
        files, report = emit(compiled(text), **options)
        assert not list(report)
        package = files[0].path.partition("/")[0] + "/"
        return {file.path.removeprefix(package): file.text for file in files}

    return generate


@pytest.fixture
def reported(compiled: Callable[[str], System]) -> Callable[..., list[tuple[str, str, str]]]:
    """What is reported about a model: name, message, the text it points at."""

    def reported(text: str, **options: str) -> list[tuple[str, str, str]]:
        _, report = emit(compiled(text), **options)
        return [
            (found.name, found.message, found.primary.span.text if found.primary else "")
            for found in report
        ]

    return reported


@pytest.fixture
def build(
    smach_path: tuple[str, ...], tmp_path: Path, monkeypatch: pytest.MonkeyPatch
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
