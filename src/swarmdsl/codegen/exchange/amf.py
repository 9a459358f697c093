"""Target `amf`: behaviours of the swarm library as an Algorithm Modelling File.

Its form is that of the JSON schema `ROS_algorithm-description`, which came with the CPSwarm
modelling tool: the functions of an ADF in its first generation, without params.
"""

from __future__ import annotations

from collections.abc import Iterator

from swarmdsl.base.diagnostics.collector import Diagnostics
from swarmdsl.codegen.api import Generator, NoOptions, OutputFile
from swarmdsl.codegen.exchange.description import by_schema, document
from swarmdsl.ir import System


def emit(system: System, options: NoOptions, report: Diagnostics) -> Iterator[OutputFile]:
    """Yield a file with the functions of category `swarm`."""
    functions = [function for function in system.functions if function.category == "swarm"]
    if functions:
        described = [by_schema(function, system, "amf", report) for function in functions]
        text = document({"runtime-env": "ROS", "functions": described})
        yield OutputFile(f"{system.name}.amf.json", text, origin=system.origin)


generator = Generator(
    target="amf",
    summary="the functions of the swarm library as an Algorithm Modelling File",
    emit=emit,
)
