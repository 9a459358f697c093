"""Rename an element and all references to it: `swarmc rename`."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Iterator, Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING

from swarmdsl.analysis.resolve.identities import robot_named
from swarmdsl.base.diagnostics.collector import Diagnostics, Label
from swarmdsl.base.read_files import MOST_DATA
from swarmdsl.base.records import dataclass
from swarmdsl.base.rewriting import Change, Layout
from swarmdsl.base.source import Source, Span
from swarmdsl.driver.config import find_file, find_settings
from swarmdsl.driver.edit_files import edited
from swarmdsl.driver.format_files import write
from swarmdsl.driver.workspace import Workspace
from swarmdsl.driver.workspace.references import owners
from swarmdsl.driver.workspace.renaming import RefusedError, replaced
from swarmdsl.driver.workspace.renaming import rename as places_of
from swarmdsl.driver.write_bounds import may_write_models
from swarmdsl.project.libraries import SUFFIX
from swarmdsl.project.read_source import read_source
from swarmdsl.project.rosidl import standard
from swarmdsl.project.search import found_below
from swarmdsl.syntax.ast import Role, Value, nodes_of
from swarmdsl.tools.refactor.names import NamedElement, all_elements, find_elements, suggest_path
from swarmdsl.tools.scaffold.names import command_line_span

if TYPE_CHECKING:
    from swarmdsl.ir import System

_MAX_SHOWN = 8


@dataclass(frozen=True)
class RenameResult:
    """Result of `rename`: the files that change and the number of replaced names."""

    report: Diagnostics
    files: int
    layouts: Sequence[Layout] = ()
    places: int = 0


def rename(paths: Sequence[Path], old: str, new: str, *, dry_run: bool = False) -> RenameResult:
    """Rename an element in the given files or in the project."""
    report = Diagnostics()
    settings = find_settings(paths, report)
    if report.has_errors:
        return RenameResult(report, 0)
    workspace = Workspace(paths or settings.sources, settings)
    if all(file.library for file in workspace.project.files):
        report.include(workspace.report)
        return RenameResult(report, workspace.files)
    found = _resolve(workspace, old, report)
    if found is None:
        return RenameResult(report, workspace.files)
    if new == found.path[-1]:
        reason, hint = "it has this name already", "choose another name"
        report.report("cannot-rename", found.name_span, what=str(found), reason=reason, help=hint)
        return RenameResult(report, workspace.files)
    namesakes = _namesakes(workspace, found)
    try:
        spans = places_of(workspace, found.file, found.name_span.start, new)
    except RefusedError as error:
        last = new.rpartition(".")[2]
        hint = f"give the unqualified name: `{last}`" if last != new else "choose another name"
        report.report("cannot-rename", found.name_span, what=str(found), reason=error, help=hint)
        return RenameResult(report, workspace.files)
    changes: dict[Path, list[Change]] = defaultdict(list)
    texts: dict[Path, str] = {}
    for source, start, end in (span.absolute for span in spans):
        assert source.path is not None  # sources of a workspace are files
        changes[source.path].append((start, end, new))
        texts[source.path] = source.text
    for test, made in _test_changes(
        workspace, paths, (found.path[-1], new), namesakes, replaced(spans, new), report
    ).items():
        assert test.path is not None  # it was read from a file
        changes[test.path], texts[test.path] = made, test.text
    _check_style(workspace, spans, new, report)
    if isinstance(found.node, Role):
        _check_strings(workspace, found.path[-1], spans, report)
    names = map(str, changes)
    layouts = edited(changes, texts, report) if may_write_models(names, paths, report) else None
    if layouts is None or not (dry_run or write(layouts, report)):
        return RenameResult(report, workspace.files)
    return RenameResult(report, workspace.files, layouts, sum(map(len, changes.values())))


def _resolve(workspace: Workspace, name: str, report: Diagnostics) -> NamedElement | None:
    found = find_elements(workspace, name)
    if len(found) == 1:
        return found[0]
    if found:
        related = tuple(Label(each.name_span, str(each)) for each in found[:_MAX_SHOWN])
        hint = f"qualify it, such as `{'.'.join(found[0].path)}`"
        if len({each.path for each in found}) == 1:
            hint = f"qualify it, such as `{found[0].file.package}.{'.'.join(found[0].path)}`"
        report.report(
            "unclear-name", command_line_span(name), name=name, related=related, help=hint
        )
        return None
    suggestion = suggest_path(workspace, name)
    if (unchangeable := _unchangeable(workspace, name)) is not None:
        hint = unchangeable
    elif suggestion is not None:
        hint = f"did you mean `{suggestion}`?"
    else:
        hint = "give its qualified name, such as `Uav.altitude`"
    report.report("no-such-thing", command_line_span(name), name=name, help=hint)
    return None


def _unchangeable(workspace: Workspace, name: str) -> str | None:
    """Return the hint for a name that a library or ROS declares."""
    found = find_elements(workspace, name, library=True)
    package, _, rest = name.partition("/")
    if found and found[0].file.source.name.endswith(SUFFIX):
        return "a library declares it, and libraries cannot be changed"
    if found or rest.partition(".")[0] in standard.names(package):
        return "ROS declares it, and its interfaces cannot be changed"
    return None


def _namesakes(workspace: Workspace, found: NamedElement) -> list[NamedElement]:
    """Other elements with the same name."""
    every = all_elements(workspace)
    return [
        each
        for each in every
        if each.path[-1] == found.path[-1] and each.name_span != found.name_span
    ]


def _check_style(workspace: Workspace, spans: list[Span], new: str, report: Diagnostics) -> None:
    """Report a new name that violates the naming style of its kind."""
    known = {each.message for each in workspace.report}
    with workspace.overriding(replaced(spans, new)):
        found = [each for each in workspace.report if each.name == "naming-style"]
    report.include(each for each in found if each.message not in known)


def _check_strings(
    workspace: Workspace, old: str, spans: Sequence[Span], report: Diagnostics
) -> None:
    """Report strings that are ids of a renamed role, but that may mean something else."""
    changed = {(span.source.path, span.start - 1) for span in spans}
    for file in workspace.project.files:
        for owner in owners(file) if not file.library else ():
            for text in nodes_of(owner, Value):
                source, start, _ = text.span.absolute
                named = isinstance(text.value, str) and robot_named(text.value)[0] == old
                if named and (source.path, start) not in changed:
                    hint = "change it too if it is the name of a robot or of the role"
                    report.report("still-named", text.span, name=old, help=hint)


def _test_changes(
    workspace: Workspace,
    paths: Sequence[Path],
    names: tuple[str, str],
    namesakes: Sequence[NamedElement],
    texts: Mapping[Path, str],
    report: Diagnostics,
) -> dict[Source, list[Change]]:
    """Return the changes from an old name to a new one in tests and scenarios of the project.

    Old names that remain are reported.
    """
    old, new = names
    sources = list(_toml_files_containing(paths, old, report))
    if not sources:
        return {}
    hint = "change it too if it refers to the renamed element"
    if namesakes:
        hint += f": {namesakes[0]} keeps this name"
    # Imported here because only a rename that affects tests needs these slow modules.
    from swarmdsl.lowering import lower
    from swarmdsl.tools.refactor.test_references import References, find_references, word_pattern

    systems: tuple[System, System] | None = None
    if not workspace.report.has_errors:
        before = lower(workspace.project)
        with workspace.overriding(texts):
            systems = before, lower(workspace.project)
    files = [file.source.path for file in workspace.project.files if file.source.path is not None]
    changes: dict[Source, list[Change]] = {}
    for source in sources:
        references = find_references(source, old, new, files, *systems) if systems else References()
        if references.changes:
            changes[source] = [*references.changes]
        changed = {start for start, _, _ in references.changes}
        for each in word_pattern(old).finditer(source.text):
            if each.start() not in changed and each.start() not in references.others:
                report.report("still-named", Span(source, *each.span()), name=old, help=hint)
    return changes


def _toml_files_containing(
    paths: Sequence[Path], name: str, report: Diagnostics
) -> Iterator[Source]:
    """Yield the TOML files beside the model that contain a name."""
    project = find_file(paths[0] if paths else Path())
    folders = [project.parent] if project is not None else [*paths] or [Path()]
    for folder in folders:
        for path in found_below(folder, ".toml", report) or ():
            source = (
                read_source(path, None, Diagnostics(), most=MOST_DATA)
                if path.name != "swarm.toml"
                else None
            )
            if source is not None and name in source.text:
                yield source
