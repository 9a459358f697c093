"""Fixes of diagnostics: the text that the help proposes, at its place.

Help is prose that names code; each rule reads the help of one kind of diagnostic. So the words that
a person reads and the change that a program makes are the same.
"""

from __future__ import annotations

import re
from functools import cache
from pathlib import Path

from swarmdsl.base.diagnostics.advice import Advice
from swarmdsl.base.diagnostics.collector import Diagnostic, Diagnostics, Fix
from swarmdsl.base.records import replace
from swarmdsl.base.source import Span
from swarmdsl.driver.fixes import insertions, missing_values, removals, replacements
from swarmdsl.driver.fixes.new_names import renamed
from swarmdsl.driver.fixes.problem import Act, Problem, Rule
from swarmdsl.driver.workspace import Workspace

SLOW = "naming-style"
"""Diagnostic whose fix is tried on the whole model, since a new name may mean something else."""


_ACTS: dict[str, Act] = {**insertions.ACTS, **replacements.ACTS}


@cache
def _rules() -> tuple[tuple[re.Pattern[str], Rule], ...]:
    every = (*insertions.RULES, *missing_values.RULES, *removals.RULES, *replacements.RULES)
    return tuple((re.compile(pattern, re.DOTALL), rule) for pattern, rule in every)


def fixes_of(found: Diagnostic, workspace: Workspace, *, unsafe: bool = True) -> tuple[Fix, ...]:
    """Return the fixes of a diagnostic of a workspace, or its safe ones, the best one first."""
    if found.primary is None or found.help is None:
        return ()
    span = found.primary.span.absolute
    path = span.source.path
    file = workspace.file(path) if isinstance(path, Path) else None
    if file is None or file.library:
        return ()
    # The workspace may have read the file anew since: for a rename that was tried.
    problem = Problem(found, workspace, file, Span(file.source, span.start, span.end))
    if found.name == SLOW:  # and never safe
        return renamed(problem) if unsafe else ()
    if isinstance(found.help, Advice):
        act = _ACTS[found.help.act]
        return tuple(each for each in act(problem, *found.help.arguments) if unsafe or each.safe)
    for pattern, rule in _rules():
        if (match := pattern.fullmatch(found.help)) is not None:
            return tuple(each for each in rule(problem, match) if unsafe or each.safe)
    return ()


def add_fixes(report: Diagnostics, workspace: Workspace) -> Diagnostics:
    """Add the fixes to the diagnostics of a workspace, but for slow ones."""
    report.change(
        lambda found: (
            found if found.name == SLOW else replace(found, fixes=fixes_of(found, workspace))
        )
    )
    return report
