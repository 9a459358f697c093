"""The list of generated files in an output folder: it tells them from those of the user.

It also says where their lines come from, see `swarmdsl.map_file`.
"""

from __future__ import annotations

import json
from hashlib import sha256
from pathlib import Path
from typing import Any

from swarmdsl import map_file, regions
from swarmdsl.dataclass import dataclass, field
from swarmdsl.output_path import stays_inside

NAME = ".swarmdsl.json"

Hashes = dict[str, str]
"""The path of each generated file, below the output folder, and the hash of its content."""


@dataclass(frozen=True)
class Manifest:
    """What was generated in a folder; all paths are below it.

    `files` has the hash of the text that each file was made from: of a file that the user has
    written in too. `parked` has the same of files that were put aside, by the path that they
    had. `owners` says of files to fill in which element of the model they are of, and with which
    mark of what code in them builds on; `maps` where the lines of a file come from.
    """

    files: Hashes = field(default_factory=dict)
    parked: Hashes = field(default_factory=dict)
    owners: dict[str, str] = field(default_factory=dict)
    maps: map_file.Maps = field(default_factory=dict)


def content_hash(content: bytes) -> str:
    """What identifies the content of a file, without what stands in regions of the user.

    Line ends do not count: a version control system may have made others of them.
    """
    return sha256(regions.generated(content).replace(b"\r\n", b"\n")).hexdigest()


def read(out: Path) -> Manifest:
    """What was generated in a folder; nothing where there is no readable list.

    Then no file counts as generated, so none is overwritten unasked. A path that leads out
    of the folder was not put there by swarmc and is ignored.
    """
    stored = _stored(out)
    files, parked, owners = (_section(stored.get(name)) for name in ("files", "parked", "owners"))
    return Manifest(files, parked, owners, map_file.from_json(stored.get("map")))


def read_maps(out: Path) -> map_file.Maps | None:
    """Where the lines of its files come from; None where it has no such list."""
    stored = _stored(out)
    return map_file.from_json(stored["map"]) if "map" in stored else None


def _stored(out: Path) -> dict[str, Any]:
    try:
        stored = json.loads((out / NAME).read_bytes())
    except (OSError, ValueError, RecursionError):
        return {}
    return stored if isinstance(stored, dict) else {}


def _section(stored: object) -> dict[str, str]:
    """The paths of a section with what is said of them, but for what is not as it was written."""
    said = stored if isinstance(stored, dict) else {}
    return {
        path: text for path, text in said.items() if stays_inside(path) and isinstance(text, str)
    }


def to_bytes(manifest: Manifest) -> bytes:
    """The list as it is stored: the same bytes for the same files."""
    stored: dict[str, object] = {"files": manifest.files, "map": map_file.to_json(manifest.maps)}
    if manifest.parked:
        stored["parked"] = manifest.parked
    if manifest.owners:
        stored["owners"] = manifest.owners
    return (json.dumps(stored, indent=2, sort_keys=True) + "\n").encode()
