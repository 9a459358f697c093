"""Workspaces of the files that are open in the editor, with their unsaved text.

A file belongs to the sources of its project (`swarm.toml`); without a project, to the folder that
is open in the editor; outside of it, the file is a model of its own.
"""

from __future__ import annotations

import gc
from collections.abc import Iterable, Iterator, Sequence
from pathlib import Path
from typing import TYPE_CHECKING

from swarmdsl.base.diagnostics.collector import Diagnostic, Diagnostics
from swarmdsl.base.records import dataclass, replace
from swarmdsl.base.source import Source
from swarmdsl.driver.config import FILE_NAME, Settings, find_file, read_project
from swarmdsl.driver.workspace import Workspace
from swarmdsl.ide.server.allowed_paths import AllowedPaths
from swarmdsl.project.loader import File

if TYPE_CHECKING:
    from swarmdsl.ide.server.data_files import DataFiles

# About 80,000 lines; larger models would block the editor after each key.
_MAX_BYTES = 2 * 2**20


@dataclass
class _Project:
    """Settings of a project file, with the diagnostics of its last read."""

    settings: Settings
    report: Diagnostics


class Models:
    """Workspaces of all open files; `folders` are open in the editor.

    Edits take effect at the next query, so a burst of keys costs as much as one.
    """

    def __init__(self, folders: Sequence[Path] = ()) -> None:
        self.folders = list(folders)
        self._texts: dict[Path, str] = {}
        # Edited files that their workspaces have not seen; True if the file was just opened or
        # closed.
        self._changed: dict[Path, bool] = {}
        self._workspaces: dict[tuple[Path, ...], Workspace] = {}
        self._projects: dict[Path, _Project] = {}
        # Imported with the first data file that is open.
        self._data: DataFiles | None = None
        self._named: dict[tuple[Path, ...], Workspace] = {}
        """Workspaces of models that tests name, until a model changes."""

    @property
    def has_pending_edits(self) -> bool:
        """Return True if there are edits that have not taken effect."""
        return bool(self._changed)

    def edit(self, path: Path, text: str) -> None:
        """Set the text of a file that is open in the editor."""
        self._changed[path] = self._changed.get(path, False) or path not in self._texts
        self._texts[path] = text

    def close(self, path: Path) -> None:
        """Use the content on disk again."""
        if self._texts.pop(path, None) is not None:
            self._changed[path] = True

    def refresh(self, paths: Iterable[Path]) -> None:
        """Read files again that changed on disk, unless they are open."""
        for path in paths:
            if path not in self._texts:
                self._changed[path] = True

    def open_folders(self, folders: Iterable[Path]) -> None:
        """Replace the folders that are open in the editor."""
        self.folders = list(folders)
        self._discard_workspaces()

    def all(self) -> list[Workspace]:
        """Return all workspaces, up to date with all edits."""
        self._apply_edits()
        return list(self._workspaces.values())

    def file(self, path: Path) -> tuple[Workspace, File] | None:
        """Return an open file and its workspace."""
        self._apply_edits()
        if path not in self._texts or not _is_model(path):
            return None
        workspace = self._workspace_of(path)
        file = workspace.file(path)
        return (workspace, file) if file is not None else None

    def opened(self, workspace: Workspace) -> list[Path]:
        """Return the open files of a workspace, unreadable ones first."""
        files = [path for path in self._models() if self._workspace_of(path) is workspace]
        return sorted(files, key=lambda path: workspace.file(path) is not None)

    def diagnostics(self) -> Iterator[tuple[Workspace | None, str, list[Diagnostic]]]:
        """Yield diagnostics by workspace and file name ("" if they have no file)."""
        self._apply_edits()
        # They may need workspaces of their own.
        data = [(None, *each) for each in self._mistakes_in_data()]
        for workspace in self._workspaces.values():
            for name, found in workspace.diagnostics().items():
                yield workspace, name, found
        yield from data
        for path, project in self._projects.items():
            yield None, str(path), list(project.report)

    def _mistakes_in_data(self) -> Iterator[tuple[str, list[Diagnostic]]]:
        """Yield diagnostics of open tests and scenarios by file name."""
        for path in filter(_is_data, self._texts):
            for found in self._data_files().mistakes(path, self._texts[path], self._texts):
                name = found.primary.span.source.name if found.primary is not None else str(path)
                yield name, [found]

    def _data_files(self) -> DataFiles:
        if self._data is None:
            from swarmdsl.ide.server.data_files import DataFiles

            self._data = DataFiles(self._workspace_of_data)
        return self._data

    def _workspace_of_data(self, path: Path, named: tuple[Path, ...]) -> Workspace | None:
        """Return the workspace of the models that a data file names, else of its project."""
        settings, home = self._settings(path)
        if settings is None:
            if path.parent == path.parent.parent:
                return None
            settings = Settings(sources=(path.parent,))
        if not named:
            return self._workspaces.get(settings.sources) or self._create_workspace(settings, home)
        if named not in self._named:
            self._named[named] = self._new_workspace(replace(settings, sources=named), home)
        return self._named[named]

    def _models(self) -> Iterator[Path]:
        return (path for path in self._texts if _is_model(path))

    def _apply_edits(self) -> None:
        """Bring all workspaces up to date."""
        if not self._changed:
            return
        changed, self._changed = self._changed, {}
        if self._data is not None and not all(map(_is_data, changed)):
            self._data.forget()
            self._named.clear()
        known = [workspace.file for workspace in self._workspaces.values()]
        for path in changed:
            # A file that could not be read is treated as new.
            changed[path] |= all(file(path) is None for file in known)
        try:
            if any(path.name == FILE_NAME for path in changed):
                self._workspaces.clear()
            for workspace in self._workspaces.values():
                texts = {
                    path: self._texts.get(path)
                    for path, fresh in changed.items()
                    if _is_model(path) and (fresh or workspace.file(path) is not None)
                }
                if texts:
                    workspace.update(texts)
            for path in self._models():
                self._workspace_of(path)
            for path in self._texts:
                if path.name == FILE_NAME and (path in changed or path not in self._projects):
                    self._project(path)
        except BaseException:
            self._discard_workspaces()  # a partial update leaves a workspace inconsistent
            raise
        if any(changed.values()):
            self._drop_unused()

    def _drop_unused(self) -> None:
        """Drop workspaces and projects that no open file needs."""
        used = {id(self._workspace_of(path)) for path in self._models()}
        used |= {
            id(self._workspaces.get(settings.sources))
            for path in self._texts
            if _is_data(path) and (settings := self._settings(path)[0]) is not None
        }
        homes = {find_file(path) for path in self._texts}
        self._projects = {path: each for path, each in self._projects.items() if path in homes}
        kept = {key: each for key, each in self._workspaces.items() if id(each) in used}
        if len(kept) < len(self._workspaces):
            self._workspaces = kept
            gc.unfreeze()
            gc.collect()

    def _discard_workspaces(self) -> None:
        """Discard all workspaces; they are built again on demand."""
        if self._workspaces:
            self._workspaces.clear()
            gc.unfreeze()
        self._changed = dict.fromkeys(self._texts, True)

    def _workspace_of(self, path: Path) -> Workspace:
        found = [each for each in self._workspaces.values() if each.file(path) is not None]
        if found:
            # Prefer the workspace that includes the importers of the file.
            return max(found, key=lambda workspace: workspace.files)
        settings, home = self._settings(path)
        if settings is not None and settings.sources not in self._workspaces:
            workspace = self._create_workspace(settings, home)
            if workspace.file(path) is not None:
                return workspace
            del self._workspaces[settings.sources]
        alone = (path,)
        return self._workspaces.get(alone) or self._create_workspace(
            Settings(sources=alone), path.parent
        )

    def _settings(self, path: Path) -> tuple[Settings | None, Path]:
        """Return the settings for a file and their folder; None for a file without a project."""
        project = find_file(path)
        if project is not None:
            return self._project(project), project.parent
        folder = next((each for each in self.folders if path.is_relative_to(each)), None)
        if folder is not None:
            return Settings(sources=(folder,)), folder
        return None, path.parent

    def _project(self, path: Path) -> Settings:
        """Read a project file; keep the previous settings while it has errors."""
        text = self._texts.get(path)
        source = Source(str(path), text, path) if text is not None else None
        report = Diagnostics()
        settings = read_project(path, report, source)
        if report.has_errors:
            before = self._projects.get(path)
            settings = before.settings if before else Settings(sources=(path.parent,))
        self._projects[path] = _Project(settings, report)
        return settings

    def _create_workspace(self, settings: Settings, home: Path) -> Workspace:
        workspace = self._workspaces[settings.sources] = self._new_workspace(settings, home)
        gc.collect()
        gc.freeze()
        return workspace

    def _new_workspace(self, settings: Settings, home: Path) -> Workspace:
        allowed = AllowedPaths([*self.folders, home], settings)
        models = {path: self._texts[path] for path in self._models()}
        return Workspace(settings.sources, settings, texts=models, within=allowed, most=_MAX_BYTES)


def _is_data(path: Path) -> bool:
    """Return True for a file that may have tests or a scenario."""
    return path.suffix == ".toml" and path.name != FILE_NAME


def _is_model(path: Path) -> bool:
    return path.suffix != ".toml"
