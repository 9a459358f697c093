"""Target `adf`: the functions of a robot as an Abstraction Description File (D5.4, appendix).

Names and order of the keys are those of the appendix; what is empty has no key.
"""

from __future__ import annotations

import json
from collections.abc import Iterable, Iterator
from typing import Any

from swarmdsl.diagnostics import Diagnostics
from swarmdsl.exchange.constants import constant
from swarmdsl.generator import Generator, NoOptions, OutputFile
from swarmdsl.ir import (
    Action,
    Array,
    Communication,
    Field,
    Function,
    FunctionPort,
    Message,
    Param,
    Primitive,
    Service,
    System,
    Type,
)

_CATEGORIES = {"abstraction": "abstraction-lib", "swarm": "swarm-lib"}
_PARADIGMS = {"action": "rosaction", "service": "rosservice"}
_CLASSES = {"string": "string", "bool": "boolean"}


def emit(system: System, options: NoOptions, report: Diagnostics) -> Iterator[OutputFile]:
    """One file with all functions of the system."""
    if system.functions:
        functions = [_function(function, system, report) for function in system.functions]
        content = {"runtime-env": "ROS", "functions": functions}
        text = json.dumps(content, indent=2, ensure_ascii=False)
        yield OutputFile(f"{system.name}.adf.json", f"{text}\n", origin=system.origin)


def _function(function: Function, system: System, report: Diagnostics) -> dict[str, Any]:
    return _without_empty(
        name=function.name,
        description=function.doc,
        category=_CATEGORIES[function.category],
        param_list=[_param(param, report) for param in function.params],
        api=_without_empty(
            inputs=_ports(function, "in", system),
            outputs=_ports(function, "out", system),
            comm_model={
                "paradigm": _PARADIGMS[function.communication.paradigm],
                "definition": _definition(function.communication, system),
            },
        ),
    )


def _param(param: Param, report: Diagnostics) -> dict[str, Any]:
    described: dict[str, Any] = {"class": _param_class(param.type), "name": param.name}
    if param.default is not None:
        described["value"] = constant(param.default, {})
        if described["class"] != "number":
            report.report("value-not-a-number", param.origin, name=param.name)
    if param.doc:
        described["description"] = param.doc
    return described


def _param_class(type_: Type) -> str:
    match type_:
        case Primitive(name=name):
            return _CLASSES.get(name, "number")
        case Array():
            return "array"
    return str(type_)


def _ports(function: Function, direction: str, system: System) -> list[dict[str, Any]]:
    return [_port(port, system) for port in function.ports if port.direction == direction]


def _port(port: FunctionPort, system: System) -> dict[str, Any]:
    message = system.interface(port.type)
    fields = message.fields if isinstance(message, Message) else ()
    described = _without_empty(fields=_fields(fields))
    return {"topic": port.topic, "msg": {"class": str(port.type), **described}}


def _definition(communication: Communication, system: System) -> dict[str, Any]:
    parts: dict[str, tuple[Field, ...]] = {}
    match system.interface(communication.type):
        case Action(goal=goal, result=result, feedback=feedback):
            parts = {"goal": goal, "result": result, "feedback": feedback}
        case Service(request=request, response=response):
            parts = {"request": request, "response": response}
    return {
        "name": communication.name,
        "class": str(communication.type),
        **{name: {"fields": _fields(fields)} for name, fields in parts.items() if fields},
    }


def _fields(fields: Iterable[Field]) -> list[dict[str, str]]:
    return [
        {
            "class": str(field.type),
            "name": field.name,
            **_without_empty(description=field.doc),
        }
        for field in fields
    ]


def _without_empty(**items: Any) -> dict[str, Any]:
    return {name: item for name, item in items.items() if item}


generator = Generator(
    target="adf",
    summary="the functions of the robots as an Abstraction Description File",
    emit=emit,
)
