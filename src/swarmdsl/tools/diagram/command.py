"""Draw diagrams to files or standard output: `swarmc diagram`."""

from __future__ import annotations

import os
from collections.abc import Sequence
from pathlib import Path

from swarmdsl.base.atomic_write import Staging
from swarmdsl.base.diagnostics.collector import Diagnostics, listed
from swarmdsl.base.read_files import exists, is_folder
from swarmdsl.base.records import dataclass
from swarmdsl.base.source import COMMAND_LINE, Source, Span
from swarmdsl.base.suggest import suggest
from swarmdsl.codegen.diagram.graph import KINDS, Diagram
from swarmdsl.driver import pipeline
from swarmdsl.driver.config import find_settings
from swarmdsl.tools.diagram.formats import FORMATS, SUFFIXES
from swarmdsl.tools.diagram.map import Map, maps
from swarmdsl.tools.diagram.views import diagrams

_MAX_NAMED = 12
_MAPS = "a map shows the areas, zones, walls, obstacles and targets of an environment"


@dataclass(frozen=True)
class DrawResult:
    """Result of a run: `text` for standard output, or the files `written`."""

    report: Diagnostics
    files: int
    text: str | None = None
    written: Sequence[Path] = ()


def draw(
    paths: tuple[Path, ...], kind: str, names: Sequence[str], format_: str, out: Path | None
) -> DrawResult:
    """Draw the selected diagrams of the model in the given files.

    `kind` is one of `KINDS`, `map` or `all`; `names` select diagrams, by default all. Several
    diagrams go to a folder; a single one goes to file `out` or to standard output.
    """
    report = Diagnostics()
    settings = find_settings(paths, report)
    if report.has_errors:
        return DrawResult(report, 1)
    checked = pipeline.check(paths or settings.sources, settings)
    report.include(checked.report)
    if checked.system is None:
        return DrawResult(report, checked.files)
    kinds = KINDS if kind == "all" else tuple(each for each in KINDS if each == kind)
    every: list[Diagram | Map] = [*diagrams(checked.system, kinds)]
    if kind == "map" or (kind == "all" and format_ == "svg"):
        every += maps(checked.system)
    chosen = _select(every, names, report)
    if not every:
        what = "any diagram" if kind == "all" else f"{kind} diagrams"
        report.report("nothing-to-draw", what=what, help=_MAPS if kind == "map" else None)
    elif kind == "map" and format_ != "svg":
        report.report(
            "nothing-to-draw",
            what=f"format `{format_}`",
            help="maps are drawn as SVG only: leave `--format` out",
        )
    if report.has_errors:
        return DrawResult(report, checked.files)
    suffix = SUFFIXES[format_]
    to_file = out is not None and not is_folder(out) and (out.suffix == suffix or exists(out))
    if len(chosen) > 1 and (out is None or to_file):
        where = f"file `{out}`" if out is not None else "standard output"
        help_ = _selection_hint(chosen)
        report.report("unclear-diagram", count=len(chosen), where=where, help=help_)
        return DrawResult(report, checked.files)
    if out is None:
        return DrawResult(report, checked.files, _text(chosen[0], format_))
    inside = is_folder(out) or len(chosen) > 1 or (not out.suffix and not exists(out))
    texts = {
        out / f"{each.stem}{suffix}" if inside else out: _text(each, format_).encode()
        for each in chosen
    }
    return DrawResult(report, checked.files, written=_write(texts, report))


def _text(drawn: Diagram | Map, format_: str) -> str:
    return drawn.svg() if isinstance(drawn, Map) else FORMATS[format_](drawn)


def _select(
    every: Sequence[Diagram | Map], names: Sequence[str], report: Diagnostics
) -> list[Diagram | Map]:
    """Diagrams with the given names, by default all."""
    known = {each.name for each in every}
    for name in names:
        if name not in known and known:
            source = Source(COMMAND_LINE, f"--name {name}")
            place = Span(source, len(source.text) - len(name), len(source.text))
            help_ = suggest(name, sorted(known), "diagrams")
            report.report("unresolved-name", place, kind="diagram", name=name, help=help_)
    return [each for each in every if not names or each.name in names]


def _selection_hint(chosen: Sequence[Diagram | Map]) -> str:
    names = list(dict.fromkeys(f"--name {each.name}" for each in chosen))
    return f"give a folder with `-o`, or select one: {listed(names[:_MAX_NAMED])}"


def _write(texts: dict[Path, bytes], report: Diagnostics) -> list[Path]:
    """Write all files, or none if one cannot be written."""
    try:
        with Staging() as staging:
            for path, content in texts.items():
                # Keep a symbolic link and replace its target.
                staging.add(Path(os.path.realpath(path)), content)
            for _ in staging.move_in_place():
                pass
    except OSError as error:
        reason = error.strerror or str(error)
        path = error.filename or next(iter(texts))
        report.report("cannot-write", path=path, reason=reason[:1].lower() + reason[1:])
        return []
    return list(texts)
