"""Fill the template of a new project."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from pathlib import Path

from swarmdsl.base.diagnostics.collector import Diagnostics
from swarmdsl.base.source import Source
from swarmdsl.codegen.templates import Templates
from swarmdsl.syntax.formatter import format_source
from swarmdsl.tools.scaffold.libraries import LIBRARIES
from swarmdsl.tools.scaffold.plan import Plan

_FOLDER = Path(__file__).resolve().parent / "template"
# Template files and their paths in the project.
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
# The same for robots of a library.
_FILES_OF_LIBRARIES: Mapping[str, str] = {
    "robots/swarm.toml": "swarm.toml",
    "robots/README.md": "README.md",
    "gitignore": ".gitignore",
    "robots/{library}/main.swarm": "models/{package}.swarm",
    "robots/{library}/behaviour.swarm": "models/behaviour.swarm",
    "robots/{library}/mission.swarmtest.toml": "models/mission.swarmtest.toml",
    "robots/{library}/mission.toml": "scenarios/mission.toml",
}


def project_files(plan: Plan) -> Iterator[tuple[str, str]]:
    """Yield the paths and texts of the project files."""
    templates = Templates(_FOLDER)
    library = LIBRARIES.get(plan.library)
    for name, pattern in (_FILES if library is None else _FILES_OF_LIBRARIES).items():
        template = f"{name.format(library=plan.library)}.jinja"
        text = str(templates.fill(template, plan=plan, library=library))
        path = pattern.format(package=plan.package)
        yield path, _formatted(path, text) if path.endswith(".swarm") else text


def _formatted(path: str, text: str) -> str:
    result = format_source(Source(path, text), Diagnostics())
    assert result is not None, path  # the names were checked
    return result
