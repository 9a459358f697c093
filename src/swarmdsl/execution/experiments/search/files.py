"""Files of a winner, for other programs and for `swarmc simulate`."""

from __future__ import annotations

import json
from collections.abc import Collection, Iterator, Sequence
from pathlib import Path
from typing import Any

from swarmdsl.base.diagnostics.collector import Diagnostics
from swarmdsl.codegen.exchange.frevo import configuration
from swarmdsl.codegen.exchange.search_space import behaviour_package, search_parameters
from swarmdsl.execution.experiments.settings import merged
from swarmdsl.execution.experiments.task import COUNT, Candidate
from swarmdsl.execution.experiments.toml_text import toml_text
from swarmdsl.execution.simulate.scenario.durations import SECOND, duration
from swarmdsl.ir import Optimization, System

_PARAMETERS, _POINTS = "parameters", "front"


def scenario_text(candidate: Candidate) -> str:
    """Return the tables of a scenario with the settings, as TOML."""
    return toml_text(merged(candidate, {}))


def candidate_data(candidate: Candidate, system: System) -> list[dict[str, Any]]:
    """Return the candidate as the simulation orchestrator of CPSwarm has it, times in seconds."""
    package = f"file:{behaviour_package(system, '')}"
    found = []
    for name, value in candidate.settings:
        meta = "command_line" if name.startswith(COUNT) else package
        plain = name.removeprefix(COUNT).rpartition(".")[2]
        number = (duration(value) or 0) / SECOND if isinstance(value, str) else value
        found.append({"name": plain, "meta": meta, "value": number})
    return found


def parameters_data(optimization: Optimization, system: System) -> dict[str, Any]:
    """Return the ranges as target `parameters` writes them, as far as it can."""
    found = search_parameters(optimization, system, "", _PARAMETERS, Diagnostics())
    return {
        "parameters": [
            {
                "name": each.name,
                "meta": each.meta,
                "min": each.minimum,
                "max": each.maximum,
                "scale": str(each.scale).removesuffix(".0"),
            }
            for each in found
        ]
    }


def files_of(
    candidate: Candidate, optimization: Optimization, system: System
) -> Iterator[tuple[str, str]]:
    """Yield the names and the texts of the files of a winner."""
    yield "best.toml", scenario_text(candidate)
    yield "candidate.json", _json(candidate_data(candidate, system))
    yield "parameters.json", _json(parameters_data(optimization, system))
    if (text := configuration(optimization, system)) is not None:
        yield "frevoConfiguration.json", text
    if text := package_text(candidate, system):
        yield f"{behaviour_package(system, '')}.yaml", text


def package_text(candidate: Candidate, system: System) -> str:
    """Return the params as a parameter file of ROS, as the orchestrator writes it at the end."""
    found = candidate_data(candidate, system)
    return "".join(
        f"{each['name']}: {each['value']}\n" for each in found if "file:" in each["meta"]
    )


def point_files(
    candidates: Sequence[Candidate], optimization: Optimization, system: System
) -> Iterator[tuple[str, str]]:
    """Yield the names and the texts of the files of a front, two for each point."""
    for number, candidate in enumerate(candidates, 1):
        yield f"{_POINTS}/{number}.toml", scenario_text(candidate)
        yield f"{_POINTS}/{number}.json", _json(candidate_data(candidate, system))
    yield f"{_PARAMETERS}.json", _json(parameters_data(optimization, system))


def remove_other_points(folder: Path, files: Collection[str]) -> None:
    """Remove points of an earlier front from a folder. Raises OSError."""
    for path in (folder / _POINTS).glob("*.*"):
        is_point = path.stem.isdigit() and path.suffix in (".toml", ".json")
        if is_point and f"{_POINTS}/{path.name}" not in files:
            path.unlink()


def _json(data: Any) -> str:
    return f"{json.dumps(data, indent=2)}\n"
