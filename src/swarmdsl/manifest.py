"""The list of generated files in an output folder: it tells them from those of the user.

It also says where their lines come from, see `swarmdsl.map_file`.
"""

from __future__ import annotations

import json
from collections.abc import Mapping
from hashlib import sha256
from pathlib import Path
from typing import Any

from swarmdsl import map_file, regions
from swarmdsl.output_path import stays_inside

NAME = ".swarmdsl.json"

Hashes = dict[str, str]
"""The path of each generated file, below the output folder, and the hash of its content."""


def content_hash(content: bytes) -> str:
    """What identifies the content of a file, without what stands in regions of the user."""
    return sha256(regions.generated(content)).hexdigest()


def read(out: Path) -> Hashes:
    """What was generated in a folder; nothing where there is no readable list.

    Then no file counts as generated, so none is overwritten unasked. A path that leads out
    of the folder was not put there by swarmc and is ignored.
    """
    try:
        files = _stored(out)["files"]
        return {path: files[path] for path in files if stays_inside(path)}
    except (LookupError, TypeError):
        return {}


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


def to_bytes(hashes: Mapping[str, str], maps: Mapping[str, map_file.FileMap]) -> bytes:
    """The list as it is stored: the same bytes for the same files."""
    stored = {"files": hashes, "map": map_file.to_json(maps)}
    return (json.dumps(stored, indent=2, sort_keys=True) + "\n").encode()
