"""Fixes that give a declaration another name, wherever it is used."""

from __future__ import annotations

from collections.abc import Iterator

from swarmdsl.base.diagnostics.collector import Fix
from swarmdsl.driver.fixes.problem import Problem, Rules
from swarmdsl.driver.workspace.renaming import RefusedError, rename


def _renamed(problem: Problem, name: str) -> Iterator[Fix]:
    """Rename an element everywhere; it is tried on the model, which takes a while."""
    try:
        spans = rename(problem.workspace, problem.file, problem.span.start, name)
    except RefusedError:
        return
    yield Fix(f"Rename to `{name}`", tuple((span.absolute, name) for span in spans))


RULES: Rules = {"rename everywhere": _renamed}
