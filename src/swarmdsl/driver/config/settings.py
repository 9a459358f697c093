"""What a project file can say, as plain data."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path

from swarmdsl.base.diagnostics.collector import Level
from swarmdsl.base.records import dataclass, field
from swarmdsl.base.source import Span

FILE_NAME = "swarm.toml"


@dataclass(frozen=True)
class Settings:
    """The settings of a project; the defaults are those of a folder without project file.

    `sources` are compiled when no file is named, `libraries` searched for packages.
    `targets` are built when none is named, with these options, which stand in `places`; none
    stands for all.
    """

    name: str | None = None
    sources: tuple[Path, ...] = (Path(),)
    libraries: tuple[Path, ...] = ()
    targets: Mapping[str, Mapping[str, str]] = field(default_factory=dict)
    places: Mapping[str, Mapping[str, Span]] = field(default_factory=dict)
    levels: Mapping[str, Level] = field(default_factory=dict)
    out: Path = Path("out")
