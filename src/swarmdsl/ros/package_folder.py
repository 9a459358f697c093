"""Folders of interface packages: which interfaces there are, of which package."""

from __future__ import annotations

import os
import re
from collections.abc import Iterator
from pathlib import Path

from swarmdsl.dataclass import dataclass
from swarmdsl.diagnostics import Diagnostics
from swarmdsl.libraries import SUFFIX
from swarmdsl.ros.interface_file import KINDS, Kind
from swarmdsl.source import Span

_MANIFEST = "package.xml"
# Files by which ROS's build tools know that a folder is none of their business.
_IGNORED = {"AMENT_IGNORE", "CATKIN_IGNORE", "COLCON_IGNORE"}
# What lies beside the `src` of a workspace: the same interfaces, installed.
_BUILT = frozenset(
    f"{name}{suffix}" for name in ("build", "devel", "install") for suffix in ("", "_isolated")
)
_NAME = re.compile(r"[A-Za-z]\w*", re.ASCII)
_WANTED = (
    "name the folder of a ROS package with .msg, .srv or .action files, "
    "or one with several such packages"
)


@dataclass(frozen=True)
class InterfacePath:
    """The file of an interface."""

    package: str
    kind: Kind
    name: str
    path: Path


def find_interfaces(folder: Path, at: Span | None, report: Diagnostics) -> list[InterfacePath]:
    """The interfaces in a folder, by package, kind and name; mistakes are reported at `at`.

    The folder is that of a package, with the files in it or in `msg`, `srv` and `action`,
    or one with several packages below it: a ROS workspace, for instance.
    """
    if not folder.exists():
        report.report("file-not-found", at, path=folder, help=_WANTED)
        return []
    if not folder.is_dir():
        report.report(
            "not-a-file",
            at,
            path=folder,
            actual="a file",
            expected="a folder",
            help="write `import` without `ros`" if folder.suffix == SUFFIX else _WANTED,
        )
        return []
    finder = _Finder(folder, at, report)
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
    if not found and not finder.reported:
        report.report(
            "file-not-found",
            at,
            path=folder / "*.msg",
            help=_WANTED,
        )
    return [found[key] for key in sorted(found, key=_order)]


def _order(key: tuple[str, Kind, str]) -> tuple[str, int, str]:
    package, kind, name = key
    return package, KINDS.index(kind), name


class _Finder:
    """Looks through one folder."""

    def __init__(self, folder: Path, at: Span | None, report: Diagnostics) -> None:
        self._top = folder
        self._at = at
        self._report = report
        # The package that each manifest names, None for a manifest that names none.
        self._manifests: dict[Path, str | None] = {}
        self.reported = False

    def find(self) -> Iterator[InterfacePath]:
        """All interface files, folder by folder."""
        for folder, names in self._folders():
            files = [
                (name.removesuffix(f".{kind}"), kind, folder / name)
                for name in names
                for kind in KINDS
                if name.endswith(f".{kind}")
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

    def _folders(self) -> Iterator[tuple[Path, list[str]]]:
        """The folders that may have interfaces, each with the names of its files."""
        seen: set[str] = set()
        for folder, inner, names in os.walk(self._top, onerror=self._unreadable, followlinks=True):
            real = os.path.realpath(folder)
            if real in seen or not _IGNORED.isdisjoint(names):
                inner.clear()
                continue
            seen.add(real)
            left_out = _BUILT if "src" in inner and _MANIFEST not in names else frozenset()
            inner[:] = sorted({name for name in inner if name[0] != "."} - left_out)
            yield Path(folder), sorted(names)

    def _package(self, folder: Path) -> str:
        """The package that the files in a folder belong to."""
        home = _absolute(folder)
        parents = [home, *home.parents]
        top = _absolute(self._top)
        within = parents[: parents.index(top) + 1] if top in parents else parents[:1]
        if top.name in KINDS:
            within.append(top.parent)
        for parent in within:
            name = self._named_by_manifest(parent)
            if name is not None:
                return name
        holder = next((parent for parent in parents if parent.name in KINDS), None)
        return (holder.parent if holder in within else home).name

    def _named_by_manifest(self, folder: Path) -> str | None:
        manifest = folder / _MANIFEST
        if manifest not in self._manifests:
            self._manifests[manifest] = self._read(manifest) if manifest.is_file() else None
        return self._manifests[manifest]

    def _read(self, manifest: Path) -> str | None:
        from xml.etree import ElementTree

        try:
            name = ElementTree.parse(manifest).findtext("name", "").strip()
        except OSError as error:
            self._unreadable(error)
            return None
        except ElementTree.ParseError as error:
            self._cannot_read(manifest, f"it is not XML: {error}")
            return None
        return name or None

    def _bad_name(self, name: str, what: str, advice: str) -> None:
        message = f"`{name}` cannot be the name of a ROS {what}"
        self._report.report("syntax-error", self._at, message=message, help=advice)
        self.reported = True

    def _unreadable(self, error: OSError) -> None:
        self._cannot_read(error.filename, (error.strerror or str(error)).lower())

    def _cannot_read(self, path: str | Path, reason: str) -> None:
        self._report.report("unreadable-file", self._at, path=path, reason=reason)
        self.reported = True


def _absolute(path: Path) -> Path:
    """A path from the root without `..`; a linked folder keeps the name of the link."""
    return Path(os.path.abspath(path))  # noqa: PTH100
