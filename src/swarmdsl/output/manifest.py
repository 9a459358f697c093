"""The list of generated files in an output folder: it tells them from those of the user.

It also says where their lines come from, see `swarmdsl.output.source_maps`.
"""

from __future__ import annotations

import json
from collections.abc import Mapping
from hashlib import sha256
from pathlib import Path
from typing import Any

from swarmdsl.base.records import dataclass, field
from swarmdsl.base.relative_paths import stays_inside
from swarmdsl.output import source_maps, user_regions

NAME = ".swarmdsl.json"

Hashes = dict[str, str]
"""The path of each generated file, below the output folder, and the hash of its content."""


@dataclass(frozen=True)
class Manifest:
    """What was generated in a folder; all paths are below it.

    `files` has the hash of the text that each file was made from: of a file that the user has
    written in too. `parked` has the same of files that were put aside, by the path that they
    had. `owners` says of files to fill in which element of the model they are of, and with which
    mark of what code in them builds on; `maps` where the lines of a file come from. `model` is
    what the model is called.
    """

    files: Hashes = field(default_factory=dict)
    parked: Hashes = field(default_factory=dict)
    owners: dict[str, str] = field(default_factory=dict)
    maps: source_maps.Maps = field(default_factory=dict)
    model: str = ""


def content_hash(content: bytes) -> str:
    """What identifies the content of a file, without what stands in regions of the user.

    Line ends do not count: a version control system may have made others of them.
    """
    return sha256(user_regions.generated(content).replace(b"\r\n", b"\n")).hexdigest()


def read(out: Path, name: str = NAME) -> Manifest:
    """What was generated in a folder; nothing where there is no list.

    A path that leads out of the folder was not put there by swarmc and is ignored. Raises OSError
    where the list cannot be read, ValueError with a reason where it is not as it was written.
    """
    stored = _stored(out, name)
    files, parked, owners = (_section(stored, name) for name in ("files", "parked", "owners"))
    model = str(stored.get("model", ""))
    return Manifest(files, parked, owners, source_maps.from_json(stored.get("map")), model)


def _stored(out: Path, name: str) -> dict[str, Any]:
    try:
        stored = json.loads((out / name).read_bytes())
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
    """The paths of a section with what is said of them."""
    said = stored.get(name, {})
    if not isinstance(said, dict) or not all(isinstance(text, str) for text in said.values()):
        raise ValueError(f"`{name}` in it is not paths with a text each")
    return {path: text for path, text in said.items() if stays_inside(path)}


def to_bytes(manifest: Manifest) -> bytes:
    """The list as it is stored: the same bytes for the same files."""
    maps = source_maps.to_json(manifest.maps)
    stored: dict[str, object] = {"files": manifest.files, "map": maps, "model": manifest.model}
    if manifest.parked:
        stored["parked"] = manifest.parked
    if manifest.owners:
        stored["owners"] = manifest.owners
    return (json.dumps(stored, indent=2, sort_keys=True) + "\n").encode()
