"""Add elements to an existing model: `swarmc add`."""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Sequence
from pathlib import Path

from swarmdsl.analysis.node_kinds import kind_of
from swarmdsl.base.diagnostics.collector import Diagnostic, Diagnostics, Label, Level, Severity
from swarmdsl.base.read_files import read_file
from swarmdsl.base.records import dataclass, replace
from swarmdsl.base.rewriting import Change, Layout, rewritten
from swarmdsl.base.source import Source
from swarmdsl.driver.config import find_settings
from swarmdsl.driver.format_files import write
from swarmdsl.driver.workspace import Workspace
from swarmdsl.driver.write_bounds import may_write_models
from swarmdsl.project.loader import File
from swarmdsl.syntax.ast import (
    Declaration,
    Member,
    Parallel,
    Part,
    Role,
    State,
    StateMachine,
    Swarm,
    Transition,
    Vertex,
)
from swarmdsl.syntax.formatter import format_source
from swarmdsl.syntax.parse import parse
from swarmdsl.tools.refactor import insertion_point
from swarmdsl.tools.refactor.imports import importable_files, missing_import
from swarmdsl.tools.refactor.names import NamedElement, all_elements, find_elements, suggest_path
from swarmdsl.tools.scaffold.names import command_line_span

# One element names few others.
_MOST_IMPORTS = 10

Insertion = tuple[File, Change]
FindInsertion = Callable[[Workspace, Diagnostics], Insertion | None]
"""Finds the insertion of an element.

None if the element is not needed, or if it has no place, which is reported.
"""


@dataclass(frozen=True)
class AddResult:
    """Result of `add`: the files that change."""

    report: Diagnostics
    files: int
    layouts: Sequence[Layout] = ()


def add(
    paths: Sequence[Path],
    insertions: Sequence[FindInsertion],
    *,
    given_file: Path | None = None,
    dry_run: bool = False,
) -> AddResult:
    """Add elements one after the other to the given files or to the project.

    `given_file` is the one that the user names for them, which can be outside of the project.
    Nothing is written if an element has no place or causes an error.
    """
    report = Diagnostics()
    settings = find_settings(paths, report)
    if report.has_errors:
        return AddResult(report, 0)
    # An interface that is new and undescribed may be a typing error.
    levels = {"undescribed-interface": Level.WARN, **settings.levels}
    report = Diagnostics(levels)
    workspace = Workspace(paths or settings.sources, replace(settings, levels=levels))
    before = list(workspace.report)
    if not any(not file.library for file in workspace.project.files):
        report.include(before)
        return AddResult(report, workspace.files)
    contents: dict[Path, bytes] = {}
    for find_insertion in insertions:
        found = find_insertion(workspace, report)
        if report.has_errors:
            return AddResult(report, workspace.files)
        if found is not None:
            _insert(*found, workspace, contents)
    for _ in range(_MOST_IMPORTS):
        missing = missing_import(workspace, _new_diagnostics(before, workspace.report))
        if missing is None:
            break
        _insert(*missing, workspace, contents)
    report.include(_new_diagnostics(before, workspace.report))
    layouts = [Layout(str(path), read_file(path), text) for path, text in contents.items()]
    names, named = [layout.name for layout in layouts], [given_file] if given_file else []
    if report.has_errors or not may_write_models(names, paths, report, named):
        return AddResult(report, workspace.files)
    if not (dry_run or write(layouts, report)):
        return AddResult(report, workspace.files)
    return AddResult(report, workspace.files, layouts)


def _insert(file: File, change: Change, workspace: Workspace, contents: dict[Path, bytes]) -> None:
    """Apply a change to the workspace, and to the contents that are written."""
    path = Path(file.source.name)
    start, end, text = change = _align(file, change)
    layout = rewritten(str(path), contents.get(path, read_file(path)), [change])
    contents[path] = layout.after
    whole = file.source.text
    workspace.update({path: whole[:start] + text + whole[end:]})


def _align(file: File, change: Change) -> Change:
    """Align a change with the columns around it, unless other lines would change."""
    start, end, text = change
    before, after = file.source.text[:start], file.source.text[end:]
    text_after = format_source(Source(file.source.name, before + text + after), Diagnostics())
    if text_after is None or len(text_after) < len(before) + len(after):
        return change
    if text_after.startswith(before) and text_after.endswith(after):
        return start, end, text_after[len(before) : len(text_after) - len(after)]
    return change


def _new_diagnostics(before: Sequence[Diagnostic], after: Diagnostics) -> list[Diagnostic]:
    """List the diagnostics that were not reported before, regardless of location."""
    known = Counter((each.code, each.message) for each in before)
    found = []
    for each in after:
        known[each.code, each.message] -= 1
        if known[each.code, each.message] < 0:
            found.append(each)
    return found


def declaration(name: str, text: str, to: Path | None = None) -> FindInsertion:
    """Insert a declaration into file `to`, or into the file that fits best."""

    def find_insertion(workspace: Workspace, report: Diagnostics) -> Insertion | None:
        node = _parse_declaration(name, text, report)
        if node is None:
            return None
        files = [file for file in workspace.project.files if not file.library]
        file = (
            insertion_point.best_file(files, type(node))
            if to is None
            else _model_file(workspace, name, to, report)
        )
        if file is None:
            return None
        for other in workspace.project.files:
            for known in other.model.declarations:
                if known.name == name and other.package == file.package:
                    _report_taken(name, NamedElement(other, known, (name,)), report)
                    return None
        return file, insertion_point.declaration(file, type(node), text)

    return find_insertion


def machine_if_absent(
    name: str, text: str, user: type[Declaration], to: Path | None
) -> FindInsertion:
    """Insert a state machine unless some file declares the name.

    The file of a new declaration of kind `user`, which is `to` or the one that fits best, can
    import its file.
    """

    def find_insertion(workspace: Workspace, report: Diagnostics) -> Insertion | None:
        declared = any(
            known.name == name
            for file in workspace.project.files
            for known in file.model.declarations
        )
        if declared:
            return None
        files = [file for file in workspace.project.files if not file.library]
        home = _model_file(workspace, name, to, report) if to is not None else None
        home = home or insertion_point.best_file(files, user)
        file = insertion_point.best_file(importable_files(files, home), StateMachine)
        return declaration(name, text, Path(file.source.name))(workspace, report)

    return find_insertion


def part_of(owner: str, name: str, kind: type[Member] | type[Swarm], line: str) -> FindInsertion:
    """Insert a part of a member or a role of a swarm."""

    def find_insertion(workspace: Workspace, report: Diagnostics) -> Insertion | None:
        found = _container(workspace, name, owner, (kind,), report)
        if found is None:
            return None
        node = found.node
        assert isinstance(node, (Member, Swarm))
        items = [each for each in node.items if isinstance(each, (Part, Role))]
        taken = next((each for each in items if each.name == name), None)
        if taken is not None:
            _report_taken(name, NamedElement(found.file, taken, (owner, name)), report)
            return None
        return found.file, insertion_point.line_in(found.file, found.node, items, line)

    return find_insertion


def state(path: str, text: str) -> FindInsertion:
    """Insert a state into a machine, a state or a region."""
    owner, _, name = path.rpartition(".")

    def find_insertion(workspace: Workspace, report: Diagnostics) -> Insertion | None:
        found = _container(workspace, name, owner, insertion_point.CONTAINERS, report)
        if found is None:
            return None
        node = found.node
        assert isinstance(node, insertion_point.CONTAINERS)
        taken = next(
            (each for each in node.items if isinstance(each, Vertex) and each.name == name), None
        )
        if taken is not None:
            _report_taken(name, NamedElement(found.file, taken, (*found.path, name)), report)
            return None
        if "{" not in node.span.text:
            _report_no_braces(name, found, report)
            return None
        wrapped = f"statemachine M {{\n  initial {name}\n{text}\n}}"
        machine = _parse_declaration(name, wrapped, report)
        if not isinstance(machine, StateMachine):
            return None
        if len(machine.items) != 2:  # beside `initial`
            _report_several(name, text, report)
            return None
        return found.file, insertion_point.state(found.file, node, name, text)

    return find_insertion


def transition(source: str, text: str) -> FindInsertion:
    """Insert a transition below the others of a state."""

    def find_insertion(workspace: Workspace, report: Diagnostics) -> Insertion | None:
        found = _container(workspace, text, source, (State, Parallel), report)
        if found is None:
            return None
        node = found.node
        assert isinstance(node, (State, Parallel))
        if "{" not in node.span.text:
            _report_no_braces(text, found, report)
            return None
        others = [each for each in node.items if isinstance(each, Transition)]
        return found.file, insertion_point.line_in(found.file, node, others or node.items, text)

    return find_insertion


def _container(
    workspace: Workspace, name: str, owner: str, kinds: tuple[type, ...], report: Diagnostics
) -> NamedElement | None:
    every = find_elements(workspace, owner)
    found = [each for each in every if isinstance(each.node, kinds)]
    if len(found) == 1:
        return found[0]
    if found:
        related = tuple(Label(each.name_span, str(each)) for each in found)
        hint = f"qualify it, such as `{'.'.join(found[0].path)}`"
        report.report(
            "unclear-name", command_line_span(owner), name=owner, related=related, help=hint
        )
    elif every:
        reason = f"{kind_of(every[0].node)} cannot contain it"
        hint = f"name {_alternatives(workspace, kinds)}"
        report.report("cannot-add", every[0].name_span, what=f"`{name}`", reason=reason, help=hint)
    else:
        suggestion = suggest_path(workspace, owner, kinds)
        hint = (
            f"did you mean `{suggestion}`?"
            if suggestion
            else f"name {_alternatives(workspace, kinds)}"
        )
        report.report("no-such-thing", command_line_span(owner), name=owner, help=hint)
    return None


def _alternatives(workspace: Workspace, kinds: tuple[type, ...]) -> str:
    names = [str(each) for each in all_elements(workspace) if isinstance(each.node, kinds)]
    return f"an existing one, such as {names[0]}" if names else "an existing one: there is none yet"


def _parse_declaration(name: str, text: str, report: Diagnostics) -> Declaration | None:
    """Parse a text with exactly one declaration; otherwise report it and return None."""
    found = Diagnostics()
    model = parse(Source("<command line>", text), found).model
    if found.has_errors:
        report.include(each for each in found if each.severity is Severity.ERROR)
        return None
    declared = [*model.declarations, *model.optimizations]
    if len(declared) != 1 or declared[0] is not model.declarations[0] or model.imports:
        _report_several(name, text, report)
        return None
    return model.declarations[0]


def _report_several(name: str, text: str, report: Diagnostics) -> None:
    hint = "add one element at a time"
    reason = "it is more than one element"
    report.report("cannot-add", command_line_span(text), what=f"`{name}`", reason=reason, help=hint)


def _report_no_braces(name: str, found: NamedElement, report: Diagnostics) -> None:
    reason, hint = f"{found} has no braces", f"add them: `{found.node.span.text} {{ }}`"
    report.report("cannot-add", found.name_span, what=f"`{name}`", reason=reason, help=hint)


def _model_file(workspace: Workspace, name: str, path: Path, report: Diagnostics) -> File | None:
    file = workspace.file(path)
    if file is None or file.library:
        names = [each.source.name for each in workspace.project.files if not each.library]
        hint = f"use `{names[0]}`" + (" or another of its files" if len(names) > 1 else "")
        reason = f"`{path.as_posix()}` is not a file of the model"
        report.report(
            "cannot-add",
            command_line_span(path.as_posix()),
            what=f"`{name}`",
            reason=reason,
            help=hint,
        )
        return None
    return file


def _report_taken(name: str, known: NamedElement, report: Diagnostics) -> None:
    related = (Label(known.name_span, "declared here"),)
    hint = "choose another name, or edit the existing element"
    reason = "the name is already declared"
    report.report(
        "cannot-add",
        command_line_span(name),
        what=f"`{name}`",
        reason=reason,
        related=related,
        help=hint,
    )
