"""Completion of imports: packages and files in them, and names that need an import."""

from __future__ import annotations

import os
import re
from collections.abc import Iterator
from pathlib import Path

from swarmdsl.analysis.resolve.hints import declarations_elsewhere
from swarmdsl.analysis.resolve.missing_declaration import library_imports
from swarmdsl.analysis.resolve.scopes import FileScope
from swarmdsl.base.diagnostics.collector import Diagnostics
from swarmdsl.base.source import Span
from swarmdsl.driver.workspace import Workspace
from swarmdsl.ide.server.completion_entry import BEST, IMPORTED, LIKELY, Completion, entry_of
from swarmdsl.project.libraries import SUFFIX, Libraries
from swarmdsl.project.loader import File
from swarmdsl.project.rosidl.installed import installed_packages
from swarmdsl.project.rosidl.interface_file import INTERFACE_KINDS
from swarmdsl.project.search import found_below
from swarmdsl.syntax.ast import ImportFile, ImportLibrary, ImportRos, Node

_ROS = re.compile(r'^[ \t]*import[ \t]+ros[ \t]+"([^"\n]*)\Z', re.MULTILINE)
_FILE = re.compile(r'^[ \t]*import[ \t]+"([^"\n]*)\Z', re.MULTILINE)
_PACKAGE = re.compile(r"^[ \t]*import[ \t]+([\w.]*)\Z", re.MULTILINE)
_REST = re.compile(r"[\w.]*\*?")
_REST_OF_FILE = re.compile(r'[^"\n]*')


def imports_at(workspace: Workspace, file: File, start: int) -> list[Completion] | None:
    """Return what an import can name at an offset; None outside of imports."""
    text = file.source.text
    head = text[:start]
    for pattern, offered in ((_FILE, _files), (_ROS, _ros_packages)):
        if quoted := pattern.search(head):
            rest = _REST_OF_FILE.match(text, start)
            end = rest.end() if rest is not None else start
            return list(offered(workspace, file, Span(file.source, quoted.start(1), end)))
    if named := _PACKAGE.search(head):
        rest = _REST.match(text, start)
        place = Span(file.source, named.start(1), rest.end() if rest is not None else start)
        return list(_packages(workspace, file, place))
    return None


def missing_imports(kinds: tuple[type[Node], ...], scope: FileScope) -> Iterator[Completion]:
    """Yield declarations of some kinds that the file does not see, with their imports."""
    seen = set(scope.visible())
    for node, line in declarations_elsewhere(kinds, scope):
        name = str(node.name)
        if name not in seen:
            seen.add(name)
            entry = entry_of(node, rank=IMPORTED)
            yield Completion(name, f"{entry.detail} ({line})", node, rank=IMPORTED, added=line)
    for name, line in library_imports(kinds, scope.project):
        if name not in seen:
            seen.add(name)
            yield Completion(name, f"({line})", rank=IMPORTED, added=line)


def _files(workspace: Workspace, file: File, place: Span) -> Iterator[Completion]:
    """Yield the files of the model that can be imported, by their relative paths."""
    own = Path(file.source.name)
    known = {str(each.path) for each in file.model.imports if isinstance(each, ImportFile)}
    paths = [Path(each.source.name) for each in workspace.project.files if not each.library]
    paths += found_below(own.parent, SUFFIX, Diagnostics()) or ()
    for path in dict.fromkeys(paths):
        relative = Path(os.path.relpath(path, own.parent)).as_posix()
        if path != own and relative not in known:
            yield Completion(relative, "file", rank=LIKELY, replaced=place)


def _ros_packages(_workspace: Workspace, file: File, place: Span) -> Iterator[Completion]:
    """Yield folders with interfaces of ROS below the file, and installed packages."""
    own = Path(file.source.name)
    known = {str(each.path) for each in file.model.imports if isinstance(each, ImportRos)}
    folders = []
    for kind in INTERFACE_KINDS:
        for path in found_below(own.parent, f".{kind}", Diagnostics()) or ():
            inside = path.parent
            folders.append(inside.parent if inside.name == kind else inside)
    for folder in dict.fromkeys(folders):
        relative = Path(os.path.relpath(folder, own.parent)).as_posix()
        if relative not in known:
            yield Completion(relative, "folder", rank=BEST, replaced=place)
    for name in installed_packages():
        if name not in known:
            yield Completion(name, "package", rank=LIKELY, replaced=place)


def _packages(workspace: Workspace, file: File, place: Span) -> Iterator[Completion]:
    """Yield packages of libraries, and the declarations of the one that is written."""
    libraries = Libraries(workspace.settings.libraries, Diagnostics(), lambda _: None)
    known = {each.name for each in file.model.imports if isinstance(each, ImportLibrary)}
    package = place.text.rpartition(".")[0]
    for name in sorted(libraries.packages(Path(file.source.name).parent)):
        begins = not package or f"{name}.".startswith(f"{package}.")
        if begins and f"{name}.*" not in known and name != file.package:
            yield Completion(f"{name}.*", "package", rank=BEST, replaced=place)
    for name, line in library_imports((Node,), workspace.project):
        path = line.partition(" ")[2]
        if package and path == f"{package}.{name}" and path not in known:
            yield Completion(path, "declaration", rank=LIKELY, replaced=place)
    if not place.text:
        yield Completion("ros", "keyword")
