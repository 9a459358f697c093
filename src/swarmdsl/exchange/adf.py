"""Target `adf`: the functions of a robot as an Abstraction Description File (D5.4, appendix).

Names and order of the keys are those of the appendix; what is empty has no key.
Types are those of ROS 1, which has no bounds for texts and arrays.
"""

from __future__ import annotations

import json
from collections.abc import Iterable, Iterator
from typing import Any

from swarmdsl.diagnostics import Diagnostics, listed
from swarmdsl.exchange.constants import UndefinedValueError, evaluate
from swarmdsl.generator import Generator, NoOptions, OutputFile
from swarmdsl.ir import (
    Action,
    Array,
    Communication,
    Constant,
    Expression,
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
_CLASSES = {"string": "string", "wstring": "string", "bool": "boolean"}


def emit(system: System, options: NoOptions, report: Diagnostics) -> Iterator[OutputFile]:
    """One file with all functions of the system."""
    if system.functions:
        functions = [_function(function, system, report) for function in system.functions]
        content = {"runtime-env": "ROS", "functions": functions}
        text = json.dumps(content, indent=2, ensure_ascii=False, allow_nan=False)
        yield OutputFile(f"{system.name}.adf.json", f"{text}\n", origin=system.origin)


def _function(function: Function, system: System, report: Diagnostics) -> dict[str, Any]:
    return _without_empty(
        name=function.name,
        description=function.doc,
        category=_CATEGORIES[function.category],
        param_list=[_param(param, report) for param in function.params],
        api=_without_empty(
            inputs=_ports(function, "in", system, report),
            outputs=_ports(function, "out", system, report),
            comm_model={
                "paradigm": _PARADIGMS[function.communication.paradigm],
                "definition": _definition(function.communication, system),
            },
        ),
    )


def _param(param: Param, report: Diagnostics) -> dict[str, Any]:
    class_ = _param_class(param.type)
    described: dict[str, Any] = {"class": class_, "name": param.name}
    if param.default is not None:
        described |= _value(param.default, report)
        if class_ != "number":
            report.report("value-not-a-number", param.origin, item=f"param `{param.name}`")
    if param.doc:
        described["description"] = param.doc
    return described


def _constant(constant: Constant, report: Diagnostics) -> dict[str, Any]:
    described = {"class": _class(constant.type), "name": constant.name}
    if _param_class(constant.type) != "number":
        item = f"constant `{constant.name}`"
        report.report("value-not-a-number", constant.origin, item=item)
    return {
        **described,
        **_value(constant.value, report),
        **_without_empty(description=constant.doc),
    }


def _value(expression: Expression, report: Diagnostics) -> dict[str, Any]:
    """The value, unless there is none, which is reported."""
    try:
        return {"value": evaluate(expression, {})}
    except UndefinedValueError as fault:
        report.report(
            "bad-operand",
            fault.origin,
            operator=fault.operator,
            operands=listed(fault.operands, "and"),
            notes=("the result would not be a finite number",),
        )
        return {}


def _param_class(type_: Type) -> str:
    match type_:
        case Primitive(name=name):
            return _CLASSES.get(name, "number")
        case Array():
            return "array"
    return str(type_)


def _class(type_: Type) -> str:
    """A type as ROS 1 writes it."""
    match type_:
        case Array(element=element, size=size, bounded=bounded):
            return f"{_class(element)}[{'' if size is None or bounded else size}]"
        case Primitive(name=name):
            return name
    return str(type_)


def _ports(
    function: Function, direction: str, system: System, report: Diagnostics
) -> list[dict[str, Any]]:
    return [_port(port, system, report) for port in function.ports if port.direction == direction]


def _port(port: FunctionPort, system: System, report: Diagnostics) -> dict[str, Any]:
    described: dict[str, Any] = {"class": _class(port.type)}
    message = system.interface(port.type)
    if isinstance(message, Message):
        constants = [_constant(constant, report) for constant in message.constants]
        described |= _without_empty(constants=constants, fields=_fields(message.fields))
    return {"topic": port.topic, "msg": described}


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
            "class": _class(field.type),
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
