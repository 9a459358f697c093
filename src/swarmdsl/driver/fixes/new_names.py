"""Fixes that give a declaration another name, wherever it is used."""

from __future__ import annotations

import re

from swarmdsl.base.diagnostics.collector import Fix
from swarmdsl.driver.fixes.problem import Problem
from swarmdsl.driver.workspace.renaming import RefusedError, rename

_NAME = re.compile(r"write `(\w+)`")


def renamed(problem: Problem) -> tuple[Fix, ...]:
    """Return the fix that renames an element to the name that the help proposes."""
    match = _NAME.fullmatch(problem.found.help or "")
    if match is None:
        return ()
    try:
        spans = rename(problem.workspace, problem.file, problem.span.start, match[1])
    except RefusedError:
        return ()
    edits = tuple((span.absolute, match[1]) for span in spans)
    return (Fix(f"Rename to `{match[1]}`", edits),)
