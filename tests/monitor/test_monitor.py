"""Monitors agree with the definitions of the patterns."""

from __future__ import annotations

import ast
import sys
from pathlib import Path

import pytest

from swarmdsl.execution import monitor
from swarmdsl.execution.monitor import FALSE, OPEN, TRUE, Monitor, Sentence

from .random_lines import check_lines
from .random_runs import check_many

FOLDER = Path(monitor.__file__).parent


@pytest.mark.parametrize("seed", range(4))
def test_random_properties_and_runs(seed: int) -> None:
    counts = check_many(500, seed)
    assert min(counts[FALSE], counts[OPEN], counts[TRUE]) > 25


@pytest.mark.parametrize("seed", range(2))
def test_random_properties_of_messages_and_lines(seed: int) -> None:
    counts = check_lines(500, seed)
    assert min(counts[FALSE], counts[OPEN], counts[TRUE]) > 25


@pytest.mark.parametrize("path", sorted(FOLDER.glob("*.py")), ids=lambda path: path.name)
def test_it_imports_the_standard_library_only(path: Path) -> None:
    for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
        if isinstance(node, ast.ImportFrom):
            assert node.module is not None
            root = node.module.partition(".")[0]
            assert node.level or root in sys.stdlib_module_names
        elif isinstance(node, ast.Import):
            assert {each.name.partition(".")[0] for each in node.names} <= sys.stdlib_module_names


def test_what_is_late_is_violated_when_it_was_due() -> None:
    watched = Monitor(Sentence("leads", within=10))
    watched.step(5, (True, False))
    assert watched.due == 15
    watched.step(15, (False, False))
    assert watched.violated is None
    watched.step(40, (False, True))
    assert watched.violated == 15
    assert watched.finish(50) == FALSE


def test_the_earliest_cause_is_due_first() -> None:
    watched = Monitor(Sentence("leads", within=10))
    watched.step(0, (True, False))
    watched.step(9, (True, False))
    assert watched.due == 10
    watched.step(10, (False, True))
    assert watched.due is None
    assert watched.finish(100) == TRUE


def test_a_part_without_an_end_is_open() -> None:
    watched = Monitor(Sentence("never", scope="between"))
    watched.step(1, (False,), (True, False))
    watched.step(2, (True,), (False, False))
    assert watched.violated is None
    assert watched.finish(3) == OPEN
    watched.step(4, (False,), (False, True))
    assert watched.violated == 4
