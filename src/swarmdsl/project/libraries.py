"""Where packages of models lie: `import cpswarm.uav.*`.

A package `a.b` is the file `a/b.swarm` of a library, or all .swarm files below its folder `a/b`.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from functools import cached_property
from pathlib import Path

from swarmdsl.base import resources
from swarmdsl.base.diagnostics.collector import Diagnostics, listed
from swarmdsl.base.source import Span
from swarmdsl.base.suggest import closest, did_you_mean
from swarmdsl.syntax.ast import Import, ImportLibrary

SUFFIX = ".swarm"
GROUP = "swarmdsl.libraries"
"""The entry points of packages that bring models: the module in whose folder they lie."""


class Libraries:
    """The folders where packages are looked for; the first that has one is taken.

    That is the folder of the importing file, those given, the one that comes with swarmdsl,
    and the libraries of installed Python packages. `look` hears of each place that is looked at.
    """

    def __init__(
        self, folders: Sequence[Path], report: Diagnostics, look: Callable[[Path], None]
    ) -> None:
        self._folders = folders
        self._report = report
        self._look = look
        self._packages: dict[Path, set[str]] = {}

    def find_package(self, statement: ImportLibrary, nearby: Path) -> list[Path]:
        """The files of a package; reported when no library has it."""
        package = statement.name.rpartition(".")[0]
        files = self._files(package, nearby) if package else []
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
        """Whether a library has a package of this name."""
        return bool(self._files(name, nearby))

    def _files(self, package: str, nearby: Path) -> list[Path]:
        """The files of a package, none when no library has it."""
        parts = package.split(".")
        for library in self._search_path(nearby):
            place = library.joinpath(*parts)
            file = place.with_suffix(SUFFIX)
            self._look(file)
            self._look(place)
            if file.is_file():
                return [file]
            if place.is_dir() and (files := sorted(place.rglob(f"*{SUFFIX}"))):
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
            return f"write `import {statement.name}.*` for all that a package declares"
        names = self._names(nearby)
        library, _, last = package.partition(".")
        inside = {
            name[len(library) + 1 :]: name for name in names if name.startswith(f"{library}.")
        }
        if not inside:
            return did_you_mean(package, names)
        close = closest(last, inside)
        if close is None:
            return f"`{library}` has {listed(sorted(inside.values()), 'and')}"
        return f"did you mean `{inside[close]}`?"

    def _names(self, nearby: Path) -> set[str]:
        """All packages there are, which are looked for once, however many are missing."""
        if nearby not in self._packages:
            self._packages[nearby] = {
                ".".join(path.relative_to(library).with_suffix("").parts[:2])
                for library in self._search_path(nearby)
                for depth in ("", "*/", "*/*/")
                for path in library.glob(f"{depth}*{SUFFIX}")
            }
        return self._packages[nearby]


def installed_folders(report: Diagnostics) -> list[Path]:
    """The folders of libraries in installed Python packages."""
    # Imported here because it is slow and most models do without.
    from importlib.metadata import entry_points

    from swarmdsl.base.errors import describe_exception

    found: dict[Path, None] = {}
    for point in sorted(entry_points(group=GROUP), key=lambda point: point.name):
        try:
            folder = _folder_of(point.module)
        # Whatever goes wrong in the code of others is theirs alone.
        except (Exception, SystemExit) as error:
            reason = describe_exception(f"looking for the library {point.name}", error)
            report.report("broken-library", name=point.name, reason=reason)
            continue
        found[folder] = None
    return list(found)


def _folder_of(module: str) -> Path:
    """Where the files of a module lie; the module itself is not run."""
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
    raise FileNotFoundError(f"no {SUFFIX} file lies in the folder of `{module}`")


def imported_name(statement: Import) -> str | None:
    """The one name that an import brings in, None where it brings in all."""
    if isinstance(statement, ImportLibrary) and not statement.name.endswith(".*"):
        return statement.name.rpartition(".")[2]
    return None


def place_of(statement: Import) -> Span:
    """Where an import says what it imports."""
    if isinstance(statement, ImportLibrary):
        end = statement.span.end
        return Span(statement.span.source, end - len(statement.name), end)
    return statement.path.span
