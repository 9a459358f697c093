"""Places where a command may write: in the project, and where the command line says.

A project file, an import or a symbolic link must not lead it elsewhere, because they can come from
strangers.
"""

from __future__ import annotations

import os
from collections.abc import Iterable, Sequence
from pathlib import Path

from swarmdsl.base.diagnostics.collector import Diagnostics
from swarmdsl.base.read_files import is_folder
from swarmdsl.base.source import Span
from swarmdsl.driver.config import find_file
from swarmdsl.driver.config.settings import Settings


def may_write_output(settings: Settings, report: Diagnostics) -> bool:
    """Return True if the output folder of a project is in the project; report it otherwise."""
    hint = "give that folder on the command line, with `-o`"
    return _is_inside(settings.out, [settings.folder], settings.out_place, hint, report)


def may_write_models(
    names: Iterable[str], paths: Sequence[Path], report: Diagnostics, also: Sequence[Path] = ()
) -> bool:
    """Return True if model files are in the project, or in, beside or below a path given.

    The first of `paths` leads to the project; `also` are paths from other options. Report the first
    other file.
    """
    project = find_file(paths[0] if paths else Path())
    given = [*paths, *also]
    roots = [*given, *(path.parent for path in given if not is_folder(path))]
    roots += [project.parent] if project is not None else []
    if not paths:
        roots.append(Path())
    hint = "to change it too, name it on the command line"
    return all(_is_inside(Path(name), roots, None, hint, report) for name in names)


def _is_inside(
    place: Path, roots: Iterable[Path], at: Span | None, hint: str, report: Diagnostics
) -> bool:
    real = Path(os.path.realpath(place))
    if any(real.is_relative_to(os.path.realpath(root)) for root in roots):
        return True
    # With links, but without `..`.
    named = os.path.abspath(place)  # noqa: PTH100
    notes = () if named == str(real) else (f"it leads to `{real}`",)
    report.report("outside-project", at, path=place, notes=notes, help=hint)
    return False
