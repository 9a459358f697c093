"""The models that files in an editor belong to, with what is typed in place of what is on disk.

A file belongs to the sources of its project (`swarm.toml`); without a project to the folder that
is open in the editor; outside of that it is a model of its own.
"""

from __future__ import annotations

import gc
from collections.abc import Iterable, Iterator, Sequence
from pathlib import Path

from swarmdsl.base.diagnostics.collector import Diagnostic, Diagnostics
from swarmdsl.base.records import dataclass
from swarmdsl.base.source import Source
from swarmdsl.driver.config import FILE_NAME, Settings, find_file, read_project
from swarmdsl.driver.workspace import Workspace
from swarmdsl.ide.server.allowed_paths import Territory
from swarmdsl.project.loader import File

# Some 80,000 lines: beyond that nobody waits for an answer after a key.
_MOST_BYTES = 2 * 2**20


@dataclass
class _Project:
    """A project file as it was read last, and what is wrong with it."""

    settings: Settings
    report: Diagnostics


class Models:
    """The workspaces of all open files; `folders` are those that are open in the editor.

    An edit takes effect when something is asked: many keys in a row cost what one does.
    """

    def __init__(self, folders: Sequence[Path] = ()) -> None:
        self.folders = list(folders)
        self._texts: dict[Path, str] = {}
        # Files whose text is another than their workspaces know; whether it is for the first time.
        self._changed: dict[Path, bool] = {}
        self._workspaces: dict[tuple[Path, ...], Workspace] = {}
        self._projects: dict[Path, _Project] = {}

    @property
    def waiting(self) -> bool:
        """Whether there are edits that have not taken effect."""
        return bool(self._changed)

    def edit(self, path: Path, text: str) -> None:
        """Take what an editor shows for the content of a file."""
        self._changed[path] = self._changed.get(path, False) or path not in self._texts
        self._texts[path] = text

    def close(self, path: Path) -> None:
        """Take what is on disk again."""
        if self._texts.pop(path, None) is not None:
            self._changed[path] = True

    def refresh(self, paths: Iterable[Path]) -> None:
        """Read files again that were changed on disk, but for those that are open."""
        for path in paths:
            if path not in self._texts:
                self._changed[path] = True

    def open_folders(self, folders: Iterable[Path]) -> None:
        """Take other folders for those that are open in the editor."""
        self.folders = list(folders)
        self._forget()

    def all(self) -> list[Workspace]:
        """The workspaces, after all edits."""
        self._settle()
        return list(self._workspaces.values())

    def file(self, path: Path) -> tuple[Workspace, File] | None:
        """An open file, with the workspace that it belongs to."""
        self._settle()
        if path not in self._texts or path.name == FILE_NAME:
            return None
        workspace = self._workspace_of(path)
        file = workspace.file(path)
        return (workspace, file) if file is not None else None

    def opened(self, workspace: Workspace) -> list[Path]:
        """The open files of a workspace, first those that could not be read."""
        files = [path for path in self._models() if self._workspace_of(path) is workspace]
        return sorted(files, key=lambda path: workspace.file(path) is not None)

    def diagnostics(self) -> Iterator[tuple[Workspace, str, list[Diagnostic]]]:
        """What is wrong by workspace and name of the file; of "" what is wrong with no file."""
        workspaces = self.all()
        for workspace in workspaces:
            for name, found in workspace.diagnostics().items():
                yield workspace, name, found
        for path, project in self._projects.items():
            yield from [(each, str(path), list(project.report)) for each in workspaces[:1]]

    def _models(self) -> Iterator[Path]:
        return (path for path in self._texts if path.name != FILE_NAME)

    def _settle(self) -> None:
        """Let all edits take effect."""
        if not self._changed:
            return
        changed, self._changed = self._changed, {}
        known = [workspace.file for workspace in self._workspaces.values()]
        for path in changed:
            # One that could not be read is looked at as if it were new.
            changed[path] |= all(file(path) is None for file in known)
        try:
            if any(path.name == FILE_NAME for path in changed):
                self._workspaces.clear()
            for workspace in self._workspaces.values():
                texts = {
                    path: self._texts.get(path)
                    for path, fresh in changed.items()
                    if path.name != FILE_NAME and (fresh or workspace.file(path) is not None)
                }
                if texts:
                    workspace.update(texts)
            for path in self._models():
                self._workspace_of(path)
        except BaseException:
            self._forget()  # what an update has left half done is of no use
            raise
        if any(changed.values()):
            self._tidy()

    def _tidy(self) -> None:
        """Forget the models of which no file is open, or only such as others have too."""
        used = {id(self._workspace_of(path)) for path in self._models()}
        kept = {key: each for key, each in self._workspaces.items() if id(each) in used}
        if len(kept) < len(self._workspaces):
            self._workspaces = kept
            homes = {find_file(path) for path in self._models()}
            self._projects = {path: each for path, each in self._projects.items() if path in homes}
            gc.unfreeze()
            gc.collect()

    def _forget(self) -> None:
        """Make all models anew when they are needed."""
        if self._workspaces:
            self._workspaces.clear()
            gc.unfreeze()
        self._changed = dict.fromkeys(self._texts, True)

    def _workspace_of(self, path: Path) -> Workspace:
        found = [each for each in self._workspaces.values() if each.file(path) is not None]
        if found:
            # Who imports a file belongs to the picture.
            return max(found, key=lambda workspace: workspace.files)
        settings, home = self._settings(path)
        if settings is not None and settings.sources not in self._workspaces:
            workspace = self._made(settings, home)
            if workspace.file(path) is not None:
                return workspace
            del self._workspaces[settings.sources]
        alone = (path,)
        return self._workspaces.get(alone) or self._made(Settings(sources=alone), path.parent)

    def _settings(self, path: Path) -> tuple[Settings | None, Path]:
        """What is compiled together with a file, None for that file alone; and where it is."""
        project = find_file(path)
        if project is not None:
            return self._project(project), project.parent
        folder = next((each for each in self.folders if path.is_relative_to(each)), None)
        if folder is not None:
            return Settings(sources=(folder,)), folder
        return None, path.parent

    def _project(self, path: Path) -> Settings:
        """What a project file says; while it has mistakes, what it said before."""
        text = self._texts.get(path)
        source = Source(str(path), text, path) if text is not None else None
        report = Diagnostics()
        settings = read_project(path, report, source)
        if report.has_errors:
            before = self._projects.get(path)
            settings = before.settings if before else Settings(sources=(path.parent,))
        self._projects[path] = _Project(settings, report)
        return settings

    def _made(self, settings: Settings, home: Path) -> Workspace:
        territory = Territory([*self.folders, home], settings)
        models = {path: self._texts[path] for path in self._models()}
        workspace = Workspace(
            settings.sources, settings, texts=models, within=territory, most=_MOST_BYTES
        )
        self._workspaces[settings.sources] = workspace
        gc.collect()
        gc.freeze()
        return workspace
