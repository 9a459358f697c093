"""Packages in libraries: `import cpswarm.uav.*`.

A package `a.b` is the file `a/b.swarm` of a library, or all .swarm files below its folder `a/b`.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from functools import cached_property
from pathlib import Path

from swarmdsl.base import resources
from swarmdsl.base.diagnostics.advice import Advice, meant
from swarmdsl.base.diagnostics.collector import Diagnostics, listed
from swarmdsl.base.read_files import is_file, is_folder
from swarmdsl.base.source import Span
from swarmdsl.base.suggest import closest, did_you_mean
from swarmdsl.syntax.ast import Import, ImportLibrary

SUFFIX = ".swarm"
GROUP = "swarmdsl.libraries"
"""The entry points of packages that bring models: the module in whose folder they lie."""


class Libraries:
    """Search path of packages; the first folder with a package wins.

    The order: the folder of the importing file, the given folders, the bundled library, the
    libraries of installed Python packages. `look` is called with each path that is tried.
    """

    def __init__(
        self, folders: Sequence[Path], report: Diagnostics, look: Callable[[Path], None]
    ) -> None:
        self._folders = folders
        self._report = report
        self._look = look
        self._packages: dict[Path, set[str]] = {}

    def find_package(self, statement: ImportLibrary, nearby: Path) -> list[Path]:
        """Return the files of a package; report a missing package."""
        package = statement.name.rpartition(".")[0]
        files = self._files(package, nearby, place_of(statement)) if package else []
        if files:
            return files
        self._report.report(
            "unknown-package",
            place_of(statement),
            name=package or statement.name,
            help=self._advice(statement, package, nearby),
        )
        return []

    def is_package(self, name: str, nearby: Path) -> bool:
        """Return True if a library has a package of this name."""
        return bool(self._files(name, nearby))

    def _files(self, package: str, nearby: Path, at: Span | None = None) -> list[Path]:
        """Files of a package, empty if no library has it."""
        parts = package.split(".")
        if not all(parts):
            return []  # `import a..b`
        for library in self._search_path(nearby):
            place = library.joinpath(*parts)
            file = place.with_suffix(SUFFIX)
            self._look(file)
            self._look(place)
            if is_file(file):
                return [file]
            if not is_folder(place):
                continue
            from swarmdsl.project.search import found_below

            if files := found_below(place, SUFFIX, self._report, at):
                return files
        return []

    def _search_path(self, nearby: Path) -> Iterator[Path]:
        yield nearby
        yield from self._folders
        yield resources.library()
        yield from self._installed

    @cached_property
    def _installed(self) -> list[Path]:
        return installed_folders(self._report)

    def _advice(self, statement: ImportLibrary, package: str, nearby: Path) -> str | None:
        if not package:
            return Advice(
                f"write `import {statement.name}.*` for all that a package declares",
                "write import",
                f"import {statement.name}.*",
            )
        names = self.packages(nearby)
        if package.removesuffix(".msg").endswith("_msgs") and package not in names:
            ros = statement.name.replace(".msg.", ".").replace(".", "/").replace("*", "Name")
            return f"delete it: an interface of ROS needs no import, as in `x : {ros}`"
        library, _, last = package.partition(".")
        inside = {
            name[len(library) + 1 :]: name for name in names if name.startswith(f"{library}.")
        }
        if not inside:
            return did_you_mean(package, names)
        close = closest(last, inside)
        if close is None:
            return f"`{library}` has {listed(sorted(inside.values()), 'and')}"
        return meant(inside[close])

    def packages(self, nearby: Path) -> set[str]:
        """Return the names of all packages, searched once however many are missing."""
        if nearby not in self._packages:
            self._packages[nearby] = {
                ".".join(path.relative_to(library).with_suffix("").parts[:2])
                for library in self._search_path(nearby)
                for depth in ("", "*/", "*/*/")
                for path in library.glob(f"{depth}*{SUFFIX}")
            }
        return self._packages[nearby]


def installed_folders(report: Diagnostics) -> list[Path]:
    """Return the folders of libraries in installed Python packages."""
    # Slow to import, and most models do not need it.
    from importlib.metadata import entry_points

    from swarmdsl.base.errors import describe_exception

    found: dict[Path, None] = {}
    for point in sorted(entry_points(group=GROUP), key=lambda point: point.name):
        try:
            folder = _folder_of(point.module)
        # An error in a third-party package must not stop the compiler.
        except (Exception, SystemExit) as error:
            reason = describe_exception(f"looking for the library {point.name}", error)
            report.report("broken-library", name=point.name, reason=reason)
            continue
        found[folder] = None
    return list(found)


def _folder_of(module: str) -> Path:
    """Folder of a module, found without running the module."""
    from importlib.util import find_spec

    spec = find_spec(module)
    if spec is None:
        raise ModuleNotFoundError(f"there is no module `{module}`")
    folders = [Path(folder) for folder in spec.submodule_search_locations or ()]
    if not folders and spec.origin is not None:
        folders = [Path(spec.origin).parent]
    for folder in folders:
        if next(folder.rglob(f"*{SUFFIX}"), None) is not None:
            return folder
    raise FileNotFoundError(f"no {SUFFIX} file is in the folder of `{module}`")


def imported_name(statement: Import) -> str | None:
    """Return the only name that an import brings in, None if it brings in all."""
    if isinstance(statement, ImportLibrary) and not statement.name.endswith(".*"):
        return statement.name.rpartition(".")[2]
    return None


def place_of(statement: Import) -> Span:
    """Return the span of the path or package in an import."""
    if isinstance(statement, ImportLibrary):
        end = statement.span.end
        return Span(statement.span.source, end - len(statement.name), end)
    return statement.path.span
