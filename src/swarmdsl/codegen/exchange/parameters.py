"""Target `parameters`: search spaces for the CPSwarm simulation orchestrator.

It reads a file `parameters.json` with these keys (schema `OptimisedParameter` of the modelling
tool), in which a scale is a string.
"""

from __future__ import annotations

from collections.abc import Iterator

from swarmdsl.base.diagnostics.collector import Diagnostics
from swarmdsl.base.naming import snake_case
from swarmdsl.base.records import dataclass
from swarmdsl.codegen.api import Generator, OutputFile, option
from swarmdsl.codegen.exchange.description import document
from swarmdsl.codegen.exchange.search_space import search_parameters
from swarmdsl.codegen.ros.package import package_fault
from swarmdsl.ir import System


@dataclass(frozen=True)
class Options:
    """Options of target `parameters`."""

    package: str = option(
        "",
        "ROS package whose parameter file has the params; that of the behaviours if empty",
        check=package_fault,
    )


def emit(system: System, options: Options, report: Diagnostics) -> Iterator[OutputFile]:
    """Yield a file for each optimization, in a folder named after its swarm."""
    for optimization in system.optimizations:
        for name, value in optimization.settings:
            report.report(
                "no-place",
                value.origin,
                target="parameters",
                what=f"`{name}`",
                notes=("the file says what is varied, not how long",),
            )
        parameters = [
            {
                "name": each.name,
                "meta": each.meta,
                "min": each.minimum,
                "max": each.maximum,
                "scale": str(each.scale).removesuffix(".0"),
            }
            for each in search_parameters(
                optimization, system, options.package, "parameters", report
            )
        ]
        if parameters:
            path = f"{snake_case(optimization.swarm)}/parameters.json"
            yield OutputFile(path, document({"parameters": parameters}), origin=optimization.origin)


generator = Generator(
    target="parameters",
    summary="search spaces of optimizations, for the CPSwarm simulation orchestrator",
    emit=emit,
    options_type=Options,
)
