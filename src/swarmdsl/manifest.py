"""The list of generated files in an output folder: it tells them from those of the user."""

from __future__ import annotations

import json
from collections.abc import Mapping
from hashlib import sha256
from pathlib import Path

from swarmdsl import regions
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
        files = json.loads((out / NAME).read_bytes())["files"]
        return {path: files[path] for path in files if stays_inside(path)}
    except (OSError, ValueError, LookupError, TypeError, RecursionError):
        return {}


def to_bytes(hashes: Mapping[str, str]) -> bytes:
    """The list as it is stored: the same bytes for the same files."""
    return (json.dumps({"files": hashes}, indent=2, sort_keys=True) + "\n").encode()
