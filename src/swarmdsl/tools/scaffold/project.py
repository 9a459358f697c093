"""The files of a new project, from a template."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from pathlib import Path

from swarmdsl.base.diagnostics.collector import Diagnostics
from swarmdsl.base.source import Source
from swarmdsl.codegen.templates import Templates
from swarmdsl.syntax.formatter import formatted
from swarmdsl.tools.scaffold.plan import Plan

_FOLDER = Path(__file__).resolve().parent / "template"
# Where each file of the template goes.
_FILES: Mapping[str, str] = {
    "swarm.toml": "swarm.toml",
    "README.md": "README.md",
    "gitignore": ".gitignore",
    "models/main.swarm": "models/{package}.swarm",
    "models/members.swarm": "models/members.swarm",
    "models/behaviour.swarm": "models/behaviour.swarm",
    "models/interfaces.swarm": "models/interfaces.swarm",
    "models/mission.swarmtest.toml": "models/mission.swarmtest.toml",
    "scenarios/mission.toml": "scenarios/mission.toml",
}


def project_files(plan: Plan) -> Iterator[tuple[str, str]]:
    """The paths of the files, from the folder of the project, and their texts."""
    templates = Templates(_FOLDER)
    for name, place in _FILES.items():
        text = str(templates.fill(f"{name}.jinja", plan=plan))
        path = place.format(package=plan.package)
        yield path, _laid_out(path, text) if path.endswith(".swarm") else text


def _laid_out(path: str, text: str) -> str:
    made = formatted(Source(path, text), Diagnostics())
    assert made is not None, path  # names are checked before
    return made
