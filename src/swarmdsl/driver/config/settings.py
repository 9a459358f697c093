"""Settings of a project file, as plain data."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path

from swarmdsl.base.diagnostics.collector import Level
from swarmdsl.base.records import dataclass, field
from swarmdsl.base.source import Span

FILE_NAME = "swarm.toml"


@dataclass(frozen=True)
class ModelSource:
    """Source of a function model of a project: a class in a file, or an entry point (no `path`)."""

    name: str
    attribute: str
    path: Path | None = None
    place: Span | None = None


@dataclass(frozen=True)
class Settings:
    """Settings of a project; the defaults apply without a project file.

    `sources` are compiled if no file is named, `libraries` are searched for packages. `targets`,
    with their options, are built if none is named; if empty, all default targets. `places` has the
    spans of the options, `models` the function models of the project. `folder` is that of the
    project file, the current one without it, and `out_place` the span of `out` in it.
    """

    name: str | None = None
    sources: tuple[Path, ...] = (Path(),)
    libraries: tuple[Path, ...] = ()
    targets: Mapping[str, Mapping[str, str]] = field(default_factory=dict)
    places: Mapping[str, Mapping[str, Span]] = field(default_factory=dict)
    levels: Mapping[str, Level] = field(default_factory=dict)
    models: Mapping[str, ModelSource] = field(default_factory=dict)
    out: Path = Path("out")
    folder: Path = Path()
    out_place: Span | None = None
