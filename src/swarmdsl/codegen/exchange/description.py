"""Functions and messages as in CPSwarm's description files of two generations.

Names and order of the keys are those of the files; empty values have no key.
Types are those of ROS 1, which has no bounds for strings and arrays.
"""

from __future__ import annotations

import json
from collections.abc import Iterable
from typing import Any

from swarmdsl.base.diagnostics.collector import Diagnostics, listed
from swarmdsl.base.records import dataclass
from swarmdsl.codegen.shared.constants import UndefinedValueError, evaluate
from swarmdsl.ir import (
    Action,
    Array,
    Communication,
    Constant,
    Expression,
    Field,
    Function,
    Message,
    Primitive,
    Service,
    System,
    Type,
)

_CLASSES = {"string": "string", "wstring": "string", "bool": "boolean"}
_PARADIGMS = {"action": "rosaction", "service": "rosservice"}


@dataclass(frozen=True)
class Generation:
    """Differences between the generations of the files.

    `message` is the key of a message; `nested` puts the call in one object; `numbers` restricts
    values to numbers, for a program that takes nothing else.
    """

    message: str
    nested: bool
    numbers: bool


SCHEMA = Generation("msg_def", nested=False, numbers=False)
"""That of the JSON schemas which came with the modelling tool."""
D5_4 = Generation("msg", nested=True, numbers=True)
"""That of the appendix of D5.4, which the CPSwarm code generator reads."""


def api(
    function: Function, system: System, generation: Generation, report: Diagnostics
) -> dict[str, Any]:
    """Return the topics of a function and its call."""
    communication = function.communication
    paradigm, definition = _PARADIGMS[communication.paradigm], _definition(communication, system)
    called = (
        {"comm_model": {"paradigm": paradigm, "definition": definition}}
        if generation.nested
        else {"comm_paradigm": paradigm, "comm_model": definition}
    )
    inputs, outputs = (
        [
            topic(port.topic, port.type, system, generation, report)
            for port in function.ports
            if port.direction == direction
        ]
        for direction in ("in", "out")
    )
    return without_empty(inputs=inputs, outputs=outputs, **called)


def by_schema(
    function: Function, system: System, target: str, report: Diagnostics
) -> dict[str, Any]:
    """Return a function without params, as in the schemas; report own params."""
    for param in () if function.in_library else function.params:
        what = f"param `{param.name}` of a function"
        report.report("no-place", param.origin, target=target, what=what)
    return {
        "name": function.name,
        "description": function.doc,
        "api": api(function, system, SCHEMA, report),
    }


def topic(
    name: str, type_: Type, system: System, generation: Generation, report: Diagnostics
) -> dict[str, Any]:
    """Return a topic and the content of its message."""
    described: dict[str, Any] = {"class": _class(type_)}
    message = system.interface(type_)
    if isinstance(message, Message):
        constants = [_constant(constant, generation, report) for constant in message.constants]
        described |= without_empty(constants=constants, fields=_fields(message.fields))
    return {"topic": name, generation.message: described}


def value(expression: Expression, report: Diagnostics) -> dict[str, Any]:
    """Return the value; report it if there is none."""
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


def value_class(type_: Type) -> str:
    """Return a type in the notation for values of params."""
    match type_:
        case Primitive(name=name):
            return _CLASSES.get(name, "number")
        case Array():
            return "array"
    return str(type_)


def document(content: dict[str, Any]) -> str:
    """Return the text of a file."""
    return json.dumps(content, indent=2, ensure_ascii=False, allow_nan=False) + "\n"


def without_empty(**items: Any) -> dict[str, Any]:
    """Return the items that are not empty."""
    return {name: item for name, item in items.items() if item}


def _constant(constant: Constant, generation: Generation, report: Diagnostics) -> dict[str, Any]:
    described = {"class": _class(constant.type), "name": constant.name}
    if generation.numbers and value_class(constant.type) != "number":
        item = f"constant `{constant.name}`"
        report.report("value-not-a-number", constant.origin, item=item)
    return {
        **described,
        **value(constant.value, report),
        **without_empty(description=constant.doc),
    }


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
            **without_empty(description=field.doc),
        }
        for field in fields
    ]


def _class(type_: Type) -> str:
    """Return a type in the notation of ROS 1."""
    match type_:
        case Array(element=element, size=size, bounded=bounded):
            return f"{_class(element)}[{'' if size is None or bounded else size}]"
        case Primitive(name=name):
            return name
    return str(type_)
