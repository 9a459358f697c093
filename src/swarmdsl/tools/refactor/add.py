"""`swarmc add`: something new in a model that exists."""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Sequence
from pathlib import Path

from swarmdsl.analysis.node_kinds import kind_of
from swarmdsl.base.diagnostics.collector import Diagnostic, Diagnostics, Label, Level, Severity
from swarmdsl.base.records import dataclass, replace
from swarmdsl.base.rewriting import Change, Layout, rewritten
from swarmdsl.base.source import Source
from swarmdsl.driver.config import find_settings
from swarmdsl.driver.format_files import write
from swarmdsl.driver.workspace import Workspace
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
from swarmdsl.syntax.formatter import formatted
from swarmdsl.syntax.parse import parse
from swarmdsl.tools.refactor import insertion_point
from swarmdsl.tools.refactor.names import Named, all_named, find, similar
from swarmdsl.tools.scaffold.names import given

Found = tuple[File, Change]
Place = Callable[[Workspace, Diagnostics], Found | None]
"""Where something goes in a model, if it needs to; None where it needs not, or has no place,
which is reported."""


@dataclass(frozen=True)
class Added:
    """What came of it: the files that change."""

    report: Diagnostics
    files: int
    layouts: Sequence[Layout] = ()


def add(paths: Sequence[Path], places: Sequence[Place], *, dry_run: bool = False) -> Added:
    """Put things into the model of these files, or that of the project, one after the other.

    Nothing is written where one of them has no place or makes a mistake.
    """
    report = Diagnostics()
    settings = find_settings(paths, report)
    if report.has_errors:
        return Added(report, 0)
    # What is new may be a slip that nobody else would see.
    levels = {"undescribed-interface": Level.WARN, **settings.levels}
    report = Diagnostics(levels)
    workspace = Workspace(paths or settings.sources, replace(settings, levels=levels))
    before = list(workspace.report)
    if not any(not file.library for file in workspace.project.files):
        report.include(before)
        return Added(report, workspace.files)
    contents: dict[Path, bytes] = {}
    for place in places:
        found = place(workspace, report)
        if report.has_errors:
            return Added(report, workspace.files)
        if found is None:
            continue
        file, change = found
        path = Path(file.source.name)
        start, end, text = change = _fitted(file, change)
        layout = rewritten(str(path), contents.get(path, path.read_bytes()), [change])
        contents[path] = layout.after
        whole = file.source.text
        workspace.update({path: whole[:start] + text + whole[end:]})
    report.include(_new(before, workspace.report))
    layouts = [Layout(str(path), path.read_bytes(), text) for path, text in contents.items()]
    if report.has_errors or not (dry_run or write(layouts, report)):
        return Added(report, workspace.files)
    return Added(report, workspace.files, layouts)


def _fitted(file: File, change: Change) -> Change:
    """A change with the columns of what is around it, where that has to change nowhere else."""
    start, end, text = change
    before, after = file.source.text[:start], file.source.text[end:]
    made = formatted(Source(file.source.name, before + text + after), Diagnostics())
    if made is None or len(made) < len(before) + len(after):
        return change
    if made.startswith(before) and made.endswith(after):
        return start, end, made[len(before) : len(made) - len(after)]
    return change


def _new(before: Sequence[Diagnostic], after: Diagnostics) -> list[Diagnostic]:
    """What is reported now and was not before, wherever it stood."""
    known = Counter((each.code, each.message) for each in before)
    found = []
    for each in after:
        known[each.code, each.message] -= 1
        if known[each.code, each.message] < 0:
            found.append(each)
    return found


def declaration(name: str, text: str, to: Path | None = None) -> Place:
    """A declaration, in a file or in the one where it fits best."""

    def place(workspace: Workspace, report: Diagnostics) -> Found | None:
        node = _parsed(name, text, report)
        if node is None:
            return None
        files = [file for file in workspace.project.files if not file.library]
        file = (
            insertion_point.best_file(files, type(node))
            if to is None
            else _file(workspace, name, to, report)
        )
        if file is None:
            return None
        for other in workspace.project.files:
            for known in other.model.declarations:
                if known.name == name and other.package == file.package:
                    _report_taken(name, Named(other, known, (name,)), report)
                    return None
        return file, insertion_point.declaration(file, type(node), text)

    return place


def unless_there(name: str, text: str) -> Place:
    """A declaration that is only needed where no file declares something of this name."""
    made = declaration(name, text)

    def place(workspace: Workspace, report: Diagnostics) -> Found | None:
        there = any(
            known.name == name
            for file in workspace.project.files
            for known in file.model.declarations
        )
        return None if there else made(workspace, report)

    return place


def part_of(owner: str, name: str, kind: type[Member] | type[Swarm], line: str) -> Place:
    """A part of a member, or a role of a swarm."""

    def place(workspace: Workspace, report: Diagnostics) -> Found | None:
        found = _container(workspace, name, owner, (kind,), report)
        if found is None:
            return None
        node = found.node
        assert isinstance(node, (Member, Swarm))
        items = [each for each in node.items if isinstance(each, (Part, Role))]
        taken = next((each for each in items if each.name == name), None)
        if taken is not None:
            _report_taken(name, Named(found.file, taken, (owner, name)), report)
            return None
        return found.file, insertion_point.line_in(found.file, found.node, items, line)

    return place


def state(path: str, text: str) -> Place:
    """A state of a machine, of a state or of a region."""
    owner, _, name = path.rpartition(".")

    def place(workspace: Workspace, report: Diagnostics) -> Found | None:
        found = _container(workspace, name, owner, insertion_point.CONTAINERS, report)
        if found is None:
            return None
        node = found.node
        assert isinstance(node, insertion_point.CONTAINERS)
        taken = next(
            (each for each in node.items if isinstance(each, Vertex) and each.name == name), None
        )
        if taken is not None:
            _report_taken(name, Named(found.file, taken, (*found.path, name)), report)
            return None
        if "{" not in node.span.text:
            _report_no_braces(name, found, report)
            return None
        wrapped = f"statemachine M {{\n  initial {name}\n{text}\n}}"
        machine = _parsed(name, wrapped, report)
        if not isinstance(machine, StateMachine):
            return None
        if len(machine.items) != 2:  # beside `initial`
            _report_several(name, text, report)
            return None
        return found.file, insertion_point.state(found.file, node, name, text)

    return place


def transition(source: str, text: str) -> Place:
    """A transition below the others of a state."""

    def place(workspace: Workspace, report: Diagnostics) -> Found | None:
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

    return place


def _container(
    workspace: Workspace, name: str, owner: str, kinds: tuple[type, ...], report: Diagnostics
) -> Named | None:
    every = find(workspace, owner)
    found = [each for each in every if isinstance(each.node, kinds)]
    if len(found) == 1:
        return found[0]
    if found:
        related = tuple(Label(each.place, str(each)) for each in found)
        way = f"say which, such as `{'.'.join(found[0].path)}`"
        report.report("unclear-name", given(owner), name=owner, related=related, help=way)
    elif every:
        reason = f"nothing of its kind goes into {kind_of(every[0].node)}"
        way = f"name {_alternatives(workspace, kinds)}"
        report.report("cannot-add", every[0].place, what=f"`{name}`", reason=reason, help=way)
    else:
        close = similar(workspace, owner, kinds)
        way = f"did you mean `{close}`?" if close else f"name {_alternatives(workspace, kinds)}"
        report.report("no-such-thing", given(owner), name=owner, help=way)
    return None


def _alternatives(workspace: Workspace, kinds: tuple[type, ...]) -> str:
    names = [str(each) for each in all_named(workspace) if isinstance(each.node, kinds)]
    return f"{names[0]}, for instance" if names else "something that the model has: it has none"


def _parsed(name: str, text: str, report: Diagnostics) -> Declaration | None:
    """The one declaration in a text; None where it has mistakes, or is more, which is reported."""
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
    way = "add one thing at a time"
    reason = "it is more than one thing"
    report.report("cannot-add", given(text), what=f"`{name}`", reason=reason, help=way)


def _report_no_braces(name: str, found: Named, report: Diagnostics) -> None:
    reason, way = f"{found} has no braces", f"write them: `{found.node.span.text} {{ }}`"
    report.report("cannot-add", found.place, what=f"`{name}`", reason=reason, help=way)


def _file(workspace: Workspace, name: str, path: Path, report: Diagnostics) -> File | None:
    file = workspace.file(path)
    if file is None or file.library:
        names = [each.source.name for each in workspace.project.files if not each.library]
        way = f"it has `{names[0]}`" + (" and others" if len(names) > 1 else "")
        reason = f"`{path.as_posix()}` is no file of the model"
        report.report(
            "cannot-add", given(path.as_posix()), what=f"`{name}`", reason=reason, help=way
        )
        return None
    return file


def _report_taken(name: str, known: Named, report: Diagnostics) -> None:
    related = (Label(known.place, "declared here"),)
    way = "choose another name, or change what is there"
    reason = "there is something of this name already"
    report.report(
        "cannot-add", given(name), what=f"`{name}`", reason=reason, related=related, help=way
    )
