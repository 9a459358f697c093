"""Pipeline from .swarm files to packages on disk."""

from __future__ import annotations

from collections.abc import Sequence
from functools import cached_property
from pathlib import Path
from typing import TYPE_CHECKING

from swarmdsl.analysis.checks import validate
from swarmdsl.analysis.resolve.linker import link
from swarmdsl.base.diagnostics.collector import Diagnostics, placed
from swarmdsl.base.records import dataclass, replace
from swarmdsl.driver.config.settings import Settings
from swarmdsl.project.loader import Project, load

# Later phases are imported where they begin: `check` does not need them.
if TYPE_CHECKING:
    from swarmdsl.codegen.emit import Request
    from swarmdsl.ir import System
    from swarmdsl.output import WriteOptions, Written

_DEFAULTS = Settings()


@dataclass(frozen=True)
class Result:
    """Result of a run; `valid` is the project if its model has no errors.

    `name` is the configured name of the system.
    """

    report: Diagnostics
    files: int
    valid: Project | None = None
    name: str | None = None
    written: Written | None = None

    @cached_property
    def system(self) -> System | None:
        """The lowered model; None if it has errors."""
        from swarmdsl.lowering import lower

        return lower(self.valid, self.name) if self.valid is not None else None


def check(paths: Sequence[Path], settings: Settings = _DEFAULTS) -> Result:
    """Check a model and the files that it imports."""
    report = Diagnostics(settings.levels)
    project = load(paths, report, settings.libraries)
    project.models = frozenset(settings.models)
    if not paths:
        report.report("nothing-to-compile", path="[]")
    link(project, report)
    validate(project, report)
    if report.has_errors:
        return Result(report, project.size)
    return Result(report, project.size, project, settings.name)


def build(
    paths: Sequence[Path],
    requests: Sequence[Request],
    out: Path,
    settings: Settings = _DEFAULTS,
    options: WriteOptions | None = None,
) -> Result:
    """Check a model and write the output of the requested targets below `out`."""
    return generate(check(paths, settings), requests, out, options)


def generate(
    checked: Result, requests: Sequence[Request], out: Path, options: WriteOptions | None = None
) -> Result:
    """Write the output of the requested targets below `out` if the model is valid."""
    from swarmdsl.codegen.emit import emit
    from swarmdsl.output import WriteOptions, write

    if checked.system is None:
        return checked
    report, found = checked.report, Diagnostics()
    files = emit(checked.system, requests, found)
    # Spans in a workspace are relative to fragments of files.
    report.include(placed(one, lambda span: span.absolute) for one in found)
    if report.has_errors:
        return checked
    options = replace(options or WriteOptions(), model=checked.system.name)
    return replace(checked, written=write(files, out, report, options))
