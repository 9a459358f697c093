"""The models that files in an editor belong to, with what is typed in place of what is on disk.

A file belongs to the sources of its project (`swarm.toml`); without a project to the folder that
is open in the editor; outside of that it is a model of its own.
"""

from __future__ import annotations

import gc
from collections.abc import Iterable, Iterator, Mapping, Sequence
from pathlib import Path

from swarmdsl.diagnostics import Diagnostics
from swarmdsl.load import File
from swarmdsl.project import find_file, find_settings
from swarmdsl.project.settings import Settings
from swarmdsl.workspace import Workspace


class Models:
    """The workspaces of all open files; `folders` are those that are open in the editor."""

    def __init__(self, folders: Sequence[Path] = ()) -> None:
        self.folders = list(folders)
        self._texts: dict[Path, str] = {}
        self._workspaces: dict[tuple[Path, ...], Workspace] = {}

    def __iter__(self) -> Iterator[Workspace]:
        return iter(self._workspaces.values())

    def edit(self, path: Path, text: str) -> None:
        """Take what an editor shows for the content of a file."""
        known = path in self._texts
        self._texts[path] = text
        for workspace in self:
            if not known or workspace.file(path) is not None:
                workspace.update({path: text})
        self._workspace_of(path)

    def close(self, path: Path) -> None:
        """Take what is on disk again; models of which no file is open are forgotten."""
        if self._texts.pop(path, None) is None:
            return
        for workspace in self:
            workspace.update({path: None})
        self._workspaces = {
            sources: workspace
            for sources, workspace in self._workspaces.items()
            if any(workspace.file(each) is not None for each in self._texts)
        }
        gc.collect()

    def refresh(self, paths: Iterable[Path]) -> None:
        """Read files again that were changed on disk, but for those that are open."""
        changed: Mapping[Path, str | None] = {
            path: None for path in paths if path not in self._texts
        }
        if any(path.name == "swarm.toml" for path in changed):
            self._workspaces.clear()
            for path in self._texts:
                self._workspace_of(path)
            return
        for workspace in self:
            workspace.update(changed)

    def file(self, path: Path) -> tuple[Workspace, File] | None:
        """An open file, with the workspace that it belongs to."""
        if path not in self._texts:
            return None
        workspace = self._workspace_of(path)
        file = workspace.file(path)
        return (workspace, file) if file is not None else None

    def opened(self, workspace: Workspace) -> list[Path]:
        """The open files of a workspace, first those that could not be read."""
        files = [path for path in self._texts if self._workspace_of(path) is workspace]
        return sorted(files, key=lambda path: workspace.file(path) is not None)

    def _workspace_of(self, path: Path) -> Workspace:
        for workspace in self:
            if workspace.file(path) is not None:
                return workspace
        settings = self._settings(path)
        if settings is not None and settings.sources not in self._workspaces:
            workspace = self._made(settings)
            if workspace.file(path) is not None:
                return workspace
            del self._workspaces[settings.sources]
        alone = (path,)
        return self._workspaces.get(alone) or self._made(Settings(sources=alone))

    def _settings(self, path: Path) -> Settings | None:
        """What is compiled together with a file; None for that file alone."""
        if find_file(path) is not None:
            report = Diagnostics()
            settings = find_settings([path], report)
            return None if report.has_errors else settings
        folder = next((each for each in self.folders if path.is_relative_to(each)), None)
        return Settings(sources=(folder,)) if folder is not None else None

    def _made(self, settings: Settings) -> Workspace:
        workspace = Workspace(settings.sources, settings)
        workspace.update(self._texts)
        self._workspaces[settings.sources] = workspace
        gc.collect()
        gc.freeze()
        return workspace
