"""Find interface and parameter files in folders of ROS packages."""

from __future__ import annotations

import os
import re
from collections.abc import Callable, Iterable, Iterator, Sequence
from pathlib import Path

from swarmdsl.base.diagnostics.advice import Advice
from swarmdsl.base.diagnostics.collector import Diagnostics
from swarmdsl.base.find_files import TooManyFilesError, walk
from swarmdsl.base.read_files import MOST_DATA, exists, is_folder, read_file
from swarmdsl.base.records import dataclass
from swarmdsl.base.source import Span
from swarmdsl.project.libraries import SUFFIX
from swarmdsl.project.rosidl.installed import advice
from swarmdsl.project.rosidl.interface_file import INTERFACE_KINDS, Kind
from swarmdsl.project.search import report_too_many

_MANIFEST = "package.xml"
# Files that make the build tools of ROS ignore a folder.
_IGNORED = {"AMENT_IGNORE", "CATKIN_IGNORE", "COLCON_IGNORE"}
# Folders beside the `src` of a workspace, with the same interfaces installed.
_BUILT = frozenset(
    f"{name}{suffix}" for name in ("build", "devel", "install") for suffix in ("", "_isolated")
)
_NAME = re.compile(r"[A-Za-z]\w*", re.ASCII)
# Folders of parameter files in ROS packages.
_PARAMETERS = ("param", "params", "config", "cfg")
_WANTED = (
    "name the folder of a ROS package with .msg, .srv or .action files, "
    "or one with several such packages; or the name of a package that is installed, "
    "with the setup file of ROS 2 sourced"
)


@dataclass(frozen=True)
class InterfacePath:
    """File of an interface."""

    package: str
    kind: Kind
    name: str
    path: Path


@dataclass(frozen=True)
class ParameterPath:
    """File with parameter values for the nodes of a package."""

    package: str
    path: Path


def find_parameters(folder: Path) -> list[ParameterPath]:
    """Return the YAML files with parameter values in a folder, sorted by package and path.

    In a package these are in `param`, `config` and the like; a folder without `package.xml`
    counts as a copy of such a folder. Unreadable folders are skipped.
    """
    finder = _Finder(folder, None, Diagnostics())
    return sorted(finder.find_parameters(), key=lambda found: (found.package, str(found.path)))


def find_interfaces(
    folder: Path,
    at: Span | None,
    report: Diagnostics,
    *,
    required: bool = True,
    look: Callable[[Path], None] | None = None,
    named: str = "",
) -> list[InterfacePath]:
    """Return the interfaces in a folder by package, kind and name; report errors at `at`.

    `named` is the folder as the user named it, which may be the name of an installed package.

    The folder is a package, with the files in it or in `msg`, `srv` and `action`, or has several
    packages below it, like a ROS workspace. If interfaces are `required`, it is an error to find
    none. `look` is called with each folder and manifest that is tried.
    """
    if look is not None:
        look(folder)
    if not exists(folder):
        report.report("file-not-found", at, path=folder, help=advice(named) or _WANTED)
        return []
    if not is_folder(folder):
        report.report(
            "not-a-file",
            at,
            path=folder,
            actual="a file",
            expected="a folder",
            help=Advice("write `import` without `ros`", "write import", "import")
            if folder.suffix == SUFFIX
            else _WANTED,
        )
        return []
    finder = _Finder(folder, at, report, look)
    found: dict[tuple[str, Kind, str], InterfacePath] = {}
    for interface in finder.find():
        first = found.setdefault((interface.package, interface.kind, interface.name), interface)
        if first is not interface:
            report.report(
                "duplicate-name",
                at,
                kind="interface",
                name=f"{interface.package}/{interface.kind}/{interface.name}",
                notes=(f"the files are `{first.path}` and `{interface.path}`",),
            )
    if required and not found and not finder.reported:
        report.report(
            "file-not-found",
            at,
            path=folder / "*.msg",
            help=_WANTED,
        )
    return [found[key] for key in sorted(found, key=_order)]


def _order(key: tuple[str, Kind, str]) -> tuple[str, int, str]:
    package, kind, name = key
    return package, INTERFACE_KINDS.index(kind), name


class _Finder:
    """Searches one folder."""

    def __init__(
        self,
        folder: Path,
        at: Span | None,
        report: Diagnostics,
        look: Callable[[Path], None] | None = None,
    ) -> None:
        self._top = folder
        self._look = look
        self._at = at
        self._report = report
        # Package of each manifest, None for a manifest without a name.
        self._manifests: dict[Path, str | None] = {}
        self.reported = False

    def find(self) -> Iterator[InterfacePath]:
        """Yield all interface files, folder by folder."""
        for folder, names in self._folders():
            files = [
                (name.removesuffix(f".{kind}"), kind, folder / name)
                for name in names
                for kind in INTERFACE_KINDS
                if name.endswith(f".{kind}") and not _is_derived(name, folder)
            ]
            if not files:
                continue
            package = self._package(folder)
            if not _NAME.fullmatch(package):
                self._bad_name(package, "package", f"rename the folder, or add a `{_MANIFEST}`")
                continue
            for name, kind, path in files:
                if _NAME.fullmatch(name):
                    yield InterfacePath(package, kind, name, path)
                else:
                    self._bad_name(name, "interface", f"rename `{path}`")

    def find_parameters(self) -> Iterator[ParameterPath]:
        """Yield all files with parameter values."""
        for folder, names in self._folders():
            within = self._within(folder, _PARAMETERS)
            home = next((parent for parent in within if parent.name in _PARAMETERS), None)
            package = self._manifest_name(within)
            if package is not None and home is None:
                continue  # in a package, but not for its nodes
            if package is None:
                package = (within[0].parent if home is within[0] else within[0]).name
            for name in names if _NAME.fullmatch(package) else ():
                if name.endswith((".yaml", ".yml")):
                    yield ParameterPath(package, folder / name)

    def _walk(self) -> Iterator[tuple[str, list[str], list[str]]]:
        try:
            yield from walk(self._top, self._unreadable, followlinks=True)
        except TooManyFilesError as error:
            report_too_many(error, self._at, self._report)
            self.reported = True

    def _folders(self) -> Iterator[tuple[Path, list[str]]]:
        """Folders that may have interfaces, each with the names of its files."""
        seen: set[str] = set()
        for folder, inner, names in self._walk():
            real = os.path.realpath(folder)
            if real in seen or not _IGNORED.isdisjoint(names):
                inner.clear()
                continue
            seen.add(real)
            if self._look is not None:
                self._look(Path(folder))
            left_out = _BUILT if "src" in inner and _MANIFEST not in names else frozenset()
            inner[:] = sorted({name for name in inner if name[0] != "."} - left_out)
            yield Path(folder), sorted(names)

    def _package(self, folder: Path) -> str:
        """Package of the interfaces in a folder."""
        within = self._within(folder, INTERFACE_KINDS)
        name = self._manifest_name(within)
        if name is not None:
            return name
        home = within[0]
        holder = next(
            (parent for parent in (home, *home.parents) if parent.name in INTERFACE_KINDS), None
        )
        return (holder.parent if holder in within else home).name

    def _within(self, folder: Path, inside: Sequence[str]) -> list[Path]:
        """Return a folder and its ancestors that may be the folder of its package.

        If the user named a folder `inside` a package, the package is around it.
        """
        home, top = _absolute(folder), _absolute(self._top)
        parents = [home, *home.parents]
        within = parents[: parents.index(top) + 1] if top in parents else parents[:1]
        return [*within, top.parent] if top.name in inside else within

    def _manifest_name(self, folders: Iterable[Path]) -> str | None:
        """Name of the package in the first manifest in these folders."""
        names = map(self._named_by_manifest, folders)
        return next((name for name in names if name is not None), None)

    def _named_by_manifest(self, folder: Path) -> str | None:
        manifest = folder / _MANIFEST
        if manifest not in self._manifests:
            if self._look is not None:
                self._look(manifest)
            self._manifests[manifest] = self._read(manifest) if exists(manifest) else None
        return self._manifests[manifest]

    def _read(self, manifest: Path) -> str | None:
        from xml.etree import ElementTree

        try:
            name = (
                ElementTree.fromstring(read_file(manifest, MOST_DATA)).findtext("name", "").strip()
            )
        except OSError as error:
            self._unreadable(error)
            return None
        except (ElementTree.ParseError, ValueError) as error:
            self._cannot_read(manifest, f"it is not XML: {error}")
            return None
        return name or None

    def _bad_name(self, name: str, what: str, hint: str) -> None:
        message = f"`{name}` cannot be the name of a ROS {what}"
        self._report.report("syntax-error", self._at, message=message, help=hint)
        self.reported = True

    def _unreadable(self, error: OSError) -> None:
        self._cannot_read(error.filename, (error.strerror or str(error)).lower())

    def _cannot_read(self, path: str | Path, reason: str) -> None:
        self._report.report("unreadable-file", self._at, path=path, reason=reason)
        self.reported = True


def _is_derived(name: str, folder: Path) -> bool:
    """Return True for a message that builds make of a service: `srv/Add_Request.msg`."""
    return folder.name in INTERFACE_KINDS[1:] and name.endswith(".msg") and "_" in name


def _absolute(path: Path) -> Path:
    """Absolute path without `..`; symbolic links are kept."""
    return Path(os.path.abspath(path))  # noqa: PTH100
