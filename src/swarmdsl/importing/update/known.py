"""A model as it is before an update: which declarations it has, and in which files."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from pathlib import Path

from swarmdsl.analysis.resolve.linker import link
from swarmdsl.analysis.resolve.type_names import interface_name
from swarmdsl.base.diagnostics.collector import Diagnostics
from swarmdsl.base.records import dataclass, field
from swarmdsl.base.source import Source, Span
from swarmdsl.project.loader import File, Project, Reader, load, parsed_model
from swarmdsl.syntax.ast import (
    ActionType,
    AliasType,
    Component,
    Declaration,
    EnumType,
    Event,
    Function,
    MessageType,
    ServiceType,
    StateMachine,
    StructType,
)

Key = tuple[str, str]
"""What a declaration is found by: its group and its name."""

# In the order in which they usually stand in a file.
_GROUPS: Mapping[str, tuple[type, ...]] = {
    "interface": (MessageType, ServiceType, ActionType, StructType, EnumType, AliasType),
    "event": (Event,),
    "function": (Function,),
    "component": (Component,),
    "machine": (StateMachine,),
}


class _Texts(Reader):
    """Reads files, some of them from texts that are not on disk."""

    def __init__(self, texts: Mapping[str, str]) -> None:
        self._texts = texts

    def model(self, path: Path, at: Span | None, report: Diagnostics) -> File | None:
        text = self._texts.get(str(path))
        if text is None:
            return super().model(path, at, report)
        return parsed_model(Source(str(path), text, path), report)


@dataclass(eq=False)
class Model:
    """The files of a model, those that it imports from libraries and ROS too.

    `declared` are the declarations that an import can have: that in the first file counts.
    """

    project: Project
    declared: dict[Key, tuple[File, Declaration]] = field(default_factory=dict)

    @property
    def file(self) -> File:
        """The file that was named, which imports all others."""
        return self.project.files[0]


def read_model(
    path: Path,
    report: Diagnostics,
    libraries: Sequence[Path] = (),
    texts: Mapping[str, str] | None = None,
    *,
    names: Diagnostics | None = None,
) -> Model:
    """Read a file and what it imports.

    `texts` are those of files, by path, that are read as if they had them. What is wrong with
    names goes to a report of its own, if anybody asks for it.
    """
    project = load([path], report, libraries, _Texts(texts or {}))
    if project.files:
        link(project, Diagnostics() if names is None else names)
    model = Model(project)
    for file, declaration in project.declarations():
        group = of_group(declaration)
        if group is not None:
            name = str(declaration.name)
            found = str(interface_name(file, name)) if group == "interface" else name
            model.declared.setdefault((group, found), (file, declaration))
    return model


def of_group(declaration: Declaration) -> str | None:
    """The group of a declaration; None for one that no import has."""
    for group, classes in _GROUPS.items():
        if isinstance(declaration, classes):
            return group
    return None


def groups_before(group: str) -> list[str]:
    """The groups that usually stand before another one in a file."""
    groups = list(_GROUPS)
    return groups[: groups.index(group)]
