"""Write generated files, all or none, and never over edits of the user.

The files of target `t` go to the folder `t` of the output folder. A manifest lists the generated
files; all others, and those edited since, belong to the user.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from pathlib import Path

from swarmdsl.base.diagnostics.collector import Diagnostics
from swarmdsl.codegen.api import OutputFile
from swarmdsl.output import warnings
from swarmdsl.output.apply import apply_plan
from swarmdsl.output.changes import Action, Change, WriteOptions, Written
from swarmdsl.output.disk import report_os_error
from swarmdsl.output.plan import Plan
from swarmdsl.output.prepare import open_plan
from swarmdsl.output.removals import drop_stale
from swarmdsl.output.renames import find_moved_files, move_unlisted_files, report_possible_renames
from swarmdsl.output.stale import report_stale
from swarmdsl.output.updating import update

_DEFAULTS = WriteOptions()


def write(
    output: Mapping[str, Sequence[OutputFile]],
    out: Path,
    report: Diagnostics,
    options: WriteOptions = _DEFAULTS,
) -> Written | None:
    """Bring the folder `out` up to date with the files of each target.

    None if that is impossible: it is reported and nothing is changed. With `options.dry` or
    `options.check`, the result says what would change.
    """
    with open_plan(out, options, report) as plan:
        if plan is None:
            return None
        decide(plan, output)
        if report.has_errors:
            return None
        if options.check:
            report_stale(plan.written, plan.manifest != plan.before, plan.remarks, report)
            return plan.written
        if not options.dry:
            apply_plan(plan)
        report.include(plan.remarks)
        return plan.written
    return None


def decide(plan: Plan, output: Mapping[str, Sequence[OutputFile]]) -> None:
    """Plan the changes for all files of these targets, and for their stale files."""
    made = {f"{target}/{file.path}": file for target, files in output.items() for file in files}
    find_moved_files(plan, made)
    for path, file in made.items():
        try:
            update(plan, path, file)
        except OSError as error:
            report_os_error(plan.disk.out / path, error, plan.report)
    drop_stale(plan, output.keys())
    try:
        move_unlisted_files(plan, output.keys(), made)
    except OSError as error:
        report_os_error(plan.disk.out, error, plan.report)
    report_possible_renames(plan, made)
    gone = plan.written.paths(Action.REMOVE, Action.PARK)
    if gone and plan.before.model != plan.manifest.model and plan.before.model:
        warnings.report_other_model(plan.disk.out, plan.before.model, len(gone), plan.remarks)


__all__ = ["Action", "Change", "WriteOptions", "Written", "write"]
