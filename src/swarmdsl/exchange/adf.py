"""Target `adf`: the functions of a robot as an Abstraction Description File (D5.4, appendix)."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

from swarmdsl.diagnostics import Diagnostics
from swarmdsl.exchange.description import D5_4, api, document, value, value_class, without_empty
from swarmdsl.generator import Generator, NoOptions, OutputFile
from swarmdsl.ir import Function, Param, System

_CATEGORIES = {"abstraction": "abstraction-lib", "swarm": "swarm-lib"}


def emit(system: System, options: NoOptions, report: Diagnostics) -> Iterator[OutputFile]:
    """One file with all functions of the system."""
    if system.functions:
        functions = [_function(function, system, report) for function in system.functions]
        text = document({"runtime-env": "ROS", "functions": functions})
        yield OutputFile(f"{system.name}.adf.json", text, origin=system.origin)


def _function(function: Function, system: System, report: Diagnostics) -> dict[str, Any]:
    return without_empty(
        name=function.name,
        description=function.doc,
        category=_CATEGORIES[function.category],
        param_list=[_param(param, report) for param in function.params],
        api=api(function, system, D5_4, report),
    )


def _param(param: Param, report: Diagnostics) -> dict[str, Any]:
    class_ = value_class(param.type)
    described: dict[str, Any] = {"class": class_, "name": param.name}
    if param.default is not None:
        described |= value(param.default, report)
        if class_ != "number":
            report.report("value-not-a-number", param.origin, item=f"param `{param.name}`")
    if param.doc:
        described["description"] = param.doc
    return described


generator = Generator(
    target="adf",
    summary="the functions of the robots as an Abstraction Description File",
    emit=emit,
)
