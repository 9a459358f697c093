"""Find the generated file that a logged path refers to.

Logs name installed files, which are seldom where they were generated. A file is recognized by its
package: the path below the package name ends the path of the generated file.
"""

from __future__ import annotations

import os
from collections.abc import Iterable, Iterator
from functools import cached_property, lru_cache
from pathlib import Path

from swarmdsl.base.read_files import MOST_RECORDED, is_file, read_file
from swarmdsl.base.records import dataclass
from swarmdsl.output import manifest, user_regions
from swarmdsl.output.merge import matches
from swarmdsl.output.source_maps import FileMap, Position
from swarmdsl.output.texts import Texts


@dataclass(frozen=True)
class GeneratedFile:
    """Generated file, by its path below the output folder.

    `package` is the folder of its package, `hash` the hash of the generated content.
    """

    out: Path
    path: str
    map: FileMap
    package: str
    hash: str | None

    @cached_property
    def _content(self) -> bytes:
        try:
            return read_file(self.out / self.path, MOST_RECORDED)
        except OSError:
            return b""

    @cached_property
    def lost_original(self) -> bool:
        """True if the file was edited and its generated text is not recorded."""
        edited = bool(self._content) and manifest.content_hash(self._content) != self.hash
        return edited and not self.map.of_user and Texts(self.out).get(self.hash) is None

    @cached_property
    def _generated_lines(self) -> dict[int, int | None]:
        """Generated line number of each line of an edited file.

        None for a line of the user; empty if the file was not edited.
        """
        content = self._content
        base = Texts(self.out).get(self.hash) or user_regions.generated(content)
        if content == base:
            return {}
        lines = content.splitlines()
        found = matches(lines, base.splitlines())
        return {at + 1: found[at] + 1 if at in found else None for at in range(len(lines))}

    def is_users_line(self, line: int) -> bool:
        """Return True if the user wrote a line."""
        return self._generated_lines.get(line, line) is None

    def position(self, line: int) -> Position | None:
        """Model location of a generated line, if known beyond that of the file."""
        made = self._generated_lines.get(line, line)
        return self.map.position(made) if made is not None else None


class OutputFolders:
    """Output folders: the given ones, and those that contain logged files.

    `unmapped` are folders whose manifest has no source maps.
    """

    def __init__(self, folders: Iterable[Path]) -> None:
        self.found: list[Path] = []
        self.unmapped: list[Path] = []
        self._files: dict[str, list[GeneratedFile]] = {}
        self._visited: set[str] = set()
        # Bounded: a log can contain any number of strings that look like paths.
        self.file = lru_cache(1 << 12)(self._file)
        for folder in folders:
            self._load(str(folder))

    def _file(self, path: str) -> GeneratedFile | None:
        """Return a generated file that a logged path refers to, if any."""
        parts = [part for part in path.replace("\\", "/").split("/") if part not in ("", ".", "..")]
        if not parts or "\0" in path:
            return None
        for folder in Path(path).parents if path[0] in "/\\" or path[1:2] == ":" else ():
            self._load(str(folder))
        places = self._files.get(parts[-1], ())
        exact = [file for file in places if _has_path(file, path)]
        return next(iter(exact), None) or max(
            (file for file in places if _matches(file, parts)),
            key=lambda file: _common_suffix(file.path.split("/"), parts),
            default=None,
        )

    def _load(self, folder: str) -> None:
        """Read the manifest of a folder once, if there is one."""
        if folder in self._visited:
            return
        self._visited.add(folder)
        if not is_file(os.path.join(folder, manifest.NAME)):  # noqa: PTH118 - often
            return
        out = Path(folder)
        try:
            listed = manifest.read(out)
        except (OSError, ValueError):
            listed = manifest.Manifest()
        maps, hashes = listed.maps, listed.files
        if not maps:
            self.unmapped.append(out)
            return
        self.found.append(out)
        packages = {path.rpartition("/")[0] for path in maps if path.endswith("/package.xml")}
        for path, map_ in maps.items():
            # A file outside of packages is in the folder of its target.
            package = next(
                (above for above in _parents(path) if above in packages), path.partition("/")[0]
            )
            file = GeneratedFile(out, path, map_, package, hashes.get(path))
            self._files.setdefault(path.rpartition("/")[2], []).append(file)


def nearby_folders(folder: Path) -> Iterator[Path]:
    """Yield likely output folders: this one, up to two levels below, and those above."""
    yield from (folder, *folder.parents)
    for pattern in ("*", "*/*"):
        for place in sorted(folder.glob(f"{pattern}/{manifest.NAME}")):
            yield place.parent


def _parents(path: str) -> Iterator[str]:
    """Yield the folders of a file, innermost first."""
    while path := path.rpartition("/")[0]:
        yield path


def _has_path(file: GeneratedFile, path: str) -> bool:
    place = os.path.join(file.out, file.path)  # noqa: PTH118 - called often
    return os.path.normpath(path) == os.path.normpath(place)


def _matches(file: GeneratedFile, parts: list[str]) -> bool:
    """Return True if the path below the package name ends the path of the file."""
    package = file.package.rpartition("/")[2]
    own = file.path.removeprefix(f"{file.package}/").split("/")
    if len(parts) == 1:
        return package in parts[0]
    return any(
        own[-len(rest) :] == rest
        for number, part in enumerate(parts[:-1])
        if part == package and (rest := parts[number + 1 :])
    )


def _common_suffix(one: list[str], other: list[str]) -> int:
    """Return the number of common parts at the ends of two paths."""
    pairs = zip(reversed(one), reversed(other), strict=False)
    return next((n for n, (a, b) in enumerate(pairs) if a != b), min(len(one), len(other)))
