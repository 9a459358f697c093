"""Effects and results as Python statements, one string a line."""

from __future__ import annotations

from collections.abc import Iterable

from swarmdsl.codegen.python import Call, Source, layout
from swarmdsl.codegen.shared import field_type
from swarmdsl.ir import Assignment, Effect, Expression, Named, Send, Type, bound_of

from .expressions import USERDATA, field_name, python_expression
from .module import Module

STEP = "    "


def effect_lines(effects: Iterable[Effect], depth: int, module: Module) -> list[str]:
    """The effects in their order."""
    lines: list[str] = []
    for effect in effects:
        match effect:
            case Assignment(variable=variable, path=path, value=value):
                text = kept(value, module.held(variable, path), module)
                lines += assign(variable, path, text, depth, module)
            case Send():
                lines.append(_send(effect, depth, module))
    return lines


def kept(value: Expression, wanted: Type | None, module: Module) -> str:
    """A value for what is of the type `wanted`, if that is known: a whole number has to fit."""
    return within(python_expression(value, module.imports), bound_of(value, wanted), module)


def within(text: str, bound: str | None, module: Module) -> str:
    """The value if it fits into the type of whole numbers, where one has to."""
    if bound is None:
        return text
    bounded = module.imports.name(f"{module.imports.types.package}.engine", "bounded")
    return f"{bounded}({text}, {bound!r})"


def assign(
    variable: str, path: tuple[str, ...], value: str, depth: int, module: Module
) -> list[str]:
    """Store a value in a variable or in a field of one.

    A message is never changed in place: another state may be reading it.
    """
    indent = STEP * depth
    if not path:
        return [f"{indent}{USERDATA}.{variable} = {value}"]
    module.imports.module("copy")
    fields = ".".join(map(field_name, path))
    # A local name must not hide what the value may read.
    local = f"new_{variable}"
    return [
        f"{indent}{local} = copy.deepcopy({USERDATA}.{variable})",
        f"{indent}{local}.{fields} = {value}",
        f"{indent}{USERDATA}.{variable} = {local}",
    ]


def _send(send: Send, depth: int, module: Module) -> str:
    module.sent.setdefault(send.event)
    event = module.system.event(send.event)
    assert isinstance(event.type, Named)
    message = Call(
        module.imports.interface(event.type, "msg"),
        (),
        tuple(
            (
                field_name(name),
                Source(kept(value, field_type(event.type, (name,), module.system), module)),
            )
            for name, value in send.arguments
        ),
    )
    return layout(Call(f"{module.event(send.event)}.send", (message,)), depth, STEP * depth)
