"""Writes the generated files: all of them or none, and never over what the user wrote.

The files of target `t` go to the folder `t` of the output folder. A manifest lists what
was generated there; whatever is not in it, or was edited since, is the user's.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from pathlib import Path

from swarmdsl.base.diagnostics.collector import Diagnostics
from swarmdsl.codegen.api import OutputFile
from swarmdsl.output import warnings
from swarmdsl.output.apply import carry_out
from swarmdsl.output.changes import Action, Change, How, Written
from swarmdsl.output.disk import report_os_error
from swarmdsl.output.plan import Plan
from swarmdsl.output.prepare import opened
from swarmdsl.output.removals import drop_stale
from swarmdsl.output.renames import add_strays, find_moves, find_renamed
from swarmdsl.output.stale import report_stale
from swarmdsl.output.updating import update

_AS_IS = How()


def write(
    output: Mapping[str, Sequence[OutputFile]],
    out: Path,
    report: Diagnostics,
    how: How = _AS_IS,
) -> Written | None:
    """Bring the folder `out` up to date with the files of each target, or say what that would be.

    None when something stands in the way: it is reported and nothing is changed.
    """
    with opened(out, how, report) as plan:
        if plan is None:
            return None
        decide(plan, output)
        if report.has_errors:
            return None
        if how.check:
            report_stale(plan.written, plan.manifest != plan.before, plan.remarks, report)
            return plan.written
        if not how.dry:
            carry_out(plan)
        report.include(plan.remarks)
        return plan.written
    return None


def decide(plan: Plan, output: Mapping[str, Sequence[OutputFile]]) -> None:
    """Decide about all files of these targets, and about those that they have no more."""
    made = {f"{target}/{file.path}": file for target, files in output.items() for file in files}
    find_moves(plan, made)
    for path, file in made.items():
        try:
            update(plan, path, file)
        except OSError as error:
            report_os_error(plan.disk.out / path, error, plan.report)
    drop_stale(plan, output.keys())
    try:
        add_strays(plan, output.keys(), made)
    except OSError as error:
        report_os_error(plan.disk.out, error, plan.report)
    find_renamed(plan, made)
    gone = plan.written.paths(Action.REMOVE, Action.PARK)
    if gone and plan.before.model != plan.manifest.model and plan.before.model:
        warnings.report_other_model(plan.disk.out, plan.before.model, len(gone), plan.remarks)


__all__ = ["Action", "Change", "How", "Written", "write"]
