"""Write a candidate into the text of a model: values of params, and numbers of members.

A value replaces the one that the role gives, else the default of the param if no other role has
it, else it becomes a value of the role. A number becomes the least of the multiplicity, which is
what a simulation takes.
"""

from __future__ import annotations

import json
from collections import defaultdict
from collections.abc import Iterator, Sequence
from pathlib import Path

from swarmdsl.base.diagnostics.collector import Diagnostics
from swarmdsl.base.rewriting import Change, Layout
from swarmdsl.base.source import Span
from swarmdsl.driver.config import find_settings
from swarmdsl.driver.edit_files import edited
from swarmdsl.driver.format_files import write
from swarmdsl.driver.workspace import Workspace
from swarmdsl.driver.write_bounds import may_write_models
from swarmdsl.execution.experiments.failures import StoppedError
from swarmdsl.execution.experiments.task import COUNT, Candidate
from swarmdsl.project.loader import Project
from swarmdsl.syntax.ast import Member, Param, ParamRange, RobotValues, Role, Swarm
from swarmdsl.syntax.types import unit_name

Edit = tuple[Span, str]
"""A place in a text, and what comes there."""


def apply_to_model(
    paths: Sequence[Path], swarm: str, candidate: Candidate, report: Diagnostics
) -> list[Layout]:
    """Write a candidate into the files of a model; return the files that change.

    Raises StoppedError for a setting that has no place in the text. A change that would cause an
    error is refused.
    """
    settings = find_settings(paths, report)
    workspace = Workspace(paths or settings.sources, settings)
    edits = list(_edits(workspace.project, swarm, candidate))
    changes: dict[Path, list[Change]] = defaultdict(list)
    texts: dict[Path, str] = {}
    for span, text in edits:
        source, start, end = span.absolute
        assert source.path is not None
        changes[source.path].append((start, end, text))
        texts[source.path] = source.text
    after = {path: _changed(texts[path], made) for path, made in changes.items()}
    with workspace.overriding(after):
        for each in workspace.report:
            if each.severity.value == "error":
                raise StoppedError("cannot-apply", None, name=swarm, reason=each.message)
    names = map(str, changes)
    layouts = edited(changes, texts, report) if may_write_models(names, paths, report) else None
    if layouts is None or not write(layouts, report):
        return []
    return [layout for layout in layouts if layout.changed]


def _changed(text: str, changes: Sequence[Change]) -> str:
    for start, end, new in sorted(changes, reverse=True):
        text = text[:start] + new + text[end:]
    return text


def _edits(project: Project, swarm: str, candidate: Candidate) -> Iterator[Edit]:
    """Yield the edits, those of one role together."""
    found = next(
        each
        for _, each in project.declarations()
        if isinstance(each, Swarm) and str(each.name) == swarm.rpartition(".")[2]
    )
    roles = {str(item.name): item for item in found.items if isinstance(item, Role)}
    units = dict(_units(project, found))
    added: dict[str, list[str]] = defaultdict(list)
    for name, value in candidate.settings:
        if name.startswith(COUNT):
            yield _count(roles[name.removeprefix(COUNT)], int(value))
            continue
        word, _, param = name.rpartition(".")
        text = _written(value, units.get((word, param)))
        edit = _value(project, found, roles[word], param, text)
        if edit is None:
            added[word].append(f"{param} = {text}")
        else:
            yield edit
    for word, values in added.items():
        yield _insertion(roles[word], values)


def _count(role: Role, count: int) -> Edit:
    multiplicity = role.multiplicity
    assert multiplicity is not None  # a role without one has one member, and cannot vary
    upper = multiplicity.upper
    is_same = upper == str(count) or multiplicity.span.text.strip() == multiplicity.lower != "*"
    return multiplicity.span, str(count) if is_same else f"{count}..{upper}"


def _value(project: Project, swarm: Swarm, role: Role, param: str, text: str) -> Edit | None:
    """Return the edit of a value that stands somewhere; None if it must be added to the role."""
    for item in swarm.items:
        if not isinstance(item, RobotValues) or item.role.target is not role:
            continue
        if any(str(each.name) == param for each in item.values):
            help_ = f"remove `{param}` there, so that all members of the role have the same"
            reason = f"`{role.name}[{item.index}]` has a value of its own for `{param}`"
            raise StoppedError("cannot-apply", help_, name=str(swarm.name), reason=reason)
    for given in role.values:
        if str(given.name) == param:
            return given.value.span, text
    member = role.member.target
    declared = _declared(member, param) if member is not None else None
    users = [
        item
        for _, each in project.declarations()
        if isinstance(each, Swarm)
        for item in each.items
        if isinstance(item, Role) and item.member.target is member
    ]
    is_ours = declared is not None and any(
        member in file.model.declarations and not file.library for file in project.files
    )
    if declared is None or declared.default is None or len(users) != 1 or not is_ours:
        return None
    return declared.default.span, text


def _declared(member: Member, param: str) -> Param | None:
    """Return the param if the member declares it itself, and not one that it inherits."""
    own = (item for item in member.items if isinstance(item, Param))
    return next((item for item in own if str(item.name) == param), None)


def _insertion(role: Role, values: Sequence[str]) -> Edit:
    text = ", ".join(values)
    if role.values:
        end = role.values[-1].value.span
        return Span(end.source, end.end, end.end), f", {text}"
    whole = role.span
    end_of = whole.start + len(whole.text.rstrip())
    return Span(whole.source, end_of, end_of), f" {{ {text} }}"


def _units(project: Project, swarm: Swarm) -> Iterator[tuple[tuple[str, str], str]]:
    """Yield the units of the params that vary, by role and param."""
    for _, optimization in project.optimizations():
        for item in optimization.items if optimization.swarm.target is swarm else ():
            param = item.param.target if isinstance(item, ParamRange) else None
            unit = unit_name(param.type.type) if param is not None else None
            if isinstance(item, ParamRange) and unit is not None:
                yield (str(item.role.name), str(item.param.name)), unit


def _written(value: object, unit: str | None) -> str:
    """Return a value in the language: `2.5`, `8 m`, `90 s`."""
    if isinstance(value, str):
        number = value.rstrip("abcdefghijklmnopqrstuvwxyz")
        return f"{number} {value[len(number) :]}"
    return json.dumps(value) if unit is None else f"{json.dumps(value)} {unit}"
