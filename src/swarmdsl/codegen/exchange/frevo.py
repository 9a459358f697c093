"""Target `frevo`: problem and configuration of a search with the optimiser FREVO.

The configuration is that of FREVO 2, the problem a component of FREVO 1.
The settings of the search itself are FREVO's defaults.
"""

from __future__ import annotations

import math
import sys
from collections.abc import Iterator
from typing import Any

from swarmdsl.base.diagnostics.collector import Diagnostics
from swarmdsl.base.naming import snake_case
from swarmdsl.base.records import dataclass
from swarmdsl.base.source import Span
from swarmdsl.codegen.api import Generator, OutputFile, option
from swarmdsl.codegen.exchange.description import document
from swarmdsl.codegen.exchange.frevo_problem import problem
from swarmdsl.codegen.exchange.search_space import (
    LARGEST,
    SearchParameter,
    behaviour_package,
    number,
    search_parameters,
)
from swarmdsl.codegen.ros.package import package_fault
from swarmdsl.ir import Optimization, System

_OPERATOR = {
    "type": "ParameterSetOpBuilder",
    "directMutationProbability": 0.2,
    "directMutationSeverity": 0.1,
    "proportionalMutationProbability": 0.1,
    "proportionalMutationSeverity": 0.1,
}
_METHOD = {
    "type": "NngaMethodBuilder",
    "skewFactor": 1.0,
    **dict.fromkeys(
        ("eliteWeight", "randomWeight", "mutatedWeight", "crossedWeight", "newWeight"), 0.2
    ),
}
_EXECUTOR = {
    "type": "PoolExecutorBuilder",
    "threadCount": 0,
    "problemVariantCount": 1,
    "poolType": "CandidatePool",
}


def _count_fault(value: int) -> str | None:
    return None if 1 <= value <= LARGEST else f"`{value}` is not a number from 1 to {LARGEST}"


def _fitness_fault(value: str) -> str | None:
    try:
        return None if not value or math.isfinite(float(value)) else f"`{value}` is not finite"
    except ValueError:
        return f"`{value}` is no number"


@dataclass(frozen=True)
class Options:
    """Options of target `frevo`."""

    package: str = option(
        "",
        "ROS package with the behaviours; that of target smach if empty",
        check=package_fault,
    )
    candidates: int = option(10, "candidates of a generation", check=_count_fault)
    generations: int = option(
        10, "generations, if the model sets no evaluations", check=_count_fault
    )
    timeout: int = option(120, "time limit of a simulation, in seconds", check=_count_fault)
    enough: str = option("", "fitness at which the search stops early", check=_fitness_fault)
    ros: str = option("/opt/ros/noetic", "folder of the ROS installation, for the problem")
    workspace: str = option("", "the ROS workspace, for the problem")


def emit(system: System, options: Options, report: Diagnostics) -> Iterator[OutputFile]:
    """Yield a folder for each optimization, with both files."""
    for optimization in system.optimizations:
        parameters = list(search_parameters(optimization, system, options.package, "frevo", report))
        if not parameters:
            continue
        swarm = next(each for each in system.swarms if each.name == optimization.swarm)
        folder, at = snake_case(swarm.name), optimization.origin
        text = document(_configuration(optimization, parameters, options, report))
        yield OutputFile(f"{folder}/frevoConfiguration.json", text, origin=at)
        places = {
            "rosPath": options.ros,
            "rosWs": options.workspace,
            "rosPackage": behaviour_package(system, options.package),
        }
        text = problem(optimization, swarm, system, len(parameters), places, report)
        yield OutputFile(f"{folder}/{swarm.name}.xml", text, origin=swarm.origin)


def configuration(optimization: Optimization, system: System) -> str | None:
    """Return the configuration of a search with the defaults of the target; None if it is empty."""
    report = Diagnostics()
    parameters = list(search_parameters(optimization, system, "", "frevo", report))
    if not parameters:
        return None
    return document(_configuration(optimization, parameters, Options(), report))


def _configuration(
    optimization: Optimization,
    parameters: list[SearchParameter],
    options: Options,
    report: Diagnostics,
) -> dict[str, Any]:
    settings = dict(optimization.settings)
    candidates, generations = options.candidates, options.generations
    if (given := settings.get("evaluations")) is not None:
        evaluations = int(number(given))
        candidates = min(candidates, evaluations)
        # The first candidates are evaluated before the first generation.
        generations = evaluations // candidates - 1
        made = (generations + 1) * candidates
        if made != evaluations:
            note = (
                f"there are {candidates} candidates in a generation: {made} evaluations are written"
            )
            _report(f"{evaluations} evaluations", given.origin, report, note)
    seed = 0
    if (given := settings.get("seed")) is not None:
        seed = int(number(given))
        if seed > LARGEST:
            note = "FREVO's seed has 32 bits: the lower 31 bits are written"
            _report(f"seed {seed}", given.origin, report, note)
            seed &= LARGEST
    return {
        "simulationTimeoutSeconds": options.timeout,
        "evolutionSeed": seed,
        "evaluationSeed": seed,
        "generationCount": generations,
        "candidateCount": candidates,
        "problemBuilder": {
            "representationInputCount": 0,
            "representationOutputCount": len(parameters),
            "maximumFitness": float(options.enough or sys.float_info.max),
        },
        "representationBuilder": {
            "type": "ParameterSetBuilder",
            "parameters": [
                {
                    "name": each.name,
                    "metaInformation": each.meta,
                    "minimum": each.minimum,
                    "maximum": each.maximum,
                    "scale": each.scale,
                }
                for each in parameters
            ],
            "inputCount": 0,
            "outputCount": 0,
        },
        "operatorBuilder": _OPERATOR,
        "methodBuilder": _METHOD,
        "executorBuilder": _EXECUTOR,
    }


def _report(what: str, at: Span | None, report: Diagnostics, note: str) -> None:
    report.report("no-place", at, target="frevo", what=what, notes=(note,))


generator = Generator(
    target="frevo",
    summary="the problem and the configuration of a search, for the optimiser FREVO",
    emit=emit,
    options_type=Options,
)
