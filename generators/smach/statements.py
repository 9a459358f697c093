"""Effects and results as lines of Python statements."""

from __future__ import annotations

from collections.abc import Iterable

from swarmdsl.codegen import PYTHON_ARRAY_FUNCTIONS
from swarmdsl.codegen.python import Call, Source, layout
from swarmdsl.codegen.shared import field_type, python_address
from swarmdsl.ir import Array, Assignment, Cancel, Effect, Expression, Named, Send, Type, bound_of
from swarmdsl.ir import Call as IrCall

from .expressions import USERDATA, field_name, python_expression
from .module import Module

STEP = "    "


def effect_lines(effects: Iterable[Effect], depth: int, module: Module) -> list[str]:
    """Return the statements of effects, in order."""
    lines: list[str] = []
    for effect in effects:
        match effect:
            case Assignment(variable=variable, path=path, value=value):
                text = kept(value, module.held(variable, path), module)
                lines += assign(variable, path, text, depth, module)
            case Cancel(event=event):
                lines.append(f"{STEP * depth}{module.event(event)}.cancel()")
            case Send():
                lines.append(_send(effect, depth, module))
    return lines


def kept(value: Expression, wanted: Type | None, module: Module) -> str:
    """Return an expression for a value of a type; integers are checked against its range."""
    if isinstance(value, IrCall) and value.function in ("append", "replace"):
        element = value.type.element if isinstance(value.type, Array) else None
        at = 1 if value.function == "append" else 2
        parts = [
            kept(part, element, module) if number == at else python_expression(part, module.imports)
            for number, part in enumerate(value.arguments)
        ]
        return f"{module.own('engine', PYTHON_ARRAY_FUNCTIONS[value.function])}({', '.join(parts)})"
    return within(python_expression(value, module.imports), bound_of(value, wanted), module)


def within(text: str, bound: str | None, module: Module) -> str:
    """Return an expression with a check against the range of an integer type, if there is one."""
    if bound is None:
        return text
    bounded = module.imports.name(f"{module.imports.types.package}.engine", "bounded")
    return f"{bounded}({text}, {bound!r})"


def assign(
    variable: str, path: tuple[str, ...], value: str, depth: int, module: Module
) -> list[str]:
    """Return the statements that store a value in a variable or its field.

    A message is never changed in place, because another state may read it.
    """
    indent = STEP * depth
    if not path:
        return [f"{indent}{USERDATA}.{variable} = {value}"]
    module.imports.module("copy")
    fields = ".".join(map(field_name, path))
    # A local name must not hide a name that the value reads.
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
    arguments: tuple[object, ...] = (message,)
    if send.to is not None:
        text = python_address(send.to, lambda value: python_expression(value, module.imports))
        arguments = (message, Source(text))
    method = "send"
    if send.delay is not None:
        method = "send_after"
        arguments = (Source(python_expression(send.delay, module.imports)), *arguments)
    return layout(Call(f"{module.event(send.event)}.{method}", arguments), depth, STEP * depth)
