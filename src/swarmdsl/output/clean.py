"""Remove generated files that the user has not edited."""

from __future__ import annotations

from collections.abc import Collection
from pathlib import Path

from swarmdsl.base.diagnostics.collector import Diagnostics
from swarmdsl.base.suggest import suggest
from swarmdsl.codegen import registry
from swarmdsl.output import manifest, texts
from swarmdsl.output.apply import apply_plan
from swarmdsl.output.changes import WriteOptions, Written
from swarmdsl.output.prepare import open_plan
from swarmdsl.output.removals import remove_generated


def clean(out: Path, targets: Collection[str], report: Diagnostics, *, dry: bool) -> Written | None:
    """Remove the generated files of a folder; with `dry`, only return the changes.

    `targets` limits the removal; empty stands for all targets. Edited files stay in place and are
    known to the next build. Unreadable files stay and are reported. None if nothing can be done.
    """
    with open_plan(out, WriteOptions(dry=dry), report) as plan:
        if plan is None:
            return None
        there = {path.partition("/")[0] for path in plan.before.files}
        for target in sorted(set(targets) - there - set(registry.target_names())):
            hint = suggest(target, there, "targets")
            report.report("unknown-target", name=target, help=hint)
        remove_generated(plan, targets or there)
        if not dry:
            apply_plan(plan)
            if not (plan.manifest.files or plan.manifest.parked):
                for name in (manifest.NAME, texts.NAME):
                    (out / name).unlink(missing_ok=True)
        return plan.written
    return None
