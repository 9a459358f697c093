"""Manifest: the list of generated files in an output folder.

It also holds their source maps, see `swarmdsl.output.source_maps`.
"""

from __future__ import annotations

import json
from collections.abc import Mapping
from hashlib import sha256
from pathlib import Path
from typing import Any

from swarmdsl.base.read_files import MOST_RECORDED, read_file
from swarmdsl.base.records import dataclass, field
from swarmdsl.base.relative_paths import stays_inside
from swarmdsl.output import source_maps, user_regions

NAME = ".swarmdsl.json"

Hashes = dict[str, str]
"""Content hashes of generated files, by path below the output folder."""


@dataclass(frozen=True)
class Manifest:
    """Generated files of a folder; all paths are relative to it.

    `files` has the hash of the generated content that each file is based on, even if it was
    edited. `parked` has the same for files that were put aside, by their original path. `owners`
    maps a file to fill in to its model element and the mark of the facts that its code builds on;
    `maps` has the source maps. `model` is the name of the model.
    """

    files: Hashes = field(default_factory=dict)
    parked: Hashes = field(default_factory=dict)
    owners: dict[str, str] = field(default_factory=dict)
    maps: source_maps.Maps = field(default_factory=dict)
    model: str = ""


def content_hash(content: bytes) -> str:
    """Hash content without user regions.

    Line ends are ignored: version control may convert them.
    """
    return sha256(user_regions.generated(content).replace(b"\r\n", b"\n")).hexdigest()


def read(out: Path, name: str = NAME) -> Manifest:
    """Read the manifest of a folder; empty if there is none.

    Ignores paths that lead out of the folder: swarmc did not write them. Raises OSError if it is
    unreadable, ValueError with a reason if it is malformed.
    """
    stored = _stored(out, name)
    files, parked, owners = (_section(stored, name) for name in ("files", "parked", "owners"))
    model = str(stored.get("model", ""))
    return Manifest(files, parked, owners, source_maps.from_json(stored.get("map")), model)


def _stored(out: Path, name: str) -> dict[str, Any]:
    try:
        stored = json.loads(read_file(out / name, MOST_RECORDED))
    except (FileNotFoundError, NotADirectoryError):
        return {}
    except json.JSONDecodeError as error:
        raise ValueError(f"line {error.lineno} is not JSON") from error
    except (UnicodeDecodeError, RecursionError) as error:
        raise ValueError("it is not JSON") from error
    if not isinstance(stored, dict):
        raise ValueError("it is not an object")
    return stored


def _section(stored: Mapping[str, object], name: str) -> dict[str, str]:
    """Return the entries of a section by path."""
    said = stored.get(name, {})
    if not isinstance(said, dict) or not all(isinstance(text, str) for text in said.values()):
        raise ValueError(f"`{name}` in it is not a map of paths to strings")
    return {path: text for path, text in said.items() if stays_inside(path)}


def to_bytes(manifest: Manifest) -> bytes:
    """Serialize a manifest, deterministically."""
    maps = source_maps.to_json(manifest.maps)
    stored: dict[str, object] = {"files": manifest.files, "map": maps, "model": manifest.model}
    if manifest.parked:
        stored["parked"] = manifest.parked
    if manifest.owners:
        stored["owners"] = manifest.owners
    return (json.dumps(stored, indent=2, sort_keys=True) + "\n").encode()
