"""The existing model of an update: its declarations and their files."""

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
"""Group and name of a declaration."""

# In their usual order in a file.
_GROUPS: Mapping[str, tuple[type, ...]] = {
    "interface": (MessageType, ServiceType, ActionType, StructType, EnumType, AliasType),
    "event": (Event,),
    "function": (Function,),
    "component": (Component,),
    "machine": (StateMachine,),
}


class _OverlayReader(Reader):
    """Reader with overlay texts for some files."""

    def __init__(self, texts: Mapping[str, str]) -> None:
        self._texts = texts

    def model(self, path: Path, at: Span | None, report: Diagnostics) -> File | None:
        text = self._texts.get(str(path))
        if text is None:
            return super().model(path, at, report)
        return parsed_model(Source(str(path), text, path), report)


@dataclass(eq=False)
class Model:
    """Files of a model, including imported libraries and ROS interfaces.

    `declared` are the declarations that an import can contain; the first file wins.
    """

    project: Project
    declared: dict[Key, tuple[File, Declaration]] = field(default_factory=dict)

    @property
    def file(self) -> File:
        """The main file, which imports all others."""
        return self.project.files[0]


def read_model(
    path: Path,
    report: Diagnostics,
    libraries: Sequence[Path] = (),
    texts: Mapping[str, str] | None = None,
    *,
    names: Diagnostics | None = None,
) -> Model:
    """Read a file and its imports.

    `texts` replace the contents of files, by path. Name errors are reported to `names`, if given.
    """
    project = load([path], report, libraries, _OverlayReader(texts or {}))
    if project.files:
        link(project, Diagnostics() if names is None else names)
    model = Model(project)
    for file, declaration in project.declarations():
        group = group_of(declaration)
        if group is not None:
            name = str(declaration.name)
            found = str(interface_name(file, name)) if group == "interface" else name
            model.declared.setdefault((group, found), (file, declaration))
    return model


def group_of(declaration: Declaration) -> str | None:
    """Group of a declaration; None if no import contains its kind."""
    for group, classes in _GROUPS.items():
        if isinstance(declaration, classes):
            return group
    return None


def groups_before(group: str) -> list[str]:
    """Return the groups that are usually before another one in a file."""
    groups = list(_GROUPS)
    return groups[: groups.index(group)]
