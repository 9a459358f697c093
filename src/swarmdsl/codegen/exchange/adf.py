"""Target `adf`: the functions of a robot as an Abstraction Description File.

The form is that of D5.4 (appendix), or the one before it, that of the JSON schema
`ROS_abstraction-description`, which came with the CPSwarm modelling tool.
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

from swarmdsl.base.diagnostics.collector import Diagnostics
from swarmdsl.base.records import dataclass
from swarmdsl.codegen.api import Generator, OutputFile, option
from swarmdsl.codegen.exchange.description import (
    D5_4,
    SCHEMA,
    api,
    by_schema,
    document,
    topic,
    value,
    value_class,
    without_empty,
)
from swarmdsl.ir import Component, Function, Param, System

_CATEGORIES = {"abstraction": "abstraction-lib", "swarm": "swarm-lib"}


@dataclass(frozen=True)
class Options:
    """Options of target `adf`."""

    functions: str = option(
        "all", "all functions, or those in no library (missing)", choices=("all", "missing")
    )
    form: str = option(
        "d5.4",
        "that of D5.4, or of the modelling tool's schema, which adds sensors and actuators",
        choices=("d5.4", "schema"),
    )


def emit(system: System, options: Options, report: Diagnostics) -> Iterator[OutputFile]:
    """Yield a file with the functions of the system."""
    functions = [
        function
        for function in system.functions
        if options.functions == "all" or not function.in_library
    ]
    content: dict[str, Any]
    if options.form == "d5.4":
        content = {"functions": [_function(function, system, report) for function in functions]}
    else:
        content = {
            "sensors/actuators": list(_components(system, report)),
            "functions": [by_schema(function, system, "adf", report) for function in functions],
        }
    if content := without_empty(**content):
        text = document({"runtime-env": "ROS", **content})
        yield OutputFile(f"{system.name}.adf.json", text, origin=system.origin)


def _function(function: Function, system: System, report: Diagnostics) -> dict[str, Any]:
    return without_empty(
        name=function.name,
        description=function.doc,
        category=_CATEGORIES[function.category],
        param_list=[_param(param, function, report) for param in function.params],
        api=api(function, system, D5_4, report),
    )


def _param(param: Param, function: Function, report: Diagnostics) -> dict[str, Any]:
    class_ = value_class(param.type)
    described: dict[str, Any] = {"class": class_, "name": param.name}
    # A library function's node knows its defaults: prefer a file that can be read.
    if param.default is not None and (class_ == "number" or not function.in_library):
        described |= value(param.default, report)
        if class_ != "number":
            report.report("value-not-a-number", param.origin, item=f"param `{param.name}`")
    if param.doc:
        described["description"] = param.doc
    return described


def _components(system: System, report: Diagnostics) -> Iterator[dict[str, Any]]:
    """Return the components that the schema has a category for; not controllers."""
    for component in system.components:
        if component.kind == "controller":
            what = f"controller `{component.name}`"
            report.report("no-place", component.origin, target="adf", what=what)
        else:
            yield _component(component, system, report)


def _component(component: Component, system: System, report: Diagnostics) -> dict[str, Any]:
    for param in component.params:
        what = f"param `{param.name}` of a component"
        report.report("no-place", param.origin, target="adf", what=what)
    inputs, outputs = (
        [
            topic(port.topic, port.type, system, SCHEMA, report)
            for port in component.ports
            if port.direction != other
        ]
        for other in ("out", "in")
    )
    return {
        "name": component.name,
        "description": component.doc,
        "category": component.kind.capitalize(),
        "api": without_empty(inputs=inputs, outputs=outputs),
    }


generator = Generator(
    target="adf",
    summary="the functions of the robots as an Abstraction Description File",
    emit=emit,
    options_type=Options,
)
