"""`swarmc rename`: another name for something, wherever it is named."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Iterator, Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING

from swarmdsl.base.diagnostics.collector import Diagnostics, Label
from swarmdsl.base.find_files import files_below
from swarmdsl.base.records import dataclass
from swarmdsl.base.rewriting import Change, Layout, rewritten
from swarmdsl.base.source import Source, Span
from swarmdsl.driver.config import find_file, find_settings
from swarmdsl.driver.format_files import write
from swarmdsl.driver.workspace import Workspace
from swarmdsl.driver.workspace.renaming import RefusedError, replaced
from swarmdsl.driver.workspace.renaming import rename as places_of
from swarmdsl.project.read_source import read_source
from swarmdsl.tools.refactor.names import Named, all_named, find, similar
from swarmdsl.tools.scaffold.names import given

if TYPE_CHECKING:
    from swarmdsl.ir import System

_MOST_SHOWN = 8


@dataclass(frozen=True)
class Renamed:
    """What came of it: the files that change, and in how many places."""

    report: Diagnostics
    files: int
    layouts: Sequence[Layout] = ()
    places: int = 0


def rename(paths: Sequence[Path], old: str, new: str, *, dry_run: bool = False) -> Renamed:
    """Call something otherwise in the model of these files, or that of the project."""
    report = Diagnostics()
    settings = find_settings(paths, report)
    if report.has_errors:
        return Renamed(report, 0)
    workspace = Workspace(paths or settings.sources, settings)
    if all(file.library for file in workspace.project.files):
        report.include(workspace.report)
        return Renamed(report, workspace.files)
    found = _found(workspace, old, report)
    if found is None:
        return Renamed(report, workspace.files)
    namesakes = _namesakes(workspace, found)
    try:
        spans = places_of(workspace, found.file, found.place.start, new)
    except RefusedError as error:
        last = new.rpartition(".")[2]
        way = f"give the new name alone: `{last}`" if last != new else "choose another name"
        report.report("cannot-rename", found.place, what=str(found), reason=error, help=way)
        return Renamed(report, workspace.files)
    changes: dict[Path, list[Change]] = defaultdict(list)
    for source, start, end in (span.absolute for span in spans):
        assert source.path is not None  # what has been read from a file
        changes[source.path].append((start, end, new))
    changes |= _in_tests(
        workspace, paths, (found.path[-1], new), namesakes, replaced(spans, new), report
    )
    layouts = [rewritten(str(path), path.read_bytes(), made) for path, made in changes.items()]
    _check_style(workspace, spans, new, report)
    if not dry_run and not write(layouts, report):
        return Renamed(report, workspace.files)
    return Renamed(report, workspace.files, layouts, sum(map(len, changes.values())))


def _found(workspace: Workspace, name: str, report: Diagnostics) -> Named | None:
    found = find(workspace, name)
    if len(found) == 1:
        return found[0]
    if found:
        related = tuple(Label(each.place, str(each)) for each in found[:_MOST_SHOWN])
        way = f"say which, such as `{'.'.join(found[0].path)}`"
        if len({each.path for each in found}) == 1:
            way = f"say which, such as `{found[0].file.package}.{'.'.join(found[0].path)}`"
        report.report("unclear-name", given(name), name=name, related=related, help=way)
        return None
    close = similar(workspace, name)
    if any(".".join(each.path) == name for each in all_named(workspace, library=True)):
        way = "a library does, which keeps its names"
    else:
        way = f"did you mean `{close}`?" if close else "give its path, such as `Uav.altitude`"
    report.report("no-such-thing", given(name), name=name, help=way)
    return None


def _namesakes(workspace: Workspace, found: Named) -> list[Named]:
    """What else has the same name, and keeps it."""
    every = all_named(workspace)
    return [each for each in every if each.path[-1] == found.path[-1] and each.place != found.place]


def _check_style(workspace: Workspace, spans: list[Span], new: str, report: Diagnostics) -> None:
    """Report a new name that is not written as others of its kind."""
    known = {each.message for each in workspace.report}
    with workspace.supposing(replaced(spans, new)):
        found = [each for each in workspace.report if each.name == "naming-style"]
    report.include(each for each in found if each.message not in known)


def _in_tests(
    workspace: Workspace,
    paths: Sequence[Path],
    names: tuple[str, str],
    namesakes: Sequence[Named],
    texts: Mapping[Path, str],
    report: Diagnostics,
) -> dict[Path, list[Change]]:
    """The changes from an old name to a new one in tests and scenarios of the project.

    What has the old one still is told.
    """
    old, new = names
    sources = list(_naming(paths, old))
    if not sources:
        return {}
    way = "change it there too, if it means what is called otherwise now"
    if namesakes:
        way += f": {namesakes[0]} keeps this name"
    # Checking these takes modules that a change of the model alone does not need.
    from swarmdsl.lowering import lower
    from swarmdsl.tools.refactor.test_references import Mentions, mentions, word

    systems: tuple[System, System] | None = None
    if not workspace.report.has_errors:
        before = lower(workspace.project)
        with workspace.supposing(texts):
            systems = before, lower(workspace.project)
    files = [file.source.path for file in workspace.project.files if file.source.path is not None]
    changes: dict[Path, list[Change]] = {}
    for path, source in sources:
        there = mentions(source, old, new, files, *systems) if systems else Mentions()
        if there.changes:
            changes[path] = [*there.changes]
        changed = {start for start, _, _ in there.changes}
        for each in word(old).finditer(source.text):
            if each.start() not in changed and each.start() not in there.others:
                report.report("still-named", Span(source, *each.span()), name=old, help=way)
    return changes


def _naming(paths: Sequence[Path], name: str) -> Iterator[tuple[Path, Source]]:
    """The files of TOML beside the model that have a name somewhere."""
    project = find_file(paths[0] if paths else Path())
    folders = [project.parent] if project is not None else [*paths] or [Path()]
    for folder in folders:
        for path in files_below(folder, ".toml"):
            source = read_source(path, None, Diagnostics()) if path.name != "swarm.toml" else None
            if source is not None and name in source.text:
                yield path, source
