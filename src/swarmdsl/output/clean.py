"""Removes what was generated, and nothing that the user has written in."""

from __future__ import annotations

from collections.abc import Collection
from pathlib import Path

from swarmdsl.base.diagnostics.collector import Diagnostics
from swarmdsl.base.suggest import suggest
from swarmdsl.codegen import registry
from swarmdsl.output import manifest, texts
from swarmdsl.output.apply import carry_out
from swarmdsl.output.changes import How, Written
from swarmdsl.output.prepare import opened
from swarmdsl.output.removals import remove_generated


def clean(out: Path, targets: Collection[str], report: Diagnostics, *, dry: bool) -> Written | None:
    """Remove from a folder what was generated, or say what that would be.

    `targets` are those whose files go; all where none is named.

    What the user has written in stays in its place, and is known for the next build. What cannot
    be read stays too, and is reported. None when nothing at all can be done.
    """
    with opened(out, How(dry=dry), report) as plan:
        if plan is None:
            return None
        there = {path.partition("/")[0] for path in plan.before.files}
        for target in sorted(set(targets) - there - set(registry.target_names())):
            hint = suggest(target, there, "targets")
            report.report("unknown-target", name=target, help=hint)
        remove_generated(plan, targets or there)
        if not dry:
            carry_out(plan)
            if not (plan.manifest.files or plan.manifest.parked):
                for name in (manifest.NAME, texts.NAME):
                    (out / name).unlink(missing_ok=True)
        return plan.written
    return None
