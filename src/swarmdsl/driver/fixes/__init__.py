"""Fixes of diagnostics: the changes that their help names.

A diagnostic carries its change as data beside the words (`base/diagnostics/advice.py`), so that
what a person reads and what a program does are made in one place. Here is a rule for each act.
"""

from __future__ import annotations

from pathlib import Path

from swarmdsl.base.diagnostics.advice import Advice
from swarmdsl.base.diagnostics.collector import Diagnostic, Diagnostics, Fix
from swarmdsl.base.records import replace
from swarmdsl.base.source import Span
from swarmdsl.driver.fixes import (
    edits,
    insertions,
    missing_values,
    new_names,
    removals,
    replacements,
)
from swarmdsl.driver.fixes.problem import Problem, Rules
from swarmdsl.driver.workspace import Workspace

SLOW = "naming-style"
"""Diagnostic whose fix is tried on the whole model, since a new name may mean something else."""

RULES: Rules = {
    **edits.RULES,
    **insertions.RULES,
    **missing_values.RULES,
    **new_names.RULES,
    **removals.RULES,
    **replacements.RULES,
}


def fixes_of(found: Diagnostic, workspace: Workspace, *, unsafe: bool = True) -> tuple[Fix, ...]:
    """Return the fixes of a diagnostic of a workspace, or its safe ones, the best one first."""
    if found.primary is None or not isinstance(found.help, Advice):
        return ()
    if found.name == SLOW and not unsafe:
        return ()  # it is never safe
    span = found.primary.span.absolute
    path = span.source.path
    file = workspace.file(path) if isinstance(path, Path) else None
    if file is None or file.library:
        return ()
    # The workspace may have read the file anew since: for a rename that was tried.
    problem = Problem(found, workspace, file, Span(file.source, span.start, span.end))
    rule = RULES[found.help.act]
    return tuple(each for each in rule(problem, *found.help.arguments) if unsafe or each.safe)


def add_fixes(report: Diagnostics, workspace: Workspace) -> Diagnostics:
    """Add the fixes to the diagnostics of a workspace, but for slow ones."""
    report.change(
        lambda found: (
            found if found.name == SLOW else replace(found, fixes=fixes_of(found, workspace))
        )
    )
    return report
