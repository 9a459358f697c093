"""The output folders of swarmc, and which file in them a path in a log means.

A file is logged where it is installed, which is seldom where it was written. It is known by its
package: what follows the name of the package in the path is the end of the file's own path.
"""

from __future__ import annotations

import os
from collections.abc import Iterable, Iterator
from functools import cached_property, lru_cache
from pathlib import Path

from swarmdsl.base.records import dataclass
from swarmdsl.output import manifest, user_regions
from swarmdsl.output.merge import matches
from swarmdsl.output.source_maps import FileMap, Position
from swarmdsl.output.texts import Texts


@dataclass(frozen=True)
class Generated:
    """A file of an output folder, by its path below it.

    `package` is the folder of its package, `hash` that of the text that was generated.
    """

    out: Path
    path: str
    map: FileMap
    package: str
    hash: str | None

    @cached_property
    def _content(self) -> bytes:
        try:
            return (self.out / self.path).read_bytes()
        except OSError:
            return b""

    @cached_property
    def is_unknown(self) -> bool:
        """Whether it was edited, and nobody knows any more what it was before."""
        edited = bool(self._content) and manifest.content_hash(self._content) != self.hash
        return edited and not self.map.of_user and Texts(self.out).get(self.hash) is None

    @cached_property
    def _made(self) -> dict[int, int | None]:
        """The lines of a file that the user has written in, as they were generated.

        None for those of the user, nothing where there are none.
        """
        content = self._content
        base = Texts(self.out).get(self.hash) or user_regions.generated(content)
        if content == base:
            return {}
        lines = content.splitlines()
        found = matches(lines, base.splitlines())
        return {at + 1: found[at] + 1 if at in found else None for at in range(len(lines))}

    def is_of_user(self, line: int) -> bool:
        """Whether the user has written a line."""
        return self._made.get(line, line) is None

    def position(self, line: int) -> Position | None:
        """Where a line comes from that was generated, as far as more is known than of the file."""
        made = self._made.get(line, line)
        return self.map.position(made) if made is not None else None


class Folders:
    """Output folders: those that were named, and those in which logged files lie.

    `unmapped` are folders with a manifest that has no source maps.
    """

    def __init__(self, folders: Iterable[Path]) -> None:
        self.found: list[Path] = []
        self.unmapped: list[Path] = []
        self._files: dict[str, list[Generated]] = {}
        self._looked: set[str] = set()
        # Junk that looks like paths may come without end.
        self.file = lru_cache(1 << 12)(self._file)
        for folder in folders:
            self._look(str(folder))

    def _file(self, path: str) -> Generated | None:
        """The file that a path in a log means, if swarmc has made it."""
        parts = [part for part in path.replace("\\", "/").split("/") if part not in ("", ".", "..")]
        if not parts or "\0" in path:
            return None
        for folder in Path(path).parents if path[0] in "/\\" or path[1:2] == ":" else ():
            self._look(str(folder))
        places = self._files.get(parts[-1], ())
        exact = [file for file in places if _is_at(file, path)]
        return next(iter(exact), None) or max(
            (file for file in places if _matches(file, parts)),
            key=lambda file: _common(file.path.split("/"), parts),
            default=None,
        )

    def _look(self, folder: str) -> None:
        """Read the manifest of a folder, if it has one, and if that was not done before."""
        if folder in self._looked:
            return
        self._looked.add(folder)
        if not os.path.isfile(os.path.join(folder, manifest.NAME)):  # noqa: PTH113, PTH118 - often
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
            # What is in no package is in the folder of a target.
            package = next(
                (above for above in _above(path) if above in packages), path.partition("/")[0]
            )
            file = Generated(out, path, map_, package, hashes.get(path))
            self._files.setdefault(path.rpartition("/")[2], []).append(file)


def nearby(folder: Path) -> Iterator[Path]:
    """Where an output folder is likely when none is named: here, somewhat below, or above."""
    yield from (folder, *folder.parents)
    for pattern in ("*", "*/*"):
        for place in sorted(folder.glob(f"{pattern}/{manifest.NAME}")):
            yield place.parent


def _above(path: str) -> Iterator[str]:
    """The folders that a file is in, from the inside out."""
    while path := path.rpartition("/")[0]:
        yield path


def _is_at(file: Generated, path: str) -> bool:
    place = os.path.join(file.out, file.path)  # noqa: PTH118 - of each file that is called so
    return os.path.normpath(path) == os.path.normpath(place)


def _matches(file: Generated, parts: list[str]) -> bool:
    """Whether a file's path ends with what follows the name of its package in the logged one."""
    package = file.package.rpartition("/")[2]
    own = file.path.removeprefix(f"{file.package}/").split("/")
    if len(parts) == 1:
        return package in parts[0]
    return any(
        own[-len(rest) :] == rest
        for number, part in enumerate(parts[:-1])
        if part == package and (rest := parts[number + 1 :])
    )


def _common(one: list[str], other: list[str]) -> int:
    """How many parts two paths have in common at their ends."""
    pairs = zip(reversed(one), reversed(other), strict=False)
    return next((n for n, (a, b) in enumerate(pairs) if a != b), min(len(one), len(other)))
