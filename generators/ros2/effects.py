"""Effects as Python statements, and messages with values in their fields."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from keyword import iskeyword

from swarmdsl.codegen.python import Call, Source, layout
from swarmdsl.codegen.shared import python_address
from swarmdsl.ir import Assignment, Cancel, Effect, Expression, Literal, Named, Send

from .expressions import DATA, attribute, python_expression, stored
from .imports import WIDTH
from .module import BOTH, STEP, Module
from .names import field_name


def effects_of(what: str, state: str, effects: Sequence[Effect], module: Module) -> Source:
    """Add a function that performs the effects in order; return its name."""
    lines = [line for each in effects for line in _effect(each, module)]
    return module.function(what, state, BOTH, lines, effects[0].origin)


def _effect(effect: Effect, module: Module) -> list[str]:
    match effect:
        case Assignment(variable=variable, path=path, value=value):
            return [_store(variable, path, value, module)]
        case Cancel(event=name):
            return [f"{STEP}machine.cancel({f'send.{name}'!r})"]
        case Send(event=name, arguments=arguments, to=to, delay=delay):
            type_ = module.system.event(name).type
            assert isinstance(type_, Named)
            message = filled(module.imports.interface(type_, "msg"), arguments, module)
            module.imports.own("engine", "Event")
            keywords: tuple[tuple[str, object], ...] = ()
            if to is not None:
                module.imports.own("engine", "Envelope")
                address = python_address(to, lambda each: python_expression(each, module.imports))
                keywords = (("envelope", Call("Envelope", (), (("to", Source(address)),))),)
            event = Call("Event", (name, message), keywords)
            call = Call("machine.emit", (event,))
            if delay is not None:
                call = Call("machine.emit_after", (event, Source(whole_delay(delay, module))))
            return [layout(call, 1, STEP, width=WIDTH)]


def whole_delay(delay: Expression, module: Module) -> str:
    """Return the expression of a delay in whole nanoseconds."""
    length = python_expression(delay, module.imports)
    if isinstance(delay, Literal):
        return length
    module.imports.module("math")
    return f"math.ceil({length})"


def _store(variable: str, path: tuple[str, ...], value: Expression, module: Module) -> str:
    if not path:
        return f"{STEP}{DATA}.{variable} = {stored(value, module.types[variable], module.imports)}"
    return put(variable, path, python_expression(value, module.imports), module)


def put(variable: str, path: tuple[str, ...], value: str, module: Module) -> str:
    """Return the statement that stores a value in a field of a variable."""
    module.imports.own("values", "put")
    base = f"{DATA}.{variable}"
    *way, last = map(field_name, path)
    for field in way:
        base = attribute(base, field)
    call = Call("put", (Source(base), last, Source(value)))
    return layout(call, 1, STEP, width=WIDTH)


def filled(type_: str, arguments: Iterable[tuple[str, Expression]], module: Module) -> Call:
    """Return the expression of a new message with these fields."""
    values = [
        (field_name(name), python_expression(value, module.imports)) for name, value in arguments
    ]
    if not values:
        return Call(type_)
    module.imports.own("values", "filled")
    # A keyword of Python cannot be the name of an argument.
    odd = [Source(f"**{{{name!r}: {value}}}") for name, value in values if iskeyword(name)]
    plain = [(name, Source(value)) for name, value in values if not iskeyword(name)]
    return Call("filled", (Call(type_), *odd), tuple(plain))
