"""Print messages, services, actions, events and functions."""

from __future__ import annotations

from collections.abc import Iterable

from swarmdsl.base.naming import snake_case
from swarmdsl.codegen.swarm_printer.delivery import delivery_settings
from swarmdsl.codegen.swarm_printer.expressions import default, expression
from swarmdsl.codegen.swarm_printer.layout import block, documented, quoted
from swarmdsl.codegen.swarm_printer.names import Names
from swarmdsl.codegen.swarm_printer.space import model
from swarmdsl.ir import (
    Action,
    Communication,
    Constant,
    Event,
    Field,
    Function,
    FunctionPort,
    Interface,
    Message,
    Param,
    Service,
)

_WIDTH = 100


def print_interface(interface: Interface, names: Names) -> list[str]:
    """Print a message, service or action; an enum is a message of constants."""
    name = str(interface.type) if interface.external else interface.type.name
    match interface:
        case Message(fields=fields, constants=constants):
            lines = block(f"message {name}", _constants(constants, names), _fields(fields, names))
        case Service(request=request, response=response):
            parts = {"request": request, "response": response}
            lines = block(f"service {name}", _parts(parts, names))
        case Action(goal=goal, result=result, feedback=feedback):
            parts = {"goal": goal, "result": result, "feedback": feedback}
            lines = block(f"action {name}", _parts(parts, names))
    return documented(interface.doc, lines)


def print_event(event: Event, names: Names) -> list[str]:
    """Print an event; that of a monitored topic is declared like any other."""
    words = (("swarm", event.swarm), ("operator", event.operator))
    kinds = "".join(f"{word} " for word, is_said in words if is_said)
    on = on_topic(event.topic, event.name)
    head = f"{kinds}event {event.name} : {names.type(event.type)}{on}"
    settings = delivery_settings(event.delivery)
    line = f"{head} {{ {', '.join(settings)} }}" if settings else head
    # The formatter breaks longer lines, where settings need no separators.
    return documented(event.doc, block(head, settings) if len(line) > _WIDTH else [line])


def print_function(function: Function, names: Names) -> list[str]:
    """Print a function with its call."""
    return documented(
        function.doc,
        block(
            f"function {function.name} : {function.category}",
            [
                *_communication(function.communication, names),
                *(line for port in function.ports for line in _port(port, names)),
                *print_params(function.params, names),
                *_model(function),
            ],
        ),
    )


def _model(function: Function) -> list[str]:
    use = function.model
    return documented(use.doc, [f"model {model(use)}"]) if use is not None else []


def print_params(params: Iterable[Param], names: Names) -> list[str]:
    """Print params, one a line."""
    return [
        line
        for param in params
        for line in documented(
            param.doc, [f"param {param.name} : {names.type(param.type)}{default(param.default)}"]
        )
    ]


def on_topic(topic: str, name: str) -> str:
    """Return ` on "topic"`, or nothing if the name implies the topic."""
    return "" if topic == snake_case(name) else f" on {quoted(topic)}"


def _constants(constants: Iterable[Constant], names: Names) -> list[str]:
    return [
        line
        for constant in constants
        for line in documented(
            constant.doc,
            [f"const {constant.name} : {names.type(constant.type)} = {expression(constant.value)}"],
        )
    ]


def _fields(fields: Iterable[Field], names: Names) -> list[str]:
    return [
        line
        for field in fields
        for line in documented(field.doc, [f"{field.name} : {names.type(field.type)}"])
    ]


def _parts(parts: dict[str, tuple[Field, ...]], names: Names) -> list[str]:
    """Yield the parts of a service or action that have fields."""
    return [
        line
        for part, fields in parts.items()
        if fields
        for line in block(part, _fields(fields, names))
    ]


def _communication(call: Communication, names: Names) -> list[str]:
    line = f"{call.paradigm} {quoted(call.name)} : {names.type(call.type)}"
    return documented(call.doc, [line])


def _port(port: FunctionPort, names: Names) -> list[str]:
    line = f"{port.direction} {quoted(port.topic)} : {names.type(port.type)}"
    return documented(port.doc, [line])
